// Faces of the elements of one class, or two-dimensional elements, seen along the rays of a picture: the nearest crossing, and the
// field there.
//
// A face is a map of (u, v), both from -1 to 1, with u + v <= 0 in a triangle. A ray o + t d meets it where x(u, v) = o + t d. Newton's
// method starts from the face's centre. A bound of its error (library/prediction.glsl; along the face, oblique rays stretch it) tells
// most faces that are missed after one step, and shows where no second crossing is possible. Elsewhere it starts again from the centres of
// CORE_PATCHES^2 patches of the face; a patch is left after one evaluation if the linear model there puts the solution more than one
// patch away, because its neighbours start closer. A ray that crosses a face twice near its silhouette has a twin crossing in the
// direction that projects onto the ray: it is looked for from both sides of each crossing found. All crossings are found while the
// mapping is close to linear within a patch, which is an assumption: such pixels are flagged as resting on estimates.
//
// One evaluation of the mapping a turn, whatever face and start a lane is at, so that lanes do not wait for each other.

layout(local_size_x = 32) in;

#include "library/precision.glsl"
#include "library/prediction.glsl"
#include "library/cut_frame.glsl"
#include "library/face_frame.glsl"
#include "library/hierarchy.glsl"
#include "library/linearization.glsl"
#include "library/samples.glsl"

layout(set = 0, binding = 1, std430) buffer core_samples_block { core_sample core_samples[]; };
// Three numbers a pixel.
layout(set = 0, binding = 2, std430) writeonly buffer core_normals_block { elvis_real core_normals[]; };
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
layout(set = 0, binding = 4, std430) buffer core_marks_block { core_mark core_marks[]; };
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    uint core_first_row;
    // Counted from 1; 0 is no surface.
    uint core_surface;
    uint core_first_component;
    uint core_end_component;
    uint core_is_discontinuous;
};

#include "library/show.glsl"

// The centre, then the patches.
#define CORE_STARTS uint(1 + CORE_PATCHES * CORE_PATCHES)
#define CORE_STEPS 12u
#define CORE_TWIN_SHIFT elvis_real(0.35LF)
#define CORE_MAX_SPAWNED 3u
// Evaluations of one pixel, well below where drivers end loops.
#define CORE_WORK_LIMIT 8000u

struct core_ray {
    // Relative to the reference point, and in the hierarchy's coordinates.
    elvis_vec3 origin, direction;
    vec3 box_origin, box_inverse;
    float box_tolerance;
    // Of points in front of the eye.
    elvis_real least_t;
    elvis_real error;
};

core_ray core_pixel_ray(uint column, uint row) {
    const core_cut_column along = core_cut_begin(elvis_real(column));
    const elvis_real down = elvis_real(row) - along.row0;
    core_ray ray;
    ray.origin = (along.base + down * along.base_row).xyz;
    ray.direction = (along.direction + down * along.direction_row).xyz;
    ray.least_t = -core_reference.w;
    const elvis_vec3 size = (along.size + abs(down * along.base_row)).xyz;
    ray.error = elvis_real(4) * CORE_ROUNDOFF * max(max(size.x, size.y), size.z);
    ray.box_origin = vec3(ray.origin + core_reference_in_hierarchy.xyz);
    const vec3 direction = vec3(ray.direction);
    const vec3 tiny = vec3(1e-30);
    ray.box_inverse = 1.0 / mix(direction, tiny, lessThan(abs(direction), tiny));
    const vec3 far = abs(ray.box_origin) + abs(vec3(core_reference_in_hierarchy.xyz));
    ray.box_tolerance = 16.0 * CORE_FLOAT_ROUNDOFF * max(max(far.x, far.y), far.z);
    return ray;
}

// Where the ray enters the box, a little before; more than anything if it does not meet it in front of the eye.
float core_entry(core_node node, core_ray ray) {
    const vec3 a = (node.lower - ray.box_tolerance - ray.box_origin) * ray.box_inverse;
    const vec3 b = (node.upper + ray.box_tolerance - ray.box_origin) * ray.box_inverse;
    const vec3 low = min(a, b), high = max(a, b);
    const float enter = max(max(low.x, low.y), low.z), leave = min(min(high.x, high.y), high.z);
    const float slack = 1e-5 * (abs(enter) + abs(leave));
    return enter <= leave + slack && leave + slack >= float(ray.least_t) ? enter - slack : 3.3e38;
}

// Element and local face of a leaf of the hierarchy.
uvec2 core_face_of(uint item) {
#ifdef elvis_fetch4_core_faces
    return elvis_fetch4_core_faces(item, 0u).xy;
#else
    return uvec2(item, 0u);
#endif
}

elvis_real core_excess_of(elvis_real u, elvis_real v, bool is_triangle) {
    return is_triangle ? max(max(-u, -v) - elvis_real(1), u + v) : max(abs(u), abs(v)) - elvis_real(1);
}

// Where a start lies.
elvis_vec2 core_start(uint number, bool is_triangle) {
    const uint start = max(number, 1u) - 1u;
    const elvis_real width = elvis_real(2) / elvis_real(CORE_PATCHES);
    const elvis_vec2 patch_number = elvis_vec2(elvis_real(start % uint(CORE_PATCHES)), elvis_real(start / uint(CORE_PATCHES)));
    const elvis_vec2 centre = (patch_number + elvis_real(0.5LF)) * width - elvis_real(1);
    return number > 0u ? centre : elvis_vec2(is_triangle ? elvis_real(-1) / elvis_real(3) : elvis_real(0));
}

void main() {
    const uint column = gl_GlobalInvocationID.x;
    const uint row = core_first_row + gl_WorkGroupID.y;
    const bool is_pixel = column < core_size.x && row < core_size.y;
    const core_ray ray = core_pixel_ray(column, row);

    core_location found;
    found.element = CORE_NO_ELEMENT;
    found.number = 0xffffffffu;
    found.key = 0u;
    found.x = found.y = found.z = elvis_real(0);
    found.is_on_face = found.is_on_crossing_face = false;
    found.n_candidates = found.n_steps = found.n_failures = 0u;
    elvis_real nearest = elvis_real(3.0e38LF), slack = elvis_real(0);
    elvis_real normal_x = elvis_real(0), normal_y = elvis_real(0), normal_z = elvis_real(0);

    uint stack[CORE_STACK_SIZE];
    stack[0] = 0u;
    uint stack_size = is_pixel ? 1u : 0u;
    uint item = CORE_NO_ELEMENT, found_item = CORE_NO_ELEMENT;
    uint start = 0u, steps = 0u, work = 0u;
    elvis_real a = elvis_real(0), b = elvis_real(0);
    // Where to look for twins of the last crossing: from (twin_a, twin_b) by plus and minus the shift.
    uint n_twins = 0u, n_spawned = 0u;
    bool is_twin = false;
    // No second crossing is possible. And whether that had to be doubted of any face.
    bool is_single = false, is_estimated = false;
    elvis_real twin_a = elvis_real(0), twin_b = elvis_real(0), shift_a = elvis_real(0), shift_b = elvis_real(0);
    while ((item != CORE_NO_ELEMENT || stack_size > 0u) && work < CORE_WORK_LIMIT) {
        work += 1u;
        while (item == CORE_NO_ELEMENT && stack_size > 0u) {
            stack_size -= 1u;
            const core_node node = core_fetch_node(stack[stack_size]);
            const bool is_met = core_entry(node, ray) <= float(nearest);
            item = is_met && node.is_leaf ? node.child : CORE_NO_ELEMENT;
            for (uint turn = 0u; turn < (is_met && !node.is_leaf ? 1u : 0u); ++turn) {
                // The nearer one first.
                const bool is_second_nearer =
                    core_entry(core_fetch_node(node.child + 1u), ray) < core_entry(core_fetch_node(node.child), ray);
                stack[stack_size] = node.child + (is_second_nearer ? 0u : 1u);
                stack[stack_size + 1u] = node.child + (is_second_nearer ? 1u : 0u);
                stack_size += 2u;
            }
            start = 0u;
            steps = 0u;
            n_twins = n_spawned = 0u;
            is_twin = false;
            is_single = false;
            const uint local_face = core_face_of(item != CORE_NO_ELEMENT ? item : 0u).y;
            const elvis_vec2 first = core_start(0u, core_face_frame(int(local_face)).is_triangle);
            a = first.x;
            b = first.y;
        }

        // Newton's step: t from the tangent plane, then the step in it.
        const bool is_active = item != CORE_NO_ELEMENT;
        const uvec2 place = core_face_of(is_active ? item : 0u);
        const uint element = place.x;
        const core_face face = core_face_frame(int(place.y));
        const elvis_real half_one = elvis_real(0.5LF);
        const elvis_vec3 half_a = half_one * face.a, half_b = half_one * face.b;
        const elvis_vec3 xi = face.corner + (a + elvis_real(1)) * half_a + (b + elvis_real(1)) * half_b;
        elvis_vec3 x;
        elvis_mat3 jacobian;
        elvis_mapping_jacobian(element, xi, x, jacobian);
        const elvis_vec3 shift = core_reference.xyz - elvis_origin(element);
        const elvis_vec3 origin = shift + ray.origin;
        const elvis_vec3 along_a = jacobian * half_a, along_b = jacobian * half_b;
        const elvis_vec3 normal = cross(along_a, along_b);
        const elvis_real across = dot(normal, ray.direction);
        const elvis_vec3 size = abs(along_a) + abs(along_b);
        const bool is_regular = abs(across) > elvis_real(64) * CORE_ROUNDOFF * length(normal) * length(ray.direction);
        const elvis_real inverse = is_regular ? elvis_real(1) / across : elvis_real(0);
        const elvis_real t = dot(normal, x - origin) * inverse;
        const elvis_vec3 left = origin + t * ray.direction - x;
        const elvis_vec3 row_a = inverse * cross(along_b, ray.direction), row_b = inverse * cross(ray.direction, along_a);
        const elvis_real step_a = dot(row_a, left), step_b = dot(row_b, left);
        const elvis_real step = max(abs(step_a), abs(step_b));
        // Rounding of positions, and what the inverse makes of it.
        const elvis_vec3 terms = abs(shift) + size + abs(x) + abs(t * ray.direction);
        const elvis_vec3 noise = elvis_vec3(ray.error) + elvis_real(4) * CORE_ROUNDOFF * terms;
        const elvis_real error = max(dot(abs(row_a), noise), dot(abs(row_b), noise)) + elvis_real(4) * CORE_ROUNDOFF;
        const elvis_real excess = core_excess_of(a + step_a, b + step_b, face.is_triangle);

        // The bound for this ray: along the direction of the ray, what the remainder has across the face moves along it.
        const elvis_mat3 full = core_full_jacobian(jacobian);
        const elvis_vec3 covector = cross(half_a, half_b);
        const elvis_vec3 ray_in_xi =
            elvis_vec3(dot(cross(full[1], full[2]), ray.direction), dot(cross(full[2], full[0]), ray.direction),
                       dot(cross(full[0], full[1]), ray.direction));
        const elvis_real largest = max(max(abs(ray_in_xi.x), abs(ray_in_xi.y)), abs(ray_in_xi.z));
        const elvis_real oblique = elvis_real(1) + (abs(covector.x) + abs(covector.y) + abs(covector.z)) * largest /
                                                       max(abs(dot(covector, ray_in_xi)), elvis_real(1e-30LF));
        const elvis_vec3 extent = abs(half_a) + abs(half_b);
        const elvis_real stretch = max(max(extent.x, extent.y), extent.z);
        const uvec4 record = elvis_fetch4_core_elements(element, 0u);
        const elvis_real curvature = elvis_real(core_curvature(record.y)) * oblique * stretch * stretch;
        const elvis_real constraint_norm = elvis_real(face.is_triangle ? 2 : 1);
        // The bound holds for starts in the face.
        const bool is_inside = core_excess_of(a, b, face.is_triangle) <= elvis_real(1e-3LF);
        const elvis_real most = constraint_norm * (core_prediction_error(curvature, step) + elvis_real(2) * error);
        const bool has_missed = is_regular && is_inside && excess > most;
        is_single = is_single || (start == 0u && steps == 0u && is_regular && curvature < elvis_real(0.45LF));

        const bool is_first = steps == 0u;
        const bool is_last = steps + 1u == CORE_STEPS;
        const bool has_converged = is_regular && (step <= error || (is_last && step <= elvis_real(64) * error));
        const bool starts_elsewhere =
            is_first && !is_twin && start > 0u && (!is_regular || step * elvis_real(CORE_PATCHES) > elvis_real(5));
        const bool has_left = !is_single && steps >= 3u && excess > elvis_real(0.2LF);
        const bool ends = has_converged || starts_elsewhere || has_left || is_last || has_missed;
        is_estimated = is_estimated || (is_active && start > 0u);
        found.n_steps += is_active ? 1u : 0u;

        const bool is_hit = is_active && has_converged && excess <= elvis_real(2) * error && t > ray.least_t;
        const uint number = record.x;
        const elvis_real width = elvis_real(4) * abs(inverse) * dot(abs(normal), noise);
        const bool is_same = abs(t - nearest) <= max(width, slack);
        // On an edge the face that the ray meets less obliquely has the smaller error; of equals the lower one.
        const bool is_number_lower = number < found.number || (number == found.number && item < found_item);
        const bool is_lower = width < elvis_real(0.5LF) * slack || (is_number_lower && width <= elvis_real(2) * slack);
        const bool is_better = is_hit && (is_same ? is_lower : t < nearest);
        const bool is_other = is_hit && is_same && item != found_item;
        found.n_candidates = is_hit && !is_same && t < nearest ? 1u : found.n_candidates + (is_other ? 1u : 0u);
        found.element = is_better ? element : found.element;
        found.number = is_better ? number : found.number;
        const elvis_vec3 xi_there = xi + step_a * half_a + step_b * half_b;
        found.x = is_better ? xi_there.x : found.x;
        found.y = is_better ? xi_there.y : found.y;
        found.z = is_better ? xi_there.z : found.z;
        found_item = is_better ? item : found_item;
        const bool is_on_edge = excess >= elvis_real(-2) * error;
        found.is_on_face = is_better ? is_on_edge : found.is_on_face;
        found.is_on_crossing_face = is_better ? is_on_edge : found.is_on_crossing_face;
        nearest = is_better ? t : nearest;
        slack = is_better ? width : slack;
        normal_x = is_better ? -sign(across) * normal.x : normal_x;
        normal_y = is_better ? -sign(across) * normal.y : normal_y;
        normal_z = is_better ? -sign(across) * normal.z : normal_z;
        // Did not end although the ray passes close by.
        const bool is_near = step < elvis_real(1e-3LF) && excess < elvis_real(0.05LF) && t > ray.least_t;
        found.n_failures += is_active && is_last && !has_converged && is_near ? 1u : 0u;

        // The direction in the face that projects onto the ray.
        const bool spawns = is_hit && !is_single && n_spawned < CORE_MAX_SPAWNED;
        const elvis_real towards_a = dot(cross(ray.direction, along_b), normal), towards_b = dot(cross(along_a, ray.direction), normal);
        const elvis_real scale = CORE_TWIN_SHIFT / max(max(abs(towards_a), abs(towards_b)), elvis_real(1e-30LF));
        twin_a = spawns ? a + step_a : twin_a;
        twin_b = spawns ? b + step_b : twin_b;
        shift_a = spawns ? scale * towards_a : shift_a;
        shift_b = spawns ? scale * towards_b : shift_b;
        n_twins = spawns ? 2u : n_twins;
        n_spawned += spawns ? 1u : 0u;

        const bool takes_twin = ends && !has_missed && n_twins > 0u;
        const elvis_real side = n_twins == 2u ? elvis_real(1) : elvis_real(-1);
        n_twins -= takes_twin ? 1u : 0u;
        // A face that is missed, or met for the only time, is done with.
        const bool is_done = ends && (has_missed || (is_single && has_converged));
        is_single = is_single && !ends;
        start = is_done ? CORE_STARTS : start + (ends && !is_twin ? 1u : 0u);
        is_twin = ends ? takes_twin : is_twin;
        steps = ends ? 0u : steps + 1u;
        // Steps of more than half a face are cut, and points kept near it: beyond it the mapping need not be one to one.
        const elvis_real cut = step > elvis_real(1) ? elvis_real(1) / step : elvis_real(1);
        const elvis_real reach = elvis_real(1.3LF);
        const elvis_vec2 next = core_start(min(start, CORE_STARTS - 1u), face.is_triangle);
        a = takes_twin ? clamp(twin_a + side * shift_a, -reach, reach) : ends ? next.x : clamp(a + cut * step_a, -reach, reach);
        b = takes_twin ? clamp(twin_b + side * shift_b, -reach, reach) : ends ? next.y : clamp(b + cut * step_b, -reach, reach);
        item = start >= CORE_STARTS && !is_twin ? CORE_NO_ELEMENT : item;
    }
    found.is_cut_short = item != CORE_NO_ELEMENT || stack_size > 0u;

    const bool has_found = found.element != CORE_NO_ELEMENT;
    const elvis_real value = core_shown_value(has_found ? found.element : 0u, elvis_vec3(found.x, found.y, found.z));
    found.is_cut_short = found.is_cut_short || core_has_driver_given_up(core_surface >> 31);
    core_cut_point point;
    point.is_hit = has_found;
    point.t = nearest;
    point.direction = ray.direction;
    point.position = ray.origin + nearest * ray.direction;
    point.error = ray.error;
    const uint pixel = row * core_size.x + column;
    uint n_evaluations = 0u;
    for (uint turn = 0u; turn < (has_found || (is_pixel && (found.n_failures > 0u || found.is_cut_short)) ? 1u : 0u); ++turn) {
        n_evaluations = core_merge(pixel, point, found, value);
    }
    for (uint turn = 0u; turn < (n_evaluations > 0u ? 1u : 0u); ++turn) {
        const elvis_vec3 unit = normalize(elvis_vec3(normal_x, normal_y, normal_z));
        core_normals[3u * pixel] = unit.x;
        core_normals[3u * pixel + 1u] = unit.y;
        core_normals[3u * pixel + 2u] = unit.z;
    }
    // That nothing was found may be for the same reason.
    for (uint turn = 0u; turn < (is_pixel && is_estimated ? 1u : 0u); ++turn) {
        core_marks[pixel].flags |= CORE_FLAG_ESTIMATED;
    }

    const uint all_evaluations = subgroupAdd(n_evaluations);
    const uint all_steps = subgroupAdd(found.n_steps);
    const uint all_failures = subgroupAdd(found.n_failures);
    if (subgroupElect()) {
        atomicAdd(core_counts[0], all_evaluations);
        atomicAdd(core_counts[1], all_steps);
        atomicAdd(core_counts[2], all_failures);
    }
}
