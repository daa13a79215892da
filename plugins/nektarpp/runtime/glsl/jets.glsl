// Functions of two variables x and t at a point, with derivatives along two directions: `o` ("own"), along which x grows by 1 and t
// stays, and `l` ("later"), along which x grows by 1/2 and t falls by 1/2. A collapsed direction's polynomial t^n P_n(x/t) changes
// so with its own reference coordinate, and with those of the directions that collapse it. Functions of one variable use `o` alone.
struct nektar_jet1 {
    elvis_real v, o, l;
};
struct nektar_jet2 {
    elvis_real v, o, l, oo, ol, ll;
};

elvis_real nektar_times(elvis_real a, elvis_real b) { return a * b; }
nektar_jet1 nektar_times(nektar_jet1 a, nektar_jet1 b) {
    return nektar_jet1(a.v * b.v, a.o * b.v + a.v * b.o, a.l * b.v + a.v * b.l);
}
nektar_jet2 nektar_times(nektar_jet2 a, nektar_jet2 b) {
    return nektar_jet2(a.v * b.v, a.o * b.v + a.v * b.o, a.l * b.v + a.v * b.l,
                       a.oo * b.v + elvis_real(2) * a.o * b.o + a.v * b.oo, a.ol * b.v + a.o * b.l + a.l * b.o + a.v * b.ol,
                       a.ll * b.v + elvis_real(2) * a.l * b.l + a.v * b.ll);
}

// (A, B, C) of P_{n+1} = (A + B x) P_n - C P_{n-1} for the Jacobi polynomials P^{a,b} (Abramowitz & Stegun 22.7.1). For literal
// arguments the compiler computes them.
elvis_vec3 nektar_jacobi(int a, int b, int n) {
    if (n == 0)
        return elvis_vec3(elvis_real(a - b) * elvis_real(0.5LF), elvis_real(a + b + 2) * elvis_real(0.5LF), 0);
    elvis_real s = elvis_real(2 * n + a + b);
    elvis_real divisor = elvis_real(2 * (n + 1) * (n + a + b + 1)) * s;
    return elvis_vec3(elvis_real(a * a - b * b) * (s + elvis_real(1)), s * (s + elvis_real(1)) * (s + elvis_real(2)),
                      elvis_real(2 * (n + a) * (n + b)) * (s + elvis_real(2))) /
           divisor;
}

// The next of S_n = start t^n P_n(x/t): S_{n+1} = (A t + B x) S_n - C t^2 S_{n-1}, differentiated by the product rule. Along `later`
// A t + B x grows by (B - A)/2 and t^2 falls by t.
elvis_real nektar_next(elvis_vec3 k, elvis_real x, elvis_real t, elvis_real s, elvis_real before) {
    return (k[0] * t + k[1] * x) * s - k[2] * t * t * before;
}
nektar_jet1 nektar_next(elvis_vec3 k, elvis_real x, elvis_real t, nektar_jet1 s, nektar_jet1 before) {
    elvis_real factor = k[0] * t + k[1] * x, slope = (k[1] - k[0]) * elvis_real(0.5LF), tail = k[2] * t, tail_t = tail * t;
    return nektar_jet1(factor * s.v - tail_t * before.v, k[1] * s.v + factor * s.o - tail_t * before.o,
                       slope * s.v + factor * s.l - tail_t * before.l + tail * before.v);
}
nektar_jet2 nektar_next(elvis_vec3 k, elvis_real x, elvis_real t, nektar_jet2 s, nektar_jet2 before) {
    elvis_real factor = k[0] * t + k[1] * x, slope = (k[1] - k[0]) * elvis_real(0.5LF), tail = k[2] * t, tail_t = tail * t;
    return nektar_jet2(factor * s.v - tail_t * before.v, k[1] * s.v + factor * s.o - tail_t * before.o,
                       slope * s.v + factor * s.l - tail_t * before.l + tail * before.v,
                       elvis_real(2) * k[1] * s.o + factor * s.oo - tail_t * before.oo,
                       k[1] * s.l + slope * s.o + factor * s.ol - tail_t * before.ol + tail * before.o,
                       elvis_real(2) * slope * s.l + factor * s.ll - tail_t * before.ll + elvis_real(2) * tail * before.l -
                           k[2] * elvis_real(0.5LF) * before.v);
}

// A pyramid's collapsed coordinate x/t. At the apex it is -1 by convention. Far outside, where t is small, it is kept from growing
// so large that its powers overflow.
elvis_real nektar_eta(elvis_real x, elvis_real t, elvis_real limit) {
    elvis_real eta = x / (t == elvis_real(0) ? elvis_real(1) : t);
    return t == elvis_real(0) ? elvis_real(-1) : clamp(eta, -limit, limit);
}
