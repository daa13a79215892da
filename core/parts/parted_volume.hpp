/**
 * @file parted_volume.hpp
 * A volume of which some elements can be opened alone.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/volume/outline.hpp>

#include <elvis/native/volume_source.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace elvis {

struct OpenedElements {
    RuntimeVolume volume;
    /** Values of fields have changed: what was read of them is read again. */
    std::function<void()> forget_fields;
};

/** Each process has one of its own. */
class PartedVolume {
public:
    virtual ~PartedVolume() = default;

    /** Of it is read what is written down of the structure, and bounds of own elements. */
    virtual const RuntimeVolume& whole() const = 0;
    /**
     * `elements`: ascending, at least one, as counted in the whole, in which they keep their numbers and their order. Faces
     * between one of them and another element have an unknown neighbour.
     */
    virtual OpenedElements open(std::span<const std::uint64_t> elements) const = 0;
    /** Whether this process can open the element: those around a part are drawn with it where they can be. */
    virtual bool can_open(std::uint64_t) const { return true; }
    /** Whether the whole tells extrema of a field without looking for them in all elements. */
    virtual bool tells_extrema(std::uint32_t field, std::uint32_t time_step) const = 0;
    /** Where no process evaluates all elements: what all of them ask together. Else empty. */
    virtual MappingReader shared_mapping() const { return {}; }
};

/** What a native volume in parts is read from. */
struct NativeParts {
    std::shared_ptr<const native::VolumeSource> source;
    /** Of a displaced volume the same elements where they were; else null. */
    std::shared_ptr<const native::VolumeSource> undeformed{};
    /** PartedVolume::shared_mapping. */
    MappingReader shared_mapping{};
};

/**
 * `whole` serves the source. Of coefficients only those of the elements are read. Whole and `control`, if there is one, must
 * outlive it.
 */
std::unique_ptr<PartedVolume> parted_native(NativeParts from, const RuntimeVolume& whole, const TaskControl* control);

/** Throws Error for a plugin that does not say that records belong to elements (ELVIS_SNIPPET_ELEMENT_RECORDS). */
void need_element_records(const RuntimeVolume& volume);

/** A runtime plugin's, which needs element records: of it only records of the elements are asked for. It must outlive this. */
std::unique_ptr<PartedVolume> parted_by_plugin(const RuntimeVolume& whole);

} // namespace elvis
