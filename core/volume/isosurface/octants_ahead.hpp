/**
 * @file octants_ahead.hpp
 * Octants are divided level by level, as their records say. To learn them, the host waits for the device: it asks about their
 * parts, too, while these are few.
 */
#pragma once

#include <core/volume/isosurface/octant_records.hpp>
#include <core/vulkan/device.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace elvis {

class OctantsAhead {
public:
    /** Records of octants, octant_words each, in the order in which elements and codes are given. */
    using Evaluate = std::function<std::vector<std::uint32_t>(std::span<const std::uint32_t> elements_and_codes)>;

    /** Only where commands are collected: elsewhere an octant costs more than a wait. */
    OctantsAhead(const Device& device, elvis_shape shape, Evaluate evaluate)
        : m_looks_ahead(device.collects_submissions()), m_shape(shape), m_evaluate(std::move(evaluate)) {}

    /** What `evaluate` says. Parts of octants are asked for after these. */
    std::vector<std::uint32_t> operator()(std::span<const std::uint32_t> elements_and_codes);

    /** What is evaluated if these are asked for, and what comes of it if that is known already. */
    std::vector<std::uint32_t> with_parts(std::span<const std::uint32_t> elements_and_codes) const;
    void keep(std::span<const std::uint32_t> elements_and_codes, std::vector<std::uint32_t> words);

private:
    bool m_looks_ahead;
    elvis_shape m_shape;
    Evaluate m_evaluate;
    std::vector<std::uint32_t> m_words;
    /** By element and code: which record it is. */
    std::unordered_map<std::uint64_t, std::size_t> m_places;
};

} // namespace elvis
