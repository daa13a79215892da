/**
 * @file partition.hpp
 * Which elements of a volume make up its parts.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace elvis {

/** Consecutive things, from the first on and before the end. */
struct Span {
    std::uint64_t first = 0, end = 0;

    std::uint64_t size() const { return end - first; }
    bool holds(std::uint64_t one) const { return one >= first && one < end; }
};

/**
 * One of `n_shares` shares of n things, as equal as can be, in their order. Parts are shares of the elements, counted class by
 * class, so that they are the data's own affair; processes own shares of the parts.
 */
inline Span share(std::uint64_t n, std::uint32_t n_shares, std::uint32_t index) {
    return {n * index / n_shares, n * (index + 1) / n_shares};
}

/** Which elements make up which part. Elements are counted class by class. */
class Partition {
public:
    /** Of each part runs of elements, ascending; each element is in one part. A part may have none. */
    explicit Partition(std::vector<std::vector<Span>> parts) : m_parts(std::move(parts)) {}
    static Partition in_shares(std::uint64_t n_elements, std::uint32_t n_parts);

    std::uint32_t n_parts() const { return static_cast<std::uint32_t>(m_parts.size()); }
    std::span<const Span> runs(std::uint64_t part) const { return m_parts[part]; }
    std::uint64_t n_elements(std::uint64_t part) const;
    /** Ascending. */
    std::vector<std::uint64_t> elements(std::uint64_t part) const;
    /** The part that has the element. */
    std::uint32_t part_of(std::uint64_t element) const;

private:
    std::vector<std::vector<Span>> m_parts;
};

/**
 * The elements of a part, which ascend, and those around it, ascending: all whose box comes near the box of an element of the
 * part. `boxes`: six numbers for each element of the volume.
 */
std::vector<std::uint64_t> with_surroundings(std::span<const double> boxes, std::span<const std::uint64_t> part);

/** Of all these boxes: six numbers each. */
std::array<double, 6> box_around(std::span<const double> boxes);

/** From numbers of elements in the order of parts, as many of each, those in the order of elements. */
std::vector<double> in_order_of_elements(const Partition& partition, std::span<const double> by_part);

/** The same elements by class, counted in each class. */
std::vector<std::vector<std::uint64_t>> by_class(const RuntimeVolume& volume, std::span<const std::uint64_t> elements);

} // namespace elvis
