// Where more than one element of a class holds the point that a pixel shows: one of those that are not shown, in a list for
// cut_surface/other_values.comp.

struct core_other_element {
    elvis_real x, y, z;
    uint element, pixel;
};

layout(set = 0, binding = CORE_OTHERS_BINDING, std430) buffer core_others_block {
    uint core_n_others;
    core_other_element core_others[];
};
