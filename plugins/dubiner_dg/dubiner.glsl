// Sums of Dubiner's modes on the tetrahedron, by recurrences without division by coordinates; see basis.hpp.

// A polynomial at a point: value, gradient, second derivatives xx yy zz and yz xz xy. What a caller does not use costs nothing.
struct dubiner_jet {
    elvis_real value;
    elvis_vec3 gradient, squares, mixed;
};

dubiner_jet dubiner_constant(elvis_real value) {
    return dubiner_jet(value, elvis_vec3(0), elvis_vec3(0), elvis_vec3(0));
}

dubiner_jet dubiner_linear(elvis_real constant, elvis_vec3 slope, elvis_vec3 xi) {
    return dubiner_jet(constant + dot(slope, xi), slope, elvis_vec3(0), elvis_vec3(0));
}

dubiner_jet dubiner_product(dubiner_jet a, dubiner_jet b) {
    return dubiner_jet(a.value * b.value, a.value * b.gradient + b.value * a.gradient,
                       a.value * b.squares + elvis_real(2) * a.gradient * b.gradient + b.value * a.squares,
                       a.value * b.mixed + b.value * a.mixed + a.gradient.yxx * b.gradient.zzy + a.gradient.zzy * b.gradient.yxx);
}

// s x + t y
dubiner_jet dubiner_combination(elvis_real s, dubiner_jet x, elvis_real t, dubiner_jet y) {
    return dubiner_jet(s * x.value + t * y.value, s * x.gradient + t * y.gradient, s * x.squares + t * y.squares,
                       s * x.mixed + t * y.mixed);
}

dubiner_jet dubiner_zero() { return dubiner_constant(elvis_real(0)); }

dubiner_jet dubiner_scaled(elvis_real factor, dubiner_jet jet) {
    return dubiner_jet(factor * jet.value, factor * jet.gradient, factor * jet.squares, factor * jet.mixed);
}

// constant + slope z
dubiner_jet dubiner_linear_in_z(elvis_real constant, elvis_real slope, elvis_vec3 xi) {
    return dubiner_linear(constant, elvis_vec3(elvis_real(0), elvis_real(0), slope), xi);
}

// Kirby's factors 1 to 5.
struct dubiner_factors {
    dubiner_jet f1, f2, f3, f4, f5;
};

dubiner_factors dubiner_factors_at(elvis_vec3 xi) {
    const elvis_real none = elvis_real(0), half_ = elvis_real(0.5);
    dubiner_factors f;
    f.f1 = dubiner_linear(elvis_real(1), elvis_vec3(elvis_real(1), half_, half_), xi);
    f.f2 = dubiner_linear(none, elvis_vec3(none, half_, half_), xi);
    f.f2 = dubiner_product(f.f2, f.f2);
    f.f3 = dubiner_linear(half_, elvis_vec3(none, elvis_real(1), half_), xi);
    f.f4 = dubiner_linear(half_, elvis_vec3(none, none, -half_), xi);
    f.f5 = dubiner_product(f.f4, f.f4);
    return f;
}

struct dubiner_map {
    dubiner_jet x, y, z;
};

elvis_vec3 dubiner_position(dubiner_map map) { return elvis_vec3(map.x.value, map.y.value, map.z.value); }
elvis_mat3 dubiner_jacobian(dubiner_map map) { return transpose(elvis_mat3(map.x.gradient, map.y.gradient, map.z.gradient)); }

#include "dubiner_modes.glsl"

elvis_mat3 dubiner_hessian(dubiner_jet jet) {
    elvis_vec3 d = jet.squares, m = jet.mixed;
    return elvis_mat3(elvis_vec3(d.x, m.z, m.y), elvis_vec3(m.z, d.y, m.x), elvis_vec3(m.y, m.x, d.z));
}

elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) {
    return dubiner_position(dubiner_mapping(element, xi));
}

void elvis_mapping_jacobian(uint element, elvis_vec3 xi, out elvis_vec3 x, out elvis_mat3 jacobian) {
    dubiner_map map = dubiner_mapping(element, xi);
    x = dubiner_position(map);
    jacobian = dubiner_jacobian(map);
}

elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi) {
    return dubiner_jacobian(dubiner_mapping(element, xi));
}

void elvis_mapping_hessian(uint element, elvis_vec3 xi, out elvis_vec3 x, out elvis_mat3 jacobian, out elvis_mat3 hessian_x,
                           out elvis_mat3 hessian_y, out elvis_mat3 hessian_z) {
    dubiner_map map = dubiner_mapping(element, xi);
    x = dubiner_position(map);
    jacobian = dubiner_jacobian(map);
    hessian_x = dubiner_hessian(map.x);
    hessian_y = dubiner_hessian(map.y);
    hessian_z = dubiner_hessian(map.z);
}

elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component) {
    return dubiner_field(element, component, xi).value;
}

void elvis_field_gradient(uint element, elvis_vec3 xi, uint component, out elvis_real value, out elvis_vec3 gradient) {
    dubiner_jet jet = dubiner_field(element, component, xi);
    value = jet.value;
    gradient = jet.gradient;
}

void elvis_field_hessian(uint element, elvis_vec3 xi, uint component, out elvis_real value, out elvis_vec3 gradient,
                         out elvis_mat3 hessian) {
    dubiner_jet jet = dubiner_field(element, component, xi);
    value = jet.value;
    gradient = jet.gradient;
    hessian = dubiner_hessian(jet);
}
