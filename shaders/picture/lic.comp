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

// Directions that cancel each other by more lead nowhere.
#define CORE_LIC_LEAST_SQUARE elvis_real(1.0e-4LF)
// Standard deviations of the mean within which shades differ.
#define CORE_LIC_MOST_DEVIATION elvis_real(2)

// Bits of a pixel; none out of the picture.
uint core_lic_bits(ivec2 place) {
    const ivec2 size = ivec2(core_width, core_n_pixels / core_width);
    const bool is_inside = place.x >= 0 && place.y >= 0 && place.x < size.x && place.y < size.y;
    const uint pixel = is_inside ? uint(place.y) * core_width + uint(place.x) : 0u;
    return is_inside && core_marks[pixel].owner != 0u ? core_pixels[pixel].bits : 0u;
}

// Whether the surface goes on from one pixel to the next in its row, or in its column. `way`: -1, 0 or 1.
bool core_goes_across(ivec2 from, int way) {
    return way == 0 || (core_lic_bits(ivec2(from.x + min(way, 0), from.y)) & CORE_LIC_GOES_ACROSS) != 0u;
}
bool core_goes_down(ivec2 from, int way) {
    return way == 0 || (core_lic_bits(ivec2(from.x, from.y + min(way, 0))) & CORE_LIC_GOES_DOWN) != 0u;
}

// Whether it goes on from a pixel to one beside it, over edges of pixels.
bool core_goes_to(ivec2 from, ivec2 way) {
    return (core_goes_across(from, way.x) && core_goes_down(from + ivec2(way.x, 0), way.y)) ||
           (core_goes_down(from, way.y) && core_goes_across(from + ivec2(0, way.y), way.x));
}

elvis_vec2 core_lic_direction(ivec2 place, bool is_there) {
    const core_lic_pixel found = core_pixels[is_there ? uint(place.y) * core_width + uint(place.x) : 0u];
    return is_there ? elvis_vec2(found.across, found.down) : elvis_vec2(0);
}

// The direction `offset` away from pixel `start`, nearest to pixel `nearest`: from that pixel and those three around the place to which
// the surface goes on. Zero where there is none.
elvis_vec2 core_direction_at(ivec2 start, ivec2 nearest, elvis_vec2 offset) {
    const elvis_vec2 off = offset - elvis_vec2(nearest - start), weight = abs(off);
    const ivec2 way = ivec2(off.x < elvis_real(0) ? -1 : 1, off.y < elvis_real(0) ? -1 : 1), across = ivec2(way.x, 0), down = ivec2(0, way.y);
    const elvis_vec2 here = core_lic_direction(nearest, true);
    const elvis_vec2 beside = core_lic_direction(nearest + across, core_goes_to(nearest, across));
    const elvis_vec2 under = core_lic_direction(nearest + down, core_goes_to(nearest, down));
    const elvis_vec2 opposite = core_lic_direction(nearest + way, core_goes_to(nearest, way));
    const elvis_real x = weight.x, y = weight.y, rest_x = elvis_real(1) - x, rest_y = elvis_real(1) - y;
    const elvis_vec2 sum = rest_x * rest_y * here + x * rest_y * beside + rest_x * y * under + x * y * opposite;
    const elvis_real square = dot(sum, sum);
    return square > CORE_LIC_LEAST_SQUARE ? sum / sqrt(square) : elvis_vec2(0);
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

// Into the grain, and the place in it, of what is `offset` pixels away from the middle of pixel `pixel`.
int core_grain_at(int pixel, elvis_real offset, out elvis_real inside) {
    const int n = int(core_grain);
    // Middles of grains have whole numbers: those of pixels are (2 pixel + 1 - n) / 2n. Moved by a grain, so that nothing is negative.
    const int halves = 2 * pixel + 1 + n;
    const int whole = halves / (2 * n);
    const elvis_real at = (elvis_real(halves - 2 * n * whole) * elvis_real(0.5) + offset) / elvis_real(n), low = floor(at);
    inside = at - low;
    return whole + int(low);
}

elvis_real core_noise(ivec2 start, elvis_vec2 offset) {
    elvis_real x, y;
    const int column = core_grain_at(start.x, offset.x, x), row = core_grain_at(start.y + int(core_first_row), offset.y, y);
    const elvis_real above = mix(core_noise_of(ivec2(column, row)), core_noise_of(ivec2(column + 1, row)), x);
    const elvis_real below = mix(core_noise_of(ivec2(column, row + 1)), core_noise_of(ivec2(column + 1, row + 1)), x);
    return mix(above, below, y);
}

ivec2 core_nearest(elvis_vec2 offset) { return ivec2(floor(offset + elvis_real(0.5))); }

// One side of the curve, by the midpoint rule: the sum of the noise along it, and at how many places.
void core_follow(ivec2 start, elvis_real sense, inout elvis_real sum, inout elvis_real n_places) {
    elvis_real x = elvis_real(0), y = elvis_real(0);
    int column = start.x, row = start.y;
    bool goes_on = true;
    const elvis_real step_ = elvis_real(core_step) * sense;
    for (uint i = 0u; i < core_n_steps; ++i) {
        const elvis_vec2 from = elvis_vec2(x, y);
        ivec2 nearest = ivec2(column, row);
        const elvis_vec2 first = core_direction_at(start, nearest, from);
        const elvis_vec2 middle = from + elvis_real(0.5) * step_ * first;
        const ivec2 to_middle = start + core_nearest(middle) - nearest;
        goes_on = goes_on && first != elvis_vec2(0) && core_goes_to(nearest, to_middle);
        nearest = goes_on ? nearest + to_middle : nearest;
        const elvis_vec2 second = core_direction_at(start, nearest, goes_on ? middle : from);
        const elvis_vec2 to = from + step_ * second;
        const ivec2 to_end = start + core_nearest(to) - nearest;
        goes_on = goes_on && second != elvis_vec2(0) && core_goes_to(nearest, clamp(to_end, ivec2(-1), ivec2(1)));
        column = goes_on ? nearest.x + to_end.x : column;
        row = goes_on ? nearest.y + to_end.y : row;
        x = goes_on ? to.x : x;
        y = goes_on ? to.y : y;
        sum += goes_on ? core_noise(start, elvis_vec2(x, y)) : elvis_real(0);
        n_places += goes_on ? elvis_real(1) : elvis_real(0);
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
    if ((core_pixels[pixel].bits & CORE_LIC_HAS_VECTOR) == 0u) {
        core_shades[pixel] = elvis_real(1);
        return;
    }
    elvis_real sum = core_noise(start, elvis_vec2(0)), n_places = elvis_real(1);
    core_follow(start, elvis_real(1), sum, n_places);
    core_follow(start, elvis_real(-1), sum, n_places);
    // Of bilinear noise along a length of l grains: of evenly distributed numbers (1/12), 2/3 across the curve, and along it 1/l for long
    // curves, 2/3 for none.
    const elvis_real grains = (n_places - elvis_real(1)) * elvis_real(core_step) / elvis_real(core_grain);
    const elvis_real deviation = elvis_real(1) / sqrt(elvis_real(18) * grains + elvis_real(27));
    const elvis_real most = CORE_LIC_MOST_DEVIATION;
    const elvis_real relative = clamp((sum / n_places - elvis_real(0.5)) / deviation, -most, most);
    core_shades[pixel] = elvis_real(1) - elvis_real(core_contrast) * (elvis_real(0.5) - elvis_real(0.5) * relative / most);
}
