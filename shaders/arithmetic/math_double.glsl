// What math.glsl needs in double precision.

#define CORE_HALF 0.5LF
// exp overflows above 709.78 and vanishes below -745.14.
#define CORE_EXP_LIMIT 750
#define CORE_LOG2_E 1.44269504088896338700LF
// log 2 in two parts, the first with few enough bits that its product with an exponent is exact.
#define CORE_EXP_LN2_HIGH 6.93147180369123816490e-1LF
#define CORE_EXP_LN2_LOW 1.90821492927058770002e-10LF
#define CORE_LN2_HIGH 6.93147180369123816490e-1LF
#define CORE_LN2_LOW 1.90821492927058770002e-10LF
#define CORE_POW_LN2_HIGH 0.6931471805598903LF
#define CORE_POW_LN2_LOW 5.497923018708371e-14LF
#define CORE_THIRD 0.333333333333333314829616256247LF
#define CORE_THIRD_LOW 1.850371707708594e-17LF
// 2^27 + 1 cuts a number in two halves of 26 bits (Veltkamp).
#define CORE_SPLITTER 134217729.0LF
#define CORE_SIN_LIMIT 1.6e6LF
#define CORE_SIN_1 -1.66666666666666324348e-1LF
#define CORE_LARGE 1e150LF
#define CORE_TINY 1e-290LF

#define CORE_ATAN_HALF 4.63647609000806093515e-1LF
#define CORE_ATAN_HALF_LOW 2.26987774529616870924e-17LF
#define CORE_PI_4 7.85398163397448278999e-1LF
#define CORE_PI_4_LOW 3.06161699786838301793e-17LF
#define CORE_ATAN_3_2 9.82793723247329054082e-1LF
#define CORE_ATAN_3_2_LOW 1.39033110312309984516e-17LF
#define CORE_PI_2 1.57079632679489655800LF
#define CORE_PI_2_LOW 6.12323399573676603587e-17LF
#define CORE_PI 3.14159265358979311600LF
#define CORE_PI_LOW 1.22464679914735317636e-16LF

double core_infinity() { return packDouble2x32(uvec2(0u, 0x7ff00000u)); }
double core_nan() { return packDouble2x32(uvec2(0u, 0x7ff80000u)); }
// On the bits, because drivers may assume in arithmetic that there is no NaN.
bool core_is_nan(double x) {
    const uvec2 bits = unpackDouble2x32(x);
    const uint high = bits.y & 0x7fffffffu;
    return high > 0x7ff00000u || (high == 0x7ff00000u && bits.x != 0u);
}
bool core_is_infinite(double x) {
    const uvec2 bits = unpackDouble2x32(x);
    return (bits.y & 0x7fffffffu) == 0x7ff00000u && bits.x == 0u;
}
bool core_sign_bit(double x) { return (unpackDouble2x32(x).y >> 31) != 0u; }

// x with the lower half of its bits cleared.
double core_truncate(double x) { return packDouble2x32(uvec2(0u, unpackDouble2x32(x).y)); }

// x 2^k for -1100 <= k <= 1100, in two steps because 2^k itself may overflow.
double core_scale(double x, int k) {
    const int first = k / 2;
    precise double result = x * packDouble2x32(uvec2(0u, uint((first + 1023) << 20)));
    result *= packDouble2x32(uvec2(0u, uint((k - first + 1023) << 20)));
    return result;
}

// Positive finite x = m 2^exponent with m in [sqrt(1/2), sqrt(2)); returns m.
double core_split(double x, out int exponent) {
    const bool is_subnormal = x < 2.2250738585072014e-308LF;
    const uvec2 bits = unpackDouble2x32(is_subnormal ? x * 18014398509481984.0LF : x);
    const int high = int(bits.y) + (0x3ff00000 - 0x3fe6a09e);
    exponent = (high >> 20) - (is_subnormal ? 1077 : 1023);
    return packDouble2x32(uvec2(bits.x, uint((high & 0xfffff) + 0x3fe6a09e)));
}

// exp(r) = 1 - ((r c) / (c - 2) - r), |r| <= log(2)/2.
double core_exp_polynomial(double r) {
    const double t = r * r;
    return r - t * (1.66666666666666019037e-1LF +
                    t * (-2.77777777770155933842e-3LF +
                         t * (6.61375632143793436117e-5LF + t * (-1.65339022054652515390e-6LF + t * 4.13813679705723846039e-8LF))));
}

// log(1 + f) = f - f^2/2 + s (f^2/2 + R(s^2)), s = f / (2 + f).
double core_log_polynomial(double z) {
    const double w = z * z;
    const double even = w * (3.999999999940941908e-1LF + w * (2.222219843214978396e-1LF + w * 1.531383769920937332e-1LF));
    const double odd = z * (6.666666666666735130e-1LF +
                            w * (2.857142874366239149e-1LF + w * (1.818357216161805012e-1LF + w * 1.479819860511658591e-1LF)));
    return odd + even;
}

// (atanh(s)/s - 1 - z/3) / z^2 for z = s^2 <= 0.03: Taylor's series.
double core_atanh_polynomial(double z) {
    double sum = 1.0LF / 27.0LF;
    sum = sum * z + 1.0LF / 25.0LF;
    sum = sum * z + 1.0LF / 23.0LF;
    sum = sum * z + 1.0LF / 21.0LF;
    sum = sum * z + 1.0LF / 19.0LF;
    sum = sum * z + 1.0LF / 17.0LF;
    sum = sum * z + 1.0LF / 15.0LF;
    sum = sum * z + 1.0LF / 13.0LF;
    sum = sum * z + 1.0LF / 11.0LF;
    sum = sum * z + 1.0LF / 9.0LF;
    sum = sum * z + 1.0LF / 7.0LF;
    return sum * z + 1.0LF / 5.0LF;
}

// sin(r) = r + z r (CORE_SIN_1 + z P(z)), cos(r) = 1 - z/2 + z^2 P(z), z = r^2.
double core_sin_polynomial(double z) {
    return 8.33333333332248946124e-3LF +
           z * (-1.98412698298579493134e-4LF +
                z * (2.75573137070700676789e-6LF + z * (-2.50507602534068634195e-8LF + z * 1.58969099521155010221e-10LF)));
}
double core_cos_polynomial(double z) {
    return 4.16666666666666019037e-2LF +
           z * (-1.38888888888741095749e-3LF +
                z * (2.48015872894767294178e-5LF +
                     z * (-2.75573143513906633035e-7LF + z * (2.08757232129817482790e-9LF + z * -1.13596475577881948265e-11LF))));
}

// x = n pi/2 + r + low; returns n mod 4. pi/2 is subtracted in three parts of 33 bits, whose products with n < 2^20 are exact,
// and a rest.
int core_reduce(double x, out double r, out double low) {
    const double n = floor(x * 6.36619772367581382433e-1LF + 0.5LF);
    precise const double first = x - n * 1.57079632673412561417LF;
    precise const double w2 = n * 6.07710050630396597660e-11LF;
    precise const double second = first - w2;
    precise const double w3 = n * 2.02226624871116645580e-21LF;
    precise const double second_rest = (first - second) - w2;
    precise const double third = second - w3;
    precise const double w4 = n * 8.47842766036889956997e-32LF - ((second - third) - w3) - second_rest;
    precise const double high = third - w4;
    precise const double rest = (third - high) - w4;
    r = high;
    low = rest;
    return int(n);
}

// atan(t) = t - t z P(z), z = t^2.
double core_atan_polynomial(double z) {
    const double w = z * z;
    const double even =
        3.33333333333329318027e-1LF +
        w * (1.42857142725034663711e-1LF +
             w * (9.09088713343650656196e-2LF +
                  w * (6.66107313738753120669e-2LF + w * (4.97687799461593236017e-2LF + w * 1.62858201153657823623e-2LF))));
    const double odd =
        -1.99999999998764832476e-1LF +
        w * (-1.11111104054623557880e-1LF +
             w * (-7.69187620504482999495e-2LF + w * (-5.83357013379057348645e-2LF + w * -3.65315727442169155270e-2LF)));
    return even + z * odd;
}

// asin(x) = x + x R(z), z = x^2 <= 1/4.
double core_asin_ratio(double z) {
    const double p =
        1.66666666666666657415e-1LF +
        z * (-3.25565818622400915405e-1LF +
             z * (2.01212532134862925881e-1LF +
                  z * (-4.00555345006794114027e-2LF + z * (7.91534994289814532176e-4LF + z * 3.47933107596021167570e-5LF))));
    const double q = 1.0LF + z * (-2.40339491173441421878LF +
                                  z * (2.02094576023350569471LF +
                                       z * (-6.88283971605453293030e-1LF + z * 7.70381505559019352791e-2LF)));
    return z * p / q;
}
