// Light along a ray, front to back: what has come from what is behind the ray's point, and how much is still let through.
//
//     I = integral of color(f) density(f) exp(-integral of density(f))     (B. Nelson, 2012, equation 6.1)
//
// The kernel brings volume/transfer.glsl.

struct core_light {
    elvis_real red, green, blue;
    // Share of the light from behind that is let through.
    elvis_real left;
    // Bound, as far as estimates tell, of what each channel is off.
    elvis_real error;
};

// Light from a part that emits `color` and lets `through` through.
void core_add_light(inout core_light light, elvis_vec3 color, elvis_real through) {
    light.red += light.left * color.x;
    light.green += light.left * color.y;
    light.blue += light.left * color.z;
    light.left *= through;
}
