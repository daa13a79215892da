// Rational Bezier hexahedra: knot spans of NURBS volumes.
//
// A record of `points` holds, for each channel (w x, w y, w z, w, then w f for every component), the (P+1)(Q+1)(R+1) Bezier
// coefficients times their binomials, the first direction fastest (plugin.cpp, fill_buffer). NURBS_P, NURBS_Q, NURBS_R are the degrees.

#define NURBS_N_POINTS uint((NURBS_P + 1) * (NURBS_Q + 1) * (NURBS_R + 1))

// One channel and its derivatives by t = (1 + xi) / 2, as (value, by t1, by t2, by t3).
//
// Horner's scheme for sum c_i t^i s^(p-i), s = 1 - t (Farin, Curves and Surfaces for CAGD): v <- s v + t^i c_i. It divides by nothing and
// is stable in [0, 1]. Derivatives along: v' <- s v' - v + i t^(i-1) c_i. State in scalars, since some drivers spoil vectors in loops.
elvis_vec4 nurbs_channel(uint element, uint channel, elvis_vec3 t) {
    elvis_vec3 s = elvis_vec3(1) - t;
    uint place = channel * NURBS_N_POINTS;
    elvis_real v = elvis_real(0), v1 = elvis_real(0), v2 = elvis_real(0), v3 = elvis_real(0);
    elvis_real power3 = elvis_real(1), slope3 = elvis_real(0);
    for (int k = 0; k <= NURBS_R; ++k) {
        elvis_real b = elvis_real(0), b1 = elvis_real(0), b2 = elvis_real(0);
        elvis_real power2 = elvis_real(1), slope2 = elvis_real(0);
        for (int j = 0; j <= NURBS_Q; ++j) {
            elvis_real a = elvis_real(0), a1 = elvis_real(0);
            elvis_real power1 = elvis_real(1), slope1 = elvis_real(0);
            for (int i = 0; i <= NURBS_P; ++i) {
                elvis_real c = elvis_fetch_points(element, place);
                place += 1u;
                a1 = s.x * a1 - a + slope1 * c;
                a = s.x * a + power1 * c;
                slope1 = t.x * slope1 + power1;
                power1 *= t.x;
            }
            b2 = s.y * b2 - b + slope2 * a;
            b = s.y * b + power2 * a;
            b1 = s.y * b1 + power2 * a1;
            slope2 = t.y * slope2 + power2;
            power2 *= t.y;
        }
        v3 = s.z * v3 - v + slope3 * b;
        v = s.z * v + power3 * b;
        v1 = s.z * v1 + power3 * b1;
        v2 = s.z * v2 + power3 * b2;
        slope3 = t.z * slope3 + power3;
        power3 *= t.z;
    }
    return elvis_vec4(v, v1, v2, v3);
}

elvis_vec3 nurbs_parameter(elvis_vec3 xi) { return elvis_real(0.5LF) * (elvis_vec3(1) + xi); }

// The quotient of a channel by the weight's, with derivatives by xi: (a/w)' = (a' - (a/w) w') / w, and dt/dxi = 1/2.
elvis_vec4 nurbs_quotient(elvis_vec4 channel, elvis_vec4 weight) {
    elvis_real value = channel.x / weight.x;
    return elvis_vec4(value, elvis_real(0.5LF) * (channel.yzw - value * weight.yzw) / weight.x);
}

void elvis_mapping_jacobian(uint element, elvis_vec3 xi, out elvis_vec3 x, out elvis_mat3 jacobian) {
    elvis_vec3 t = nurbs_parameter(xi);
    elvis_vec4 weight = nurbs_channel(element, 3u, t);
    elvis_vec4 x1 = nurbs_quotient(nurbs_channel(element, 0u, t), weight);
    elvis_vec4 x2 = nurbs_quotient(nurbs_channel(element, 1u, t), weight);
    elvis_vec4 x3 = nurbs_quotient(nurbs_channel(element, 2u, t), weight);
    x = elvis_vec3(x1.x, x2.x, x3.x);
    jacobian = transpose(elvis_mat3(x1.yzw, x2.yzw, x3.yzw));
}

elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) {
    elvis_vec3 x;
    elvis_mat3 jacobian;
    elvis_mapping_jacobian(element, xi, x, jacobian);
    return x;
}

elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi) {
    elvis_vec3 x;
    elvis_mat3 jacobian;
    elvis_mapping_jacobian(element, xi, x, jacobian);
    return jacobian;
}

void elvis_field_gradient(uint element, elvis_vec3 xi, uint component, out elvis_real value, out elvis_vec3 gradient) {
    elvis_vec3 t = nurbs_parameter(xi);
    elvis_vec4 f = nurbs_quotient(nurbs_channel(element, 4u + component, t), nurbs_channel(element, 3u, t));
    value = f.x;
    gradient = f.yzw;
}

elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component) {
    elvis_real value;
    elvis_vec3 gradient;
    elvis_field_gradient(element, xi, component, value, gradient);
    return value;
}
