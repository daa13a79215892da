#include <core/demand/draw_on_demand.hpp>

#include <core/base/error.hpp>
#include <core/base/milliseconds.hpp>
#include <core/base/peak_memory.hpp>
#include <core/demand/box_blocks.hpp>
#include <core/demand/demand_ranges.hpp>
#include <core/demand/elements_in_blocks.hpp>
#include <core/demand/needed_elements.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/selected_volume.hpp>
#include <core/render/bands.hpp>
#include <core/scene/frame_request.hpp>
#include <core/session/missed_surfaces.hpp>
#include <core/session/supersampled.hpp>
#include <core/vulkan/memory/memory_limit.hpp>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace elvis {

namespace {

using Clock = std::chrono::steady_clock;

/** Of a picture that a device binds at once: far more than any of its buffers has for a pixel. */
constexpr std::uint64_t most_bytes_a_pixel = 256;

void need_budgets_can_hold(const Scene& scene) {
    const auto refuse = [&](const std::string& what) {
        throw Error(scene.volume, what + " cannot be drawn within a budget of memory yet; without one they can");
    };
    if (!scene.volumes.empty()) {
        refuse("several volumes");
    }
    for (const SceneSurface& surface : scene.surfaces) {
        if (surface.streamlines || surface.arrows) {
            refuse("streamlines, pathlines and arrows");
        }
    }
}

bool is_plane(const Surface& surface) { return std::holds_alternative<CutPlane>(surface.geometry); }
bool is_boundary(const Surface& surface) { return std::holds_alternative<BoundaryFaces>(surface.geometry); }
bool is_isosurface(const Surface& surface) { return std::holds_alternative<Isosurfaces>(surface.geometry); }

/** What of a budget a need is beyond. */
std::string beyond(const MemoryNeed& need, const MemoryBudget& budget) {
    const bool is_device = need.device > budget.device.value_or(UINT64_MAX);
    return bytes_text(is_device ? need.device : need.host) + (is_device ? " on the device" : " on the host") +
           ", and the budget is " + bytes_text(is_device ? *budget.device : *budget.host);
}

MemoryBudget less(const MemoryBudget& budget, const MemoryNeed& taken) {
    const auto rest = [](std::optional<std::uint64_t> of, std::uint64_t part) {
        return of ? std::optional(*of - std::min(*of, part)) : of;
    };
    return {rest(budget.device, taken.device), rest(budget.host, taken.host)};
}

std::string surface_text(const Surface& surface, std::size_t index) {
    const char* const name = is_plane(surface) ? "the cut plane" : is_boundary(surface) ? "the boundary" : "the isosurface";
    return std::string(name) + " (surface " + std::to_string(index) + ")";
}

/** Of all buffers, while it lives. */
class DeviceLimit {
public:
    DeviceLimit(const Device& device, std::optional<std::uint64_t> most) : m_device(device) {
        limit_memory(device, most.value_or(0));
    }
    ~DeviceLimit() { limit_memory(m_device, 0); }
    DeviceLimit(const DeviceLimit&) = delete;
    DeviceLimit& operator=(const DeviceLimit&) = delete;

private:
    const Device& m_device;
};

/** Of all surfaces, or nothing for lack of memory; then what lacks it, in words. */
struct Selection {
    std::optional<std::vector<std::uint64_t>> elements;
    std::string lack;
};

} // namespace

struct VolumeOnDemand::Impl {
    const RuntimeVolume& whole;
    const Device& device;
    Precision precision;
    MemoryBudget budget;
    const TaskControl* control;
    Clock::time_point start = Clock::now();
    BoxBlocks blocks;
    DemandWork work{};
    DemandRanges ranges;
    RoughDemandRanges rough_ranges{ranges};
    /** Of isosurfaces of the picture that is drawn, by their place among the surfaces: the same for all rows. */
    std::map<std::size_t, std::vector<std::uint64_t>> of_isosurfaces;

    Impl(const RuntimeVolume& of, const Device& on, Precision with, const MemoryBudget& within, const TaskControl* task)
        : whole(of), device(on), precision(with), budget(within), control(task), blocks(of, on.background(), task),
          ranges(on, of, with, blocks, within, task) {
        work.n_elements = of.n_elements();
        work.bounds_milliseconds = milliseconds_since(start);
    }

    bool is_cpu() const { return device.summary().type == "cpu"; }
    MemoryNeed need_of_picture(const FrameRequest& request) const {
        return elvis::need_of_picture(request, whole.classes().size(), precision, is_cpu());
    }
    std::vector<std::uint64_t> elements_of(std::size_t surface, const FrameRequest& rows, std::uint64_t most);
    Selection select(const FrameRequest& rows);
    std::uint32_t rows_that_fit(const FrameRequest& request, std::uint32_t unit);
    void draw_selected(const Scene& scene, StillPicture& still);
    Frame draw_rows(const FrameRequest& rows);
    StillPicture draw_whole(const Scene& scene, FrameRequest request, const StillOptions& options, const std::string& why);
};

std::vector<std::uint64_t> VolumeOnDemand::Impl::elements_of(std::size_t surface, const FrameRequest& rows,
                                                             std::uint64_t most) {
    if (const auto known = of_isosurfaces.find(surface); known != of_isosurfaces.end()) {
        return known->second;
    }
    std::vector<std::uint64_t> own = needed_elements(rows.surfaces[surface], rows, whole, blocks, ranges, most, control);
    if (is_isosurface(rows.surfaces[surface])) {
        of_isosurfaces[surface] = own;
    }
    return own;
}

Selection VolumeOnDemand::Impl::select(const FrameRequest& rows) {
    const NeedOfElements need(rows, whole, precision, is_cpu());
    const MemoryNeed in_any_case = need_of_picture(rows) + need.shared();
    if (!in_any_case.fits(budget)) {
        return {{}, "the picture takes, whatever it shows, " + beyond(in_any_case, budget)};
    }
    const std::uint64_t most = need.most(less(budget, in_any_case));
    const std::string of_all =
        " of " + std::to_string(whole.n_elements()) + " elements, with the picture and surfaces before it ";
    std::vector<std::uint64_t> all = blocks.farthest();
    MemoryNeed faces;
    for (std::size_t index = 0; index < rows.surfaces.size(); ++index) {
        const std::string name = surface_text(rows.surfaces[index], index);
        try {
            const std::vector<std::uint64_t> own = elements_of(index, rows, most);
            const std::vector<std::uint64_t> before = std::exchange(all, {});
            std::ranges::set_union(before, own, std::back_inserter(all));
            if (is_boundary(rows.surfaces[index])) {
                faces = faces + need.of_faces(own.size());
            }
            if (const MemoryNeed total = in_any_case + faces + need.of(all); !total.fits(budget)) {
                return {{}, name + " needs " + std::to_string(own.size()) + of_all + beyond(total, budget)};
            }
        } catch (const TooManyElements&) {
            return {{},
                    name + " needs more than " + std::to_string(most) + of_all + "more than " +
                        beyond(in_any_case + need.least_of(most + 1), budget)};
        }
    }
    return {std::move(all), {}};
}

/** The most rows a band whose elements fit, in each of the bands; a multiple of the unit, or all. */
std::uint32_t VolumeOnDemand::Impl::rows_that_fit(const FrameRequest& request, std::uint32_t unit) {
    const std::uint64_t binds = device.max_binding_bytes() / most_bytes_a_pixel / std::max(1u, request.width);
    const auto whole_units = [unit](std::uint64_t n_rows) {
        return static_cast<std::uint32_t>(std::max<std::uint64_t>(unit, n_rows / unit * unit));
    };
    const bool has_bands = std::ranges::all_of(request.surfaces, is_plane);
    std::uint32_t n_rows = request.height <= binds ? request.height : whole_units(binds);
    while (true) {
        std::string lack;
        for (const FrameRequest& band : bands_of(request, n_rows)) {
            lack = select(band).lack;
            if (!lack.empty()) {
                break;
            }
        }
        if (lack.empty()) {
            return n_rows;
        }
        if (!has_bands || n_rows <= unit) {
            throw Error(whole.path(), lack + (has_bands ? "; that is in a band of " + std::to_string(n_rows) + " rows" : ""));
        }
        n_rows = whole_units(std::min(n_rows, request.height) / 2);
    }
}

Frame VolumeOnDemand::Impl::draw_rows(const FrameRequest& rows) {
    const bool has_faces = std::ranges::any_of(rows.surfaces, is_boundary);
    std::vector<std::uint64_t> elements = *select(rows).elements;
    work.n_on_device = std::max<std::uint64_t>(work.n_on_device, elements.size());
    ++work.n_bands;
    const RuntimeVolume selected =
        selected_volume(whole, std::move(elements), has_faces ? SelectedFaces::of_elements : SelectedFaces::none);
    Renderer renderer(device, selected, precision, control, {}, true);
    ranges.tell(rows, renderer.ranges());
    return renderer.render(rows, control);
}

/** With several samples a pixel the colours are means of a finer picture. What does not fit is told before either is drawn. */
void VolumeOnDemand::Impl::draw_selected(const Scene& scene, StillPicture& still) {
    const std::uint32_t n = scene.samples;
    const FrameRequest fine = finer(still.request, n);
    const std::uint32_t n_rows = rows_that_fit(still.request, part_rows);
    const std::uint32_t n_fine_rows = n > 1 ? rows_that_fit(fine, n * part_rows) : 0;
    const auto draw = [this](const FrameRequest& rows) { return draw_rows(rows); };
    still.frame = render_band_by_band(still.request, n_rows, draw);
    if (n > 1) {
        const Frame of_means = render_band_by_band(fine, n_fine_rows, draw, [&still, n](const Frame& band, const Rows& rows) {
            take_means(band, rows, n, still.frame.color);
        });
        still.frame.render_milliseconds += of_means.render_milliseconds;
        still.frame.device_milliseconds += of_means.device_milliseconds;
    }
}

StillPicture VolumeOnDemand::Impl::draw_whole(const Scene& scene, FrameRequest request, const StillOptions& options,
                                              const std::string& why) {
    const NeedOfElements elements(request, whole, precision, is_cpu());
    const MemoryNeed need = elements.of_all() + elements.shared() + need_of_picture(request);
    if (!need.fits(budget)) {
        throw Error(whole.path(), why + " needs all " + std::to_string(whole.n_elements()) + " elements, at least " +
                                      beyond(need, budget) + "; cut planes, boundaries and isosurfaces of fields need less");
    }
    work.n_on_device = whole.n_elements();
    work.n_bands = 1;
    Renderer renderer(device, whole, precision, control);
    return elvis::draw_request(scene, std::move(request), whole, renderer, options, control);
}

VolumeOnDemand::VolumeOnDemand(const RuntimeVolume& whole, const Device& device, Precision precision,
                               const MemoryBudget& budget, const TaskControl* control) {
    if (!can_select(whole) || !whole.has_field_ranges()) {
        throw Error(whole.path(), "cannot be drawn within a budget of memory: plugin " + whole.plugin().id() +
                                      " does not say that records belong to elements (elvis/demand.h), or tells no ranges "
                                      "of fields");
    }
    m_impl = std::make_unique<Impl>(whole, device, precision, budget, control);
}

VolumeOnDemand::~VolumeOnDemand() = default;

const DemandWork& VolumeOnDemand::work() const { return m_impl->work; }

PictureRanges& VolumeOnDemand::ranges() { return m_impl->ranges; }

PictureRanges& VolumeOnDemand::rough_ranges() { return m_impl->rough_ranges; }

StillPicture VolumeOnDemand::draw(const Scene& scene, const StillOptions& options) {
    need_budgets_can_hold(scene);
    const FrameRequest request = make_frame_request(scene, m_impl->whole, ranges());
    std::vector<FrameRemark> remarks = remarks_on(scene, request);
    StillPicture still = draw_request(scene, request, options);
    still.remarks.insert(still.remarks.begin(), remarks.begin(), remarks.end());
    MissedSurfaces missed;
    missed.add(still.request, still.frame);
    for (const std::string& text : missed.remarks(scene, still.request, rough_ranges())) {
        still.remarks.push_back({true, text});
    }
    return still;
}

StillPicture VolumeOnDemand::draw_request(const Scene& scene, FrameRequest request, const StillOptions& options) {
    Impl& impl = *m_impl;
    need_budgets_can_hold(scene);
    const DeviceLimit limit(impl.device, impl.budget.device);
    impl.work.n_on_device = impl.work.n_bands = 0;
    impl.of_isosurfaces.clear();
    StillPicture still;
    if (const auto why = needs_all(request, impl.whole, impl.ranges)) {
        if (scene.samples > 1) {
            throw Error(scene.volume, *why + " needs all elements: within a budget of memory it has one sample a pixel");
        }
        still = impl.draw_whole(scene, std::move(request), options, *why);
    } else {
        still.request = std::move(request);
        still.request.with_buffers = options.with_buffers;
        still.request.sharing = options.sharing;
        impl.draw_selected(scene, still);
        finish_still(scene, impl.whole, still);
    }
    impl.work.device_bytes = peak_allocated_bytes(impl.device);
    impl.work.host_bytes = peak_memory();
    return still;
}

} // namespace elvis
