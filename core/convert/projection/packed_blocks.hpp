/**
 * @file packed_blocks.hpp
 * Results of blocks as bytes, between processes of one program on machines of one kind.
 */
#pragma once

#include <core/convert/projection/block_projection.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace elvis {

std::vector<std::byte> packed(std::span<const BlockResult> blocks);
std::vector<BlockResult> unpacked_blocks(std::span<const std::byte> bytes);

} // namespace elvis
