/**
 * @file float_rounding.hpp
 * Rounding to single precision that optimizers cannot remove.
 */
#pragma once

namespace elvis {

/**
 * The nearest number that single precision holds. GCC 12 drops the conversions in static_cast<double>(static_cast<float>(x))
 * where it vectorizes neighbouring ones (x86-64, from -O2 on), so that the result is not rounded; a volatile store cannot be
 * dropped.
 */
inline double exact_in_float(double x) {
    const volatile float rounded = static_cast<float>(x);
    return static_cast<double>(rounded);
}

} // namespace elvis
