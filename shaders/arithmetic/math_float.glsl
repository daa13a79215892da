// What math.glsl needs in single precision.

#define CORE_HALF 0.5
// exp overflows above 88.73 and vanishes below -103.98.
#define CORE_EXP_LIMIT 105
#define CORE_LOG2_E 1.44269502162933349609375
// log 2 in two parts, the first with few enough bits that its product with an exponent is exact.
#define CORE_EXP_LN2_HIGH 0.693145751953125
#define CORE_EXP_LN2_LOW 1.428606765330187e-6
#define CORE_LN2_HIGH 0.693138122558594
#define CORE_LN2_LOW 9.0580006145e-6
#define CORE_POW_LN2_HIGH 0.693145751953125
#define CORE_POW_LN2_LOW 1.428606765330187e-6
#define CORE_THIRD 0.3333333432674408
#define CORE_THIRD_LOW -9.934107758624577e-9
// 2^12 + 1 cuts a number in two halves of 12 bits (Veltkamp).
#define CORE_SPLITTER 4097.0
#define CORE_SIN_LIMIT 1e5
#define CORE_SIN_1 -1.6666654611e-1
#define CORE_LARGE 1e18
#define CORE_TINY 1e-30

#define CORE_ATAN_HALF 4.6364760399e-1
#define CORE_ATAN_HALF_LOW 5.0121582440e-9
#define CORE_PI_4 7.8539812565e-1
#define CORE_PI_4_LOW 3.7748947079e-8
#define CORE_ATAN_3_2 9.8279368877e-1
#define CORE_ATAN_3_2_LOW 3.4473217170e-8
#define CORE_PI_2 1.5707962513
#define CORE_PI_2_LOW 7.5497894159e-8
#define CORE_PI 3.1415925026
#define CORE_PI_LOW 1.5099578832e-7

float core_infinity() { return uintBitsToFloat(0x7f800000u); }
float core_nan() { return uintBitsToFloat(0x7fc00000u); }
// On the bits, because drivers may assume in arithmetic that there is no NaN.
bool core_is_nan(float x) { return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u; }
bool core_is_infinite(float x) { return (floatBitsToUint(x) & 0x7fffffffu) == 0x7f800000u; }
bool core_sign_bit(float x) { return (floatBitsToUint(x) >> 31) != 0u; }

// x with the lower half of its bits cleared.
float core_truncate(float x) { return uintBitsToFloat(floatBitsToUint(x) & 0xfffff000u); }

// x 2^k for -160 <= k <= 160, in two steps because 2^k itself may overflow.
float core_scale(float x, int k) {
    const int first = k / 2;
    precise float result = x * intBitsToFloat((first + 127) << 23);
    result *= intBitsToFloat((k - first + 127) << 23);
    return result;
}

// Positive finite x = m 2^exponent with m in [sqrt(1/2), sqrt(2)); returns m.
float core_split(float x, out int exponent) {
    const bool is_subnormal = x < 1.17549435e-38;
    const int bits = floatBitsToInt(is_subnormal ? x * 33554432.0 : x) + (0x3f800000 - 0x3f3504f3);
    exponent = (bits >> 23) - (is_subnormal ? 152 : 127);
    return intBitsToFloat((bits & 0x7fffff) + 0x3f3504f3);
}

// exp(r) = 1 - ((r c) / (c - 2) - r), |r| <= log(2)/2.
float core_exp_polynomial(float r) {
    const float t = r * r;
    return r - t * (1.6666625440e-1 + t * -2.7667332906e-3);
}

// log(1 + f) = f - f^2/2 + s (f^2/2 + R(s^2)), s = f / (2 + f).
float core_log_polynomial(float z) {
    return z * (0.66666662693 + z * (0.40000972152 + z * (0.28498786688 + z * 0.24279078841)));
}

// (atanh(s)/s - 1 - z/3) / z^2 for z = s^2 <= 0.03: Taylor's series.
float core_atanh_polynomial(float z) {
    return 1.0 / 5.0 + z * (1.0 / 7.0 + z * (1.0 / 9.0 + z * (1.0 / 11.0 + z * (1.0 / 13.0))));
}

// sin(r) = r + z r (CORE_SIN_1 + z P(z)), cos(r) = 1 - z/2 + z^2 P(z), z = r^2.
float core_sin_polynomial(float z) { return 8.3321608736e-3 + z * -1.9515295891e-4; }
float core_cos_polynomial(float z) {
    return 4.166664568298827e-2 + z * (-1.388731625493765e-3 + z * 2.443315711809948e-5);
}

// x = n pi/2 + r + low; returns n mod 4. pi/2 is subtracted in parts of 8 bits, whose products with n < 2^16 are exact, and a
// rest. The first two differences are exact as well (multiples of 2^-24 below 1); the errors of the others are kept.
int core_reduce(float x, out float r, out float low) {
    const float n = floor(x * 0.636619746685028076171875 + 0.5);
    precise const float exact = (x - n * 1.5703125) - n * 4.825592041015625e-4;
    float t3, error3, t4, error4, t5, error5;
    core_two_sum(exact, n * -1.2665987014770508e-6, t3, error3);
    core_two_sum(t3, n * -9.89530235528946e-10, t4, error4);
    core_two_sum(t4, n * -2.5579538487363607e-12, t5, error5);
    core_two_sum(t5, error3 + error4 + error5 - n * 5.390302953474238e-15, r, low);
    return int(n);
}

// atan(t) = t - t z P(z), z = t^2.
float core_atan_polynomial(float z) {
    return 3.3333328366e-1 + z * (-1.9999158382e-1 + z * (1.4253635705e-1 + z * (-1.0648017377e-1 + z * 6.1687607318e-2)));
}

// asin(x) = x + x R(z), z = x^2 <= 1/4.
float core_asin_ratio(float z) {
    return z * (1.6666586697e-1 + z * (-4.2743422091e-2 + z * -8.6563630030e-3)) / (1.0 + z * -7.0662963390e-1);
}
