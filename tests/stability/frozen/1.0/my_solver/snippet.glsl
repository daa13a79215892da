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

// The same sums with derivatives beside the values: P'_(n+1) = P'_(n-1) + (2n+1) P_n.
void elvis_field_gradient(uint element, elvis_vec3 xi, uint component, out elvis_real value, out elvis_vec3 gradient) {
    elvis_real sum = elvis_real(0), by_x = elvis_real(0), by_y = elvis_real(0), by_z = elvis_real(0);
    uint mode = 0u;
    elvis_real p = elvis_real(1), p_before = elvis_real(0), dp = elvis_real(0), dp_before = elvis_real(0);
    for (int i = 0; i <= MY_SOLVER_ORDER; ++i) {
        elvis_real q = elvis_real(1), q_before = elvis_real(0), dq = elvis_real(0), dq_before = elvis_real(0);
        for (int j = 0; j <= MY_SOLVER_ORDER; ++j) {
            elvis_real run = elvis_real(0), run_by_z = elvis_real(0);
            elvis_real r = elvis_real(1), r_before = elvis_real(0), dr = elvis_real(0), dr_before = elvis_real(0);
            for (int k = 0; k <= MY_SOLVER_ORDER; ++k) {
                elvis_real coefficient = elvis_fetch_modes(element, mode);
                mode += 1u;
                run += coefficient * r;
                run_by_z += coefficient * dr;
                elvis_real dr_next = dr_before + elvis_real(2 * k + 1) * r;
                elvis_real r_next = my_solver_next(k, xi.z, r, r_before);
                dr_before = dr;
                dr = dr_next;
                r_before = r;
                r = r_next;
            }
            sum += p * q * run;
            by_x += dp * q * run;
            by_y += p * dq * run;
            by_z += p * q * run_by_z;
            elvis_real dq_next = dq_before + elvis_real(2 * j + 1) * q;
            elvis_real q_next = my_solver_next(j, xi.y, q, q_before);
            dq_before = dq;
            dq = dq_next;
            q_before = q;
            q = q_next;
        }
        elvis_real dp_next = dp_before + elvis_real(2 * i + 1) * p;
        elvis_real p_next = my_solver_next(i, xi.x, p, p_before);
        dp_before = dp;
        dp = dp_next;
        p_before = p;
        p = p_next;
    }
    value = sum;
    gradient = elvis_vec3(by_x, by_y, by_z);
}
