/**
 * @file memory_need.hpp
 * What elements of a volume take in memory, to tell before anything is read whether they fit.
 */
#pragma once

#include <core/base/memory_budget.hpp>
#include <core/render/frame.hpp>
#include <core/vulkan/precision.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace elvis {

struct MemoryNeed {
    std::uint64_t device = 0, host = 0;

    MemoryNeed operator+(const MemoryNeed& other) const { return {device + other.device, host + other.host}; }
    bool fits(const MemoryBudget& budget) const {
        return device <= budget.device.value_or(UINT64_MAX) && host <= budget.host.value_or(UINT64_MAX);
    }
};

/** Of a picture, by what its surfaces show. */
class NeedOfElements {
public:
    NeedOfElements(const FrameRequest& request, const RuntimeVolume& whole, Precision precision, bool is_cpu);

    /** What all elements share: buffers for all classes, and octants of bent ones, which come when they are asked for. */
    MemoryNeed shared() const { return {m_shared_bytes, m_is_cpu ? m_shared_bytes : 0}; }
    /** Without that. `elements`: ascending. Octants of isosurfaces in strongly bent ones take more. */
    MemoryNeed of(std::span<const std::uint64_t> elements) const;
    MemoryNeed of_all() const;
    /** What so many faces take besides, at least: strongly bent ones take more. */
    MemoryNeed of_faces(std::uint64_t n_faces) const;
    /** What so many take at least, without octants of isosurfaces; and how many fit at most. */
    MemoryNeed least_of(std::uint64_t n_elements) const;
    std::uint64_t most(const MemoryBudget& budget) const;

private:
    MemoryNeed of_class(std::size_t element_class, std::uint64_t n_elements) const;
    MemoryNeed of_octants(std::uint64_t n_elements) const;

    std::uint64_t m_shared_bytes = 0;
    /** Fields whose isosurfaces are looked for. */
    std::size_t m_n_isosurfaces = 0;
    /** Of an element of each class, on the device. */
    std::vector<std::uint64_t> m_bytes;
    std::vector<std::uint64_t> m_first_elements;
    std::uint64_t m_n_elements = 0;
    /** Numbers of the polynomial of a face. */
    std::uint64_t m_face_numbers = 0;
    std::uint64_t m_real_bytes;
    bool m_is_cpu;
};

/** Of the picture itself, whatever elements it shows. */
MemoryNeed need_of_picture(const FrameRequest& request, std::size_t n_classes, Precision precision, bool is_cpu);

/** "123 MiB" or, of less, "4567 KiB", rounded up. */
std::string bytes_text(std::uint64_t bytes);

} // namespace elvis
