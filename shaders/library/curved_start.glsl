// Where a ray enters an element through one of its faces, in elements so curved that a point outside of them may be taken for the ray's
// (core_part_enter): Newton's method for a point of the face and the parameter, from several points of the face. Which of them are found is
// no certainty, but each one that is found is an entry.
//
// The kernel brings library/ray_part.glsl.

#define CORE_FACE_STARTS 5u
#define CORE_FACE_STEPS 10u

struct core_face_entry {
    bool is_found;
    elvis_real t, error;
    uint n_evaluations;
};

// The middle of the face, for `start` 0, or a point near the vertex of it with that number, from 1. False if there are fewer.
bool core_point_of_face(int face, uint start, out elvis_vec3 point) {
    const elvis_vec4 constraint = core_face_constraint(face);
    elvis_vec3 sum = elvis_vec3(0), vertex = elvis_vec3(0);
    uint n = 0u;
    for (uint corner = 0u; corner < 8u; ++corner) {
        const elvis_vec3 at = core_cube_corner(corner);
        const bool is_vertex = core_is_vertex(at) && dot(constraint.xyz, at) + constraint.w == elvis_real(0);
        n += is_vertex ? 1u : 0u;
        sum += is_vertex ? at : elvis_vec3(0);
        vertex = is_vertex && n == start ? at : vertex;
    }
    const elvis_vec3 middle = sum / elvis_real(n);
    point = start == 0u ? middle : mix(middle, vertex, elvis_real(0.7LF));
    return start <= n;
}

// `start`: which of the points, below CORE_FACE_STARTS.
core_face_entry core_enter_face(core_walk_ray ray, uint element, elvis_real curvature, int face, uint start) {
    const elvis_vec4 constraint = core_face_constraint(face);
    elvis_vec3 first;
    bool is_over = !core_point_of_face(face, start, first);
    elvis_real x = first.x, y = first.y, z = first.z;
    core_face_entry entry = core_face_entry(false, elvis_real(0), elvis_real(0), 0u);
    while (!is_over && entry.n_evaluations < CORE_FACE_STEPS) {
        elvis_vec3 position;
        elvis_mat3 jacobian;
        elvis_mapping_jacobian(element, elvis_vec3(x, y, z), position, jacobian);
        const core_frame frame = core_frame_at(position, jacobian, ray.error);
        core_ray_model model;
        model.slope = core_to_xi(frame, ray.direction);
        // Newton's step is the same from any parameter; the nearest one rounds least.
        const elvis_real near =
            dot(position - core_part_target(ray, element, elvis_real(0)), ray.direction) / dot(ray.direction, ray.direction);
        model.anchor = near;
        model.step = core_to_xi(frame, core_part_target(ray, element, near) - position);
        model.at = elvis_vec3(x, y, z) + model.step;
        model.noise = frame.xi_error;
        const elvis_real rate = dot(constraint.xyz, model.slope);
        const elvis_real root = near - (dot(constraint.xyz, model.at) + constraint.w) / rate;
        const core_root_error error = core_root_error_at(model, frame, curvature, face, root);
        const elvis_real size = core_model_step(model, root);
        const elvis_vec3 next = model.at + (root - near) * model.slope;
        entry.n_evaluations += 1u;
        const bool is_there = frame.is_sound && core_is_near(curvature, size) && error.distance <= ray.tolerance * ray.speed;
        const elvis_real beyond = core_excess(next.x, next.y, next.z);
        entry.is_found = is_there && rate < elvis_real(0) &&
                         beyond <= CORE_CONSTRAINT_NORM * (elvis_real(2) * core_prediction_error(curvature, size) + core_max_norm(frame.xi_error));
        entry.t = root;
        entry.error = error.parameter;
        // Far outside it is another face's.
        is_over = is_there || !frame.is_sound || !core_is_finite(size) || size > elvis_real(8);
        x = next.x;
        y = next.y;
        z = next.z;
        core_project(x, y, z);
        if (is_over) {
            break;
        }
    }
    return entry;
}
