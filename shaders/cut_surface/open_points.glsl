// Pixels whose point may lie in an element of a class that the search has dismissed (cut_surface/locate.glsl): a list for
// cut_surface/open_points.comp.

layout(set = 0, binding = CORE_OPEN_POINTS_BINDING, std430) buffer core_open_points_block {
    uint core_n_open_points;
    uint core_open_points[];
};
