// Light along a ray, front to back: what has come from before the ray's point, and the transmittance up to it.
//
//     I = integral of color(f) density(f) exp(-integral of density(f))     (B. Nelson, 2012, equation 6.1)

#ifndef CORE_VOLUME_LIGHT
#define CORE_VOLUME_LIGHT

struct core_light {
    elvis_real red, green, blue;
    elvis_real transmittance;
    // Bound, as far as estimates tell, of what each channel is off.
    elvis_real error;
};

// Light from an interval of the ray that emits `color`, of this transmittance.
void core_add_light(inout core_light light, elvis_vec3 color, elvis_real transmittance) {
    light.red += light.transmittance * color.x;
    light.green += light.transmittance * color.y;
    light.blue += light.transmittance * color.z;
    light.transmittance *= transmittance;
}

#endif
