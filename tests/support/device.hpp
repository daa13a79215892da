/**
 * @file device.hpp
 * The device that a test program draws on.
 */
#pragma once

#include <core/vulkan/device.hpp>

namespace elvis::test {

inline const Device& device() {
    static const Device only;
    return only;
}

/** With the validation layer. */
inline const Device& validated_device() {
    static const Device only({}, true);
    return only;
}

} // namespace elvis::test
