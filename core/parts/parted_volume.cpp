#include <core/parts/parted_volume.hpp>

#include <core/base/error.hpp>
#include <core/parts/part_volume.hpp>
#include <core/parts/partition.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/selected_volume.hpp>
#include <core/session/volume/warped.hpp>

#include <elvis/native/serve.hpp>

#include <utility>
#include <vector>

namespace elvis {

namespace {

class PartedNative final : public PartedVolume {
public:
    PartedNative(NativeParts from, const RuntimeVolume& whole, const TaskControl* control)
        : m_from(std::move(from)), m_whole(whole), m_control(control) {}

    const RuntimeVolume& whole() const override { return m_whole; }
    OpenedElements open(std::span<const std::uint64_t> elements) const override {
        const std::vector<std::vector<std::uint64_t>> chosen = by_class(m_whole, elements);
        elvis_volume* served = nullptr;
        RuntimeVolume volume =
            serve_native(std::make_shared<const PartVolume>(m_from.source, chosen), m_whole.path(), m_control, &served);
        if (m_from.undeformed) {
            volume.set_undeformed([source = m_from.undeformed, chosen, name = m_whole.path(), control = m_control] {
                return serve_native(std::make_shared<const PartVolume>(source, chosen), name, control);
            });
        }
        return {std::move(volume), [served] { native::forget_fields(served); }};
    }
    bool tells_extrema(std::uint32_t field, std::uint32_t time_step) const override {
        return !m_from.source->read_extrema(field, time_step).empty();
    }
    MappingReader shared_mapping() const override { return m_from.shared_mapping; }

private:
    NativeParts m_from;
    const RuntimeVolume& m_whole;
    const TaskControl* m_control;
};

class PartedByPlugin final : public PartedVolume {
public:
    explicit PartedByPlugin(const RuntimeVolume& whole) : m_whole(whole) {}

    const RuntimeVolume& whole() const override { return m_whole; }
    OpenedElements open(std::span<const std::uint64_t> elements) const override {
        return {selected_volume(m_whole, {elements.begin(), elements.end()}, SelectedFaces::of_elements), [] {}};
    }
    /** Those of plugins that offer it are their own affair: all processes get the same answer. */
    bool tells_extrema(std::uint32_t, std::uint32_t) const override { return true; }

private:
    const RuntimeVolume& m_whole;
};

} // namespace

std::unique_ptr<PartedVolume> parted_native(NativeParts from, const RuntimeVolume& whole, const TaskControl* control) {
    return std::make_unique<PartedNative>(std::move(from), whole, control);
}

void need_element_records(const RuntimeVolume& volume) {
    if (!can_select(volume)) {
        throw Error(volume.path(), "cannot be drawn in parts: plugin " + volume.plugin().id() +
                                       " does not say that records belong to elements (ELVIS_SNIPPET_ELEMENT_RECORDS)");
    }
}

std::unique_ptr<PartedVolume> parted_by_plugin(const RuntimeVolume& whole) {
    need_element_records(whole);
    return std::make_unique<PartedByPlugin>(whole);
}

} // namespace elvis
