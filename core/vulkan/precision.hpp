/**
 * @file precision.hpp
 * In which precision the device computes.
 */
#pragma once

#include <optional>
#include <string_view>

namespace elvis {

enum class Precision { float32, float64 };

/** As users write it. */
inline const char* name_of(Precision precision) { return precision == Precision::float64 ? "float64" : "float32"; }

/** Nothing for other words. */
inline std::optional<Precision> precision_named(std::string_view name) {
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        if (name == name_of(precision)) {
            return precision;
        }
    }
    return {};
}

} // namespace elvis
