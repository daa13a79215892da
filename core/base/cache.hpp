/**
 * @file cache.hpp
 * Files that only save time: compiled shaders and pipelines, and converted volumes (core/convert/kept_volumes.hpp). Losing them
 * costs nothing but a slower start, so no failure here is an error.
 */
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace elvis {

/** What the host has decided (host.hpp), else $ELVIS_CACHE_PATH, else $XDG_CACHE_HOME/elvis, else $HOME/.cache/elvis; empty if
 * none of them is set. */
std::filesystem::path cache_folder();

/** 128 bits of hash as 32 hexadecimal digits, for names of cache entries. Not for protection against forgery. */
std::string content_hash(std::string_view content);

/** The entry's content, or nothing if there is none or its checksum does not fit. */
std::optional<std::vector<std::byte>> read_cache_entry(const std::string& name);

/**
 * Writes an entry under a temporary name and renames it, so that readers and other processes see it whole or not at all.
 * Returns whether that worked.
 */
bool write_cache_entry(const std::string& name, std::span<const std::byte> content);

} // namespace elvis
