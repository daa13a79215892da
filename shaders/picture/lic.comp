// Line integral convolution in the picture (Cabral and Leedom, "Imaging vector fields using line integral convolution", SIGGRAPH 1993;
// in picture space as van Wijk, "Image based flow visualization for curved surfaces", IEEE Visualization 2003, and Laramee et al., "Image
// space based visualization of unsteady flow on surfaces", same year): the mean of noise along the curve through each pixel that
// follows the directions in the picture. It becomes a factor for the pixel's colour.
//
// Between pixels directions are bilinear, and so is the noise: what rounding does to the curve changes the mean by as little. All
// places are told from the pixel that the curve begins at, so that the rows of a part of a picture are those of the whole to the bit.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "picture/samples.glsl"
#include "picture/lic_pixel.glsl"

layout(set = 0, binding = 0, std430) readonly buffer core_marks_block { core_mark core_marks[]; };
layout(set = 0, binding = 1, std430) readonly buffer core_pixels_block { core_lic_pixel core_pixels[]; };
layout(set = 0, binding = 2, std430) writeonly buffer core_shades_block { elvis_real core_shades[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
    uint core_width;
    // Of the whole picture, in which this one begins.
    uint core_first_row;
    // Pixels across for one value of the noise.
    uint core_grain;
    // To each side.
    uint core_n_steps;
    // In pixels, at most 1/2.
    float core_step;
    float core_contrast;
};

// Length of the mean of directions around a place. Where it is less they turn by more than 120 degrees from pixel to pixel: there is a
// point without direction between them, beyond which rounding would decide where the curve goes on. Before that, the curve fades out.
#define CORE_LIC_LEAST_LENGTH elvis_real(0.5)
#define CORE_LIC_SURE_LENGTH elvis_real(0.6LF)
// Standard deviations of the mean within which shades differ.
#define CORE_LIC_MOST_DEVIATION elvis_real(2)

core_lic_pixel core_lic_at(ivec2 place) { return core_pixels[uint(place.y) * core_width + uint(place.x)]; }

bool core_goes_to(core_lic_pixel from, ivec2 way) { return (from.bits & core_lic_bit(way)) != 0u; }

// The direction of a pixel beside another one; zero where the surface does not go on to it.
elvis_vec2 core_direction_beside(core_lic_pixel from, ivec2 place, ivec2 way) {
    const bool goes_on = core_goes_to(from, way);
    const core_lic_pixel to = core_lic_at(goes_on ? place + way : place);
    return goes_on ? elvis_vec2(to.across, to.down) : elvis_vec2(0);
}

// The mean of directions `off` away from the pixel at `place`, which is the nearest: that pixel's and those of the three around the point
// to which the surface goes on.
elvis_vec2 core_mean_direction(core_lic_pixel nearest, ivec2 place, elvis_vec2 off) {
    const ivec2 way = ivec2(off.x < elvis_real(0) ? -1 : 1, off.y < elvis_real(0) ? -1 : 1);
    const elvis_real x = abs(off.x), y = abs(off.y), rest_x = elvis_real(1) - x, rest_y = elvis_real(1) - y;
    return rest_x * rest_y * elvis_vec2(nearest.across, nearest.down) +
           x * rest_y * core_direction_beside(nearest, place, ivec2(way.x, 0)) +
           rest_x * y * core_direction_beside(nearest, place, ivec2(0, way.y)) + x * y * core_direction_beside(nearest, place, way);
}

// How much a mean of this length counts.
elvis_real core_lic_share(elvis_real length_) {
    return clamp((length_ - CORE_LIC_LEAST_LENGTH) / (CORE_LIC_SURE_LENGTH - CORE_LIC_LEAST_LENGTH), elvis_real(0), elvis_real(1));
}

// The finalizer of MurmurHash3 (Austin Appleby): every bit of the input changes half of the output's.
uint core_mixed(uint h) {
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    return h ^ (h >> 16);
}

// Evenly distributed in [0, 1), the same on all devices.
elvis_real core_noise_of(ivec2 grain) {
    const uint h = core_mixed(uint(grain.x) + 0x9e3779b9u * core_mixed(uint(grain.y) + 0x632be5abu));
    return elvis_real(float(h >> 8) * 5.9604644775390625e-8);
}

// A place among grains, whose middles have whole numbers.
struct core_grain_place {
    ivec2 whole;
    elvis_vec2 rest;
};

// Of the middle of a pixel, which has (2 pixel + 1 - n) / 2n where grains are n pixels wide. Moved by a grain, so that nothing is negative.
core_grain_place core_grain_place_of(ivec2 pixel) {
    const ivec2 halves = 2 * (pixel + ivec2(0, int(core_first_row))) + 1 + int(core_grain);
    const ivec2 whole = halves / (2 * int(core_grain));
    return core_grain_place(whole, elvis_vec2(halves - 2 * int(core_grain) * whole) * elvis_real(0.5));
}

// `offset`: from there, in pixels.
elvis_real core_noise(core_grain_place from, elvis_vec2 offset) {
    const elvis_vec2 at = (from.rest + offset) / elvis_real(core_grain), low = floor(at), inside = at - low;
    const ivec2 grain = from.whole + ivec2(low);
    const elvis_real above = mix(core_noise_of(grain), core_noise_of(grain + ivec2(1, 0)), inside.x);
    const elvis_real below = mix(core_noise_of(grain + ivec2(0, 1)), core_noise_of(grain + 1), inside.x);
    return mix(above, below, inside.y);
}

ivec2 core_nearest(elvis_vec2 offset) { return ivec2(floor(offset + elvis_real(0.5))); }

// One side of the curve, by the midpoint rule: the sum of the noise along it, and at how many places, each as much as it counts.
void core_follow(ivec2 start, core_grain_place grains, elvis_real sense, inout elvis_real sum, inout elvis_real n_places) {
    elvis_real x = elvis_real(0), y = elvis_real(0);
    int column = start.x, row = start.y;
    const elvis_real step_ = elvis_real(core_step) * sense;
    elvis_real share = elvis_real(1);
    bool goes_on = true;
    for (uint i = 0u; i < core_n_steps; ++i) {
        const elvis_vec2 from = elvis_vec2(x, y);
        ivec2 place = ivec2(column, row);
        core_lic_pixel nearest = core_lic_at(place);
        const elvis_vec2 first = core_mean_direction(nearest, place, from - elvis_vec2(place - start));
        const elvis_real first_length = max(length(first), CORE_LIC_LEAST_LENGTH);
        const elvis_vec2 middle = from + elvis_real(0.5) * step_ / first_length * first;
        const ivec2 to_middle = start + core_nearest(middle) - place;
        goes_on = goes_on && core_goes_to(nearest, to_middle);
        place = goes_on ? place + to_middle : place;
        nearest = core_lic_at(place);
        const elvis_vec2 second = core_mean_direction(nearest, place, goes_on ? middle - elvis_vec2(place - start) : elvis_vec2(0));
        const elvis_real second_length = max(length(second), CORE_LIC_LEAST_LENGTH);
        const elvis_vec2 to = from + step_ / second_length * second;
        share *= core_lic_share(first_length) * core_lic_share(second_length);
        const ivec2 to_end = clamp(start + core_nearest(to) - place, ivec2(-1), ivec2(1));
        goes_on = goes_on && share > elvis_real(0) && core_goes_to(nearest, to_end);
        column = goes_on ? place.x + to_end.x : column;
        row = goes_on ? place.y + to_end.y : row;
        x = goes_on ? to.x : x;
        y = goes_on ? to.y : y;
        sum += goes_on ? share * core_noise(grains, elvis_vec2(x, y)) : elvis_real(0);
        n_places += goes_on ? share : elvis_real(0);
        if (!goes_on) {
            break;
        }
    }
}

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (pixel >= core_n_pixels || core_marks[pixel].owner == 0u) {
        return;
    }
    const ivec2 start = ivec2(pixel % core_width, pixel / core_width);
    if (!core_goes_to(core_lic_at(start), ivec2(0))) {
        core_shades[pixel] = elvis_real(1);
        return;
    }
    const core_grain_place place = core_grain_place_of(start);
    elvis_real sum = core_noise(place, elvis_vec2(0)), n_places = elvis_real(1);
    core_follow(start, place, elvis_real(1), sum, n_places);
    core_follow(start, place, elvis_real(-1), sum, n_places);
    // Of bilinear noise along a length of l grains: of evenly distributed numbers (1/12), 2/3 across the curve, and along it 1/l for long
    // curves, 2/3 for none.
    const elvis_real grains = (n_places - elvis_real(1)) * elvis_real(core_step) / elvis_real(core_grain);
    const elvis_real deviation = elvis_real(1) / sqrt(elvis_real(18) * grains + elvis_real(27));
    const elvis_real most = CORE_LIC_MOST_DEVIATION;
    const elvis_real relative = clamp((sum / n_places - elvis_real(0.5)) / deviation, -most, most);
    core_shades[pixel] = elvis_real(1) - elvis_real(core_contrast) * (elvis_real(0.5) - elvis_real(0.5) * relative / most);
}
