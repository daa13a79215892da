// A linear model of the shown field over a cube in reference coordinates, as far as that lies in the element's shape.

#include "element/shape_region.glsl"
#include "field/shown_model.glsl"

// From xi, within `radius`, and `beyond` the corners. `reach`: how far the model's linear function gets from its value at xi.
//
// Patches have four corners: of the cube below and above, and the middles of four faces, which estimates look at, too.
core_model core_model_in_cube(uint element, elvis_vec3 xi, elvis_vec3 middle, elvis_real half_side, elvis_real beyond, elvis_real radius,
                              out elvis_real reach) {
    core_model model;
    elvis_real remainder = elvis_real(0), value;
    reach = elvis_real(0);
    for (int level = -1; level <= 1; ++level) {
        const elvis_real side = level == 0 ? elvis_real(0) : half_side, up = elvis_real(level) * half_side;
        const core_region region = core_region(core_projected(middle + elvis_vec3(-half_side, -side, up)) - xi,
                                               core_projected(middle + elvis_vec3(half_side, side, up)) - xi,
                                               core_projected(middle + elvis_vec3(-side, half_side, up)) - xi,
                                               core_projected(middle + elvis_vec3(side, -half_side, up)) - xi, beyond, radius);
        model = core_shown_model(element, xi, region, value);
        remainder = max(remainder, model.remainder);
        reach = max(reach, core_model_reach(model, region));
    }
    model.remainder = remainder;
    return model;
}
