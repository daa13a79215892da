// Where the vector at each pixel's point leads in the picture: its part in the surface's tangent plane, as the camera sees it.
//
// The point of column c and row r is base(c, r) + t direction(c, r) (picture/view.glsl). It moves by a vector v while column, row and t
// change by dc, dr and dt with
//     v = C dc + R dr + direction dt,   C = base_column + t direction_column,   R = base_row + t direction_row,
// so that dc : dr = (v x R . direction) : (C x v . direction): the derivative of the projection itself, for any camera.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "arithmetic/precision.glsl"
#include "arithmetic/finite.glsl"
#include "picture/view.glsl"
#include "picture/samples.glsl"
#include "picture/lic_pixel.glsl"
#include "picture/seen_point.glsl"

layout(set = 0, binding = 1) CORE_READ_SAMPLES(core_samples);
layout(set = 0, binding = 2) CORE_READ_MARKS(core_marks);
layout(set = 0, binding = 3) CORE_READ_REALS(core_normals);
layout(set = 0, binding = 4) CORE_READ_REALS(core_vectors);
// What the vectors lack, component by component; and how far off they may be.
layout(set = 0, binding = 5, std430) readonly buffer core_numbers_block { elvis_vec4 core_numbers; };
layout(set = 0, binding = 6, std430) writeonly buffer core_pixels_block { core_lic_pixel core_pixels[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
    uint core_width;
    // The surface has one normal, that of the rays' plane.
    uint core_is_plane;
};

// Of a vector: a part that is less, in the tangent plane or across the view, is as good as zero. Normals are right to some ten
// roundings, so that directions are right to a hundredth.
#define CORE_LEAST_PART (elvis_real(2048) * CORE_ROUNDOFF)
// A surface goes on from one pixel to the next where the way from point to point leaves neither tangent plane by more than 30 degrees.
#define CORE_MOST_RISE elvis_real(0.5)

struct core_surface_point {
    bool has_vector;
    elvis_vec3 position, direction, normal, vector;
    // Parameter of the ray.
    elvis_real t;
};

core_surface_point core_surface_point_of(ivec2 place) {
    const uint pixel = uint(place.y) * core_width + uint(place.x);
    core_surface_point point;
    const bool is_shown = CORE_MARK(core_marks, pixel).owner != 0u && CORE_SAMPLE_NUMBER(core_samples, pixel) != CORE_NO_NUMBER;
    const elvis_real depth = is_shown ? CORE_SAMPLE_DEPTH(core_samples, pixel) : elvis_real(1);
    point.position = core_seen_point(elvis_vec2(place), depth, point.direction, point.t);
    point.normal = core_plane_normal.xyz;
    if (core_is_plane == 0u) {
        point.normal = CORE_REAL3(core_normals, 3u * pixel);
    }
    const uint at = 3u * pixel;
    point.vector = CORE_REAL3(core_vectors, at) + core_numbers.xyz;
    point.has_vector = is_shown && core_is_finite(point.vector.x) && core_is_finite(point.vector.y) && core_is_finite(point.vector.z) &&
                       core_is_finite(point.normal.x) && core_is_finite(point.normal.y) && core_is_finite(point.normal.z);
    return point;
}

// `place`: of a pixel in the picture or out of it.
bool core_goes_on(core_surface_point from, ivec2 place, ivec2 size) {
    const bool is_inside = place.x >= 0 && place.y >= 0 && place.x < size.x && place.y < size.y;
    const core_surface_point to = core_surface_point_of(clamp(place, ivec2(0), size - 1));
    const elvis_vec3 way = to.position - from.position;
    const elvis_real most = CORE_MOST_RISE * length(way);
    const bool is_smooth = core_is_plane != 0u || (abs(dot(way, from.normal)) <= most && abs(dot(way, to.normal)) <= most);
    return is_inside && from.has_vector && to.has_vector && is_smooth;
}

// Zero where the vector's part in the tangent plane, or what is seen of that part, is nothing but rounding.
elvis_vec2 core_direction_in_picture(core_surface_point point) {
    // Vectors of any size: their squares need not be numbers.
    const elvis_real size = max(max(abs(point.vector.x), abs(point.vector.y)), abs(point.vector.z));
    const elvis_vec3 vector = size > elvis_real(0) ? point.vector / size : elvis_vec3(0);
    const elvis_vec3 tangent = vector - dot(vector, point.normal) * point.normal;
    const elvis_real part = length(tangent);
    const bool is_known = part * size > core_numbers.w && part > CORE_LEAST_PART * length(vector);
    const elvis_vec3 ray = point.direction, column = core_direction_column.xyz * point.t + core_base_column.xyz,
                     row = core_direction_row.xyz * point.t + core_base_row.xyz;
    const bool is_seen = length(cross(tangent, normalize(ray))) > CORE_LEAST_PART * part;
    const elvis_vec2 way = elvis_vec2(dot(cross(tangent, row), ray), dot(cross(column, tangent), ray));
    const elvis_real pixels = length(way);
    return is_known && is_seen && pixels > elvis_real(0) ? way / pixels : elvis_vec2(0);
}

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (pixel >= core_n_pixels || CORE_MARK(core_marks, pixel).owner == 0u) {
        return;
    }
    const ivec2 place = ivec2(pixel % core_width, pixel / core_width), size = ivec2(core_width, core_n_pixels / core_width);
    const core_surface_point point = core_surface_point_of(place);
    const elvis_vec2 way = point.has_vector ? core_direction_in_picture(point) : elvis_vec2(0);
    uint bits = point.has_vector ? core_lic_bit(ivec2(0)) : 0u;
    for (int i = 0; i < 9; ++i) {
        const ivec2 to = ivec2(i % 3 - 1, i / 3 - 1);
        bits |= to != ivec2(0) && core_goes_on(point, place + to, size) ? core_lic_bit(to) : 0u;
    }
    core_pixels[pixel] = core_lic_pixel(way.x, way.y, bits);
}
