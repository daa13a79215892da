// The mapping of an element, linearized at a point, for what lies relative to the picture's reference point.

#ifndef CORE_ELEMENT_IMAGE
#define CORE_ELEMENT_IMAGE

#include "element/face_frame.glsl"
#include "picture/cut_frame.glsl"

struct core_element_image {
    uint element;
    elvis_vec3 xi;
    // Relative to elvis_origin.
    elvis_vec3 position;
    elvis_mat3 jacobian;
    // From elvis_origin to the reference point, and rounding of that.
    elvis_vec3 shift;
    elvis_real shift_error;
    // element/prediction.glsl
    elvis_real curvature;
};

core_element_image core_element_image_at(uint element, elvis_vec3 xi) {
    core_element_image image;
    image.element = element;
    image.xi = xi;
    elvis_mapping_jacobian(element, xi, image.position, image.jacobian);
    image.jacobian = core_full_jacobian(image.jacobian);
    image.shift = core_reference.xyz - elvis_origin(element);
    image.shift_error = CORE_ROUNDOFF * max(max(abs(image.shift.x), abs(image.shift.y)), abs(image.shift.z));
    image.curvature = elvis_fetch_core_curvatures(element, 0u);
    return image;
}

#endif
