// What kernels are told that show points of a cut surface (core/render/cut_surface/point_parameters.hpp).

layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    // Of the list of tiles, or of points.
    uint core_first;
    // Counted from 1; 0 is no surface.
    uint core_surface_number;
    // Components of the field: the only one, or all that make up the length of the vector.
    uint core_first_component;
    uint core_end_component;
    // Elements that share a point may have other values there: one of them is listed.
    uint core_lists_others;
    // Of values: what makes no difference to the picture.
    float core_value_tolerance;
    // core_hit_point
    float core_most_error;
    uint core_wants_places;
};
