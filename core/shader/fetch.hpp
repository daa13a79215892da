/**
 * @file fetch.hpp
 * GLSL that reads record buffers, whatever they are bound as and however many parts they have.
 */
#pragma once

#include <core/vulkan/buffer.hpp>
#include <core/vulkan/kernel.hpp>

#include <string>

namespace elvis {

/** Declarations of one record buffer in a shader. */
struct FetchCode {
    /** Bindings and functions: `NAME(record, index)` and `NAME_row(record, row)`. */
    std::string text;
    std::vector<BindingLayout> layout;
    std::vector<BoundBuffer> bound;
};

/**
 * `name` is the GLSL name of the function that fetches one number; parts are bound at first_binding and following. The parts of
 * a buffer are told apart by comparison, because not every device may index descriptors by values that differ between lanes.
 */
FetchCode fetch_code(const Device& device, const RecordBuffer& records, const std::string& name, std::uint32_t first_binding);

} // namespace elvis
