// Trilinear hexahedra with a field of any order in products of Legendre polynomials.
//
// Row k of a record of `corners` holds corner k: x, y, z. A record of `modes` holds the coefficients (mesh_file.hpp).
// MY_SOLVER_ORDER is a constant of the class (plugin.cpp, get_class_field).

// Reference coordinates of corner k, in the order of elvis/element.h.
elvis_vec3 my_solver_corner(uint k) {
    return elvis_vec3(((k ^ (k >> 1u)) & 1u) != 0u ? 1 : -1, (k & 2u) != 0u ? 1 : -1, (k & 4u) != 0u ? 1 : -1);
}

elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) {
    elvis_vec3 x = elvis_vec3(0);
    for (uint k = 0u; k < 8u; ++k) {
        elvis_vec3 factor = elvis_vec3(1) + my_solver_corner(k) * xi;
        x += factor.x * factor.y * factor.z * elvis_fetch4_corners(element, k).xyz;
    }
    return x / elvis_real(8);
}

// Column j is dx/dxi_j.
elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi) {
    elvis_mat3 jacobian = elvis_mat3(0);
    for (uint k = 0u; k < 8u; ++k) {
        elvis_vec3 corner = my_solver_corner(k);
        elvis_vec3 factor = elvis_vec3(1) + corner * xi;
        elvis_vec3 x = elvis_fetch4_corners(element, k).xyz;
        jacobian[0] += corner.x * factor.y * factor.z * x;
        jacobian[1] += factor.x * corner.y * factor.z * x;
        jacobian[2] += factor.x * factor.y * corner.z * x;
    }
    return jacobian / elvis_real(8);
}

// P_(n+1) from P_n and P_(n-1): (n+1) P_(n+1) = (2n+1) x P_n - n P_(n-1).
elvis_real my_solver_next(int n, elvis_real x, elvis_real p, elvis_real before) {
    return (elvis_real(2 * n + 1) * x * p - elvis_real(n) * before) / elvis_real(n + 1);
}

elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component) {
    elvis_real sum = elvis_real(0);
    uint mode = 0u;
    elvis_real p = elvis_real(1), p_before = elvis_real(0);
    for (int i = 0; i <= MY_SOLVER_ORDER; ++i) {
        elvis_real q = elvis_real(1), q_before = elvis_real(0);
        for (int j = 0; j <= MY_SOLVER_ORDER; ++j) {
            elvis_real run = elvis_real(0);
            elvis_real r = elvis_real(1), r_before = elvis_real(0);
            for (int k = 0; k <= MY_SOLVER_ORDER; ++k) {
                run += elvis_fetch_modes(element, mode) * r;
                mode += 1u;
                elvis_real r_next = my_solver_next(k, xi.z, r, r_before);
                r_before = r;
                r = r_next;
            }
            sum += p * q * run;
            elvis_real q_next = my_solver_next(j, xi.y, q, q_before);
            q_before = q;
            q = q_next;
        }
        elvis_real p_next = my_solver_next(i, xi.x, p, p_before);
        p_before = p;
        p = p_next;
    }
    return sum;
}
