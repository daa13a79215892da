/**
 * @file insitu_volume.hpp
 * A solver's volume, however it is handed over.
 */
#pragma once

#include <core/parts/parted_volume.hpp>
#include <core/parts/partition.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <cstdint>
#include <vector>

namespace elvis::library {

class InsituVolume {
public:
    virtual ~InsituVolume() = default;

    /** Of all elements; only those that the rank holds can be read. */
    virtual const RuntimeVolume& whole() const = 0;
    /** Own elements alone; null if there are none. */
    virtual const RuntimeVolume* own() const = 0;
    /** What parts are opened of, a part a rank; null where one rank has the whole, which is drawn as it is. */
    virtual const PartedVolume* parted() const { return nullptr; }
    virtual const Partition* partition() const { return nullptr; }

    /** Throws InvalidArgument. */
    virtual void set_values(std::uint32_t field, std::uint32_t element_class, const double* values) = 0;
    /** The solver's values of own elements; returns how many were read. */
    virtual std::uint64_t read_values() = 0;
    /** Collective: those that were read go to the ranks that hold the elements, too. Returns the fields that have changed. */
    virtual std::vector<std::uint32_t> share_values() = 0;
};

} // namespace elvis::library
