// Points that may lie in elements of a class which the search has dismissed (cut_surface/locate.glsl): a list for
// cut_surface/open_points.comp.

struct core_open_point {
    uint pixel;
    // Elements that may hold it: one or two, the other one being CORE_NO_ELEMENT if there is none. If the first is, more than two may.
    uint element, other;
};

layout(set = 0, binding = CORE_OPEN_POINTS_BINDING, std430) buffer core_open_points_block {
    uint core_n_open_points;
    core_open_point core_open_points[];
};
