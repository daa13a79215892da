// Where a ray enters an element through one of its faces, in elements so curved that a point outside of them may be taken for the ray's
// (core_segment_enter): Newton's method for a point of the face and the parameter, from several points of the face. Not all places where it
// enters need be found; at each that is found it does enter.
//
// The kernel brings segments/segment.glsl.

#define CORE_EDGE_START 5u
#define CORE_EXIT_START (CORE_EDGE_START + uint(CORE_N_FACES))
#define CORE_FACE_STARTS (CORE_EXIT_START + 2u)
#define CORE_FACE_STEPS 10u

struct core_entered_face {
    bool is_found;
    elvis_real t, error;
    uint n_evaluations;
};

// For `start` 0 the middle of the face, then a point near each of its vertices, and from CORE_EDGE_START near the middle of the edge it
// shares with the face of that number. False if there is none.
bool core_point_of_face(int face, uint start, out elvis_vec3 point) {
    const elvis_vec4 constraint = core_face_constraint(face);
    const bool is_of_edge = start >= CORE_EDGE_START;
    const elvis_vec4 other = core_face_constraint(is_of_edge ? int(start - CORE_EDGE_START) : face);
    elvis_vec3 sum = elvis_vec3(0), edge_sum = elvis_vec3(0), vertex = elvis_vec3(0);
    uint n = 0u, n_of_edge = 0u;
    for (uint corner = 0u; corner < 8u; ++corner) {
        const elvis_vec3 at = core_cube_corner(corner);
        const bool is_vertex = core_is_vertex(at) && dot(constraint.xyz, at) + constraint.w == elvis_real(0);
        const bool is_shared = is_vertex && dot(other.xyz, at) + other.w == elvis_real(0);
        n += is_vertex ? 1u : 0u;
        n_of_edge += is_shared ? 1u : 0u;
        sum += is_vertex ? at : elvis_vec3(0);
        edge_sum += is_shared ? at : elvis_vec3(0);
        vertex = is_vertex && n == start ? at : vertex;
    }
    const elvis_vec3 middle = sum / elvis_real(n);
    const elvis_vec3 outer = is_of_edge ? elvis_real(0.5LF) * edge_sum : start == 0u ? middle : vertex;
    point = mix(middle, outer, elvis_real(0.7LF));
    return is_of_edge ? n_of_edge == 2u : start <= n;
}

// Where a ray leaves through a face, and its direction along the face.
struct core_face_exit {
    bool is_found;
    elvis_vec3 at, along;
};

// From there to where the face ends; `sense`: 1 with the ray, -1 against it.
elvis_vec3 core_end_of_face(core_face_exit face_exit, elvis_real sense) {
    elvis_real way = elvis_real(8);
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const elvis_vec4 constraint = core_face_constraint(face);
        const elvis_real rate = sense * dot(constraint.xyz, face_exit.along), value = dot(constraint.xyz, face_exit.at) + constraint.w;
        // The face itself is followed but for rounding.
        const bool is_bound = rate > elvis_real(1e-4LF);
        way = is_bound ? min(way, max(-value / rate, elvis_real(0))) : way;
    }
    return face_exit.at + sense * way * face_exit.along;
}

// `start`: which of the points, below CORE_FACE_STARTS. The last two lie before and behind the point where the ray leaves through the face,
// if an earlier start has found that: where the face is bent, the ray may have entered through it just before, or come back through it.
core_entered_face core_enter_face(core_traced_ray ray, uint element, elvis_real curvature, int face, uint start,
                                  inout core_face_exit face_exit) {
    const elvis_vec4 constraint = core_face_constraint(face);
    const bool is_from_exit = start >= CORE_EXIT_START;
    elvis_vec3 first;
    const bool has_point = core_point_of_face(face, start, first);
    if (is_from_exit) {
        first = core_end_of_face(face_exit, start == CORE_EXIT_START ? elvis_real(-1) : elvis_real(1));
    }
    bool is_over = is_from_exit ? !face_exit.is_found : !has_point;
    // A root far from a start is another start's; one far outside is another face's.
    const elvis_real first_reach = is_from_exit ? elvis_real(8) : elvis_real(1);
    elvis_real x = first.x, y = first.y, z = first.z;
    core_entered_face entered = core_entered_face(false, elvis_real(0), elvis_real(0), 0u);
    while (!is_over && entered.n_evaluations < CORE_FACE_STEPS) {
        elvis_vec3 position;
        elvis_mat3 jacobian;
        elvis_mapping_jacobian(element, elvis_vec3(x, y, z), position, jacobian);
        const core_frame frame = core_frame_at(position, jacobian, ray.error);
        core_ray_model model;
        model.slope = core_to_xi(frame, ray.direction);
        // Newton's step is the same from any parameter; the nearest one rounds least.
        const elvis_real near =
            dot(position - core_segment_target(ray, element, elvis_real(0)), ray.direction) / dot(ray.direction, ray.direction);
        model.anchor = near;
        model.newton_step = core_to_xi(frame, core_segment_target(ray, element, near) - position);
        model.at = elvis_vec3(x, y, z) + model.newton_step;
        model.noise = frame.xi_error;
        const elvis_real rate = dot(constraint.xyz, model.slope);
        const elvis_real root = near - (dot(constraint.xyz, model.at) + constraint.w) / rate;
        const core_root_error error = core_root_error_at(model, frame, curvature, face, root);
        const elvis_real size = core_model_step(model, root);
        const elvis_vec3 next = model.at + (root - near) * model.slope;
        entered.n_evaluations += 1u;
        const bool is_there = frame.is_sound && core_is_near(curvature, size) && error.distance <= ray.tolerance * ray.speed;
        const elvis_real beyond = core_excess(next.x, next.y, next.z);
        const elvis_real slack = elvis_real(2) * core_prediction_error(curvature, size) + core_max_norm(frame.xi_error);
        const bool is_on_face = is_there && beyond <= CORE_CONSTRAINT_NORM * slack;
        if (is_on_face && rate > elvis_real(0)) {
            const elvis_vec3 along = model.slope - rate / dot(constraint.xyz, constraint.xyz) * constraint.xyz;
            face_exit = core_face_exit(true, next, along / core_max_norm(along));
        }
        entered.is_found = is_on_face && rate < elvis_real(0);
        entered.t = root;
        entered.error = error.parameter;
        const elvis_real most = entered.n_evaluations == 1u ? first_reach : elvis_real(8);
        is_over = is_there || !frame.is_sound || !core_is_finite(size) || size > most;
        x = next.x;
        y = next.y;
        z = next.z;
        core_project(x, y, z);
        if (is_over) {
            break;
        }
    }
    return entered;
}
