// Points that may lie in elements of a class which the search has dismissed (cut_surface/locate.glsl): a list for
// cut_surface/open_points.comp.

struct core_open_point {
    uint pixel;
    // The element that may hold it, or CORE_NO_ELEMENT: several may.
    uint element;
};

layout(set = 0, binding = CORE_OPEN_POINTS_BINDING, std430) buffer core_open_points_block {
    uint core_n_open_points;
    core_open_point core_open_points[];
};
