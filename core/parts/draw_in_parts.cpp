#include <core/parts/draw_in_parts.hpp>

#include <core/arrows/scene_arrows.hpp>
#include <core/base/bounds.hpp>
#include <core/base/error.hpp>
#include <core/base/peak_memory.hpp>
#include <core/expression/expression.hpp>
#include <core/parts/all_boxes.hpp>
#include <core/parts/drawn_part.hpp>
#include <core/parts/fold_lic.hpp>
#include <core/parts/part_picture.hpp>
#include <core/parts/shared_fold.hpp>
#include <core/parts/whole_ranges.hpp>
#include <core/render/bands.hpp>
#include <core/scene/frame_request.hpp>
#include <core/session/missed_surfaces.hpp>
#include <core/session/streamline_tubes.hpp>
#include <core/session/supersampled.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <numeric>
#include <set>
#include <string>
#include <utility>

namespace elvis {

namespace {

std::uint64_t device_bytes(const Renderer& renderer) {
    const RendererMemory memory = renderer.memory();
    return memory.field_bytes + memory.geometry_bytes + memory.hierarchy_bytes;
}

std::set<std::uint32_t> fields_of(const FrameRequest& request) {
    std::set<std::uint32_t> fields;
    const auto add = [&](const FieldChoice& field) {
        if (field.expression) {
            const auto used = field.expression->fields();
            fields.insert(used.begin(), used.end());
        } else {
            fields.insert(field.field);
        }
    };
    for (const Surface& surface : request.surfaces) {
        add(surface.field);
        for (const Condition& condition : surface.conditions) {
            add(condition.field);
        }
        if (const Isosurfaces* const isosurfaces = traits_of(surface.geometry).isosurfaces) {
            add(isosurfaces->field);
        }
        if (surface.lic) {
            std::ranges::for_each(surface.lic->vectors, add);
        }
    }
    if (request.volume) {
        add(request.volume->field);
    }
    return fields;
}

/** What colours go by is asked for by all, so that the first knows it when it has the picture. */
void ask_about_isosurfaces(const FrameRequest& request, WholeRanges& ranges) {
    for (const Surface& surface : request.surfaces) {
        if (const Isosurfaces* const isosurfaces = traits_of(surface.geometry).isosurfaces) {
            ranges.extrema(isosurfaces->field, request.time_step);
            ranges.range(isosurfaces->field, request.time_step);
        }
    }
}

[[noreturn]] void refuse(const Scene& scene, const std::string& what) {
    throw Error(scene.volume, what + " cannot be drawn in parts yet; without --parts it can");
}

bool has_wide_lines(const Surface& surface) {
    return (surface.contours && surface.contours->style.width > 1) ||
           (surface.mesh_lines && surface.mesh_lines->style.width > 1);
}

void need_parts_can_draw(const FrameRequest& request, const Scene& scene) {
    for (const Surface& surface : request.surfaces) {
        if (surface.lic && surface.opacity < 1) {
            refuse(scene, "line integral convolution on a surface that can be seen through");
        }
        // Both look at what is cut away beside a pixel, of which no part knows all.
        const bool is_cut = !surface.clip.empty() || !surface.conditions.empty();
        if (surface.lic && is_cut) {
            refuse(scene, "line integral convolution with a threshold or with planes that cut the surface away");
        }
        if (is_cut && (has_wide_lines(surface) || (surface.has_lines() && scene.samples > 1))) {
            refuse(scene,
                   "lines of several pixels, or with several samples a pixel, with a threshold or with planes that cut the "
                   "surface away");
        }
    }
}

/** Of a surface that shows faces of chosen elements, or their edges; null of others. */
ElementSelection* selection_of(Surface& surface) {
    ElementFaces* faces = std::get_if<ElementFaces>(&surface.geometry);
    if (WireFrame* const wires = std::get_if<WireFrame>(&surface.geometry)) {
        faces = std::get_if<ElementFaces>(&wires->faces);
    }
    return faces != nullptr ? &faces->selection : nullptr;
}

/** Of one surface: as the part has to choose its faces. */
FrameRequest for_part(const FrameRequest& alone, const DrawnPart& part) {
    FrameRequest request = alone;
    if (ElementSelection* const selection = selection_of(request.surfaces[0])) {
        selection->own = part.own.all();
    }
    return request;
}

/** As in pictures of the whole: of two surfaces at the same depth the first one is seen. What can be seen through comes last.
 */
std::vector<std::size_t> drawing_order(const std::vector<Surface>& surfaces) {
    std::vector<std::size_t> order(surfaces.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t index) {
        const Surface& surface = surfaces[index];
        return surface.opacity < 1 ? 2 : surface.is_see_through() ? 1 : 0;
    });
    return order;
}

} // namespace

struct VolumeInParts::Impl {
    const PartedVolume& volume;
    const RuntimeVolume& whole;
    const Device& device;
    Precision precision;
    Partition partition;
    Team& team;
    const TaskControl* control;
    std::vector<double> boxes{};
    std::vector<DrawnPart> parts{};
    /** Of the same parts; there when light is first wanted. */
    std::vector<BarePart> bare_parts{};
    std::vector<Renderer*> renderers{};
    std::unique_ptr<WholeRanges> ranges{};
    PartsWork work{};
    StreamlineTubes streamlines{};
    SceneArrowSets arrows{};

    std::unique_ptr<DrawnElements> opened(std::span<const std::uint64_t> elements, const std::array<double, 6>& bounds) const;
    void open_part(std::uint32_t part, const std::array<double, 6>& bounds);
    void open_bare_parts();
    void share_ranges(const FrameRequest& request);
    Scene with_glyphs(const Scene& scene);
    DrawParts drawing(const FrameRequest& request);
    DrawParts drawing_layers(const FrameRequest& alone);
    void need_memory_for(const FrameRequest& request, const Renderer& renderer, const std::string& what) const;
    DrawParts drawing_light(const FrameRequest& request, std::vector<double> depths, std::vector<std::vector<double>> stops);
    std::vector<double> shades(const FrameRequest& alone, SharedFold& fold);
    void need_faces(FrameRequest request) const;
    SharedFrame draw_surfaces(const FrameRequest& request, SharedFold& fold);
    Frame draw(const FrameRequest& request, bool with_buffers);
    void take_means_of_finer(const FrameRequest& request, std::uint32_t n, std::uint32_t most_pixels, Frame& frame);
    std::vector<PartsWork> work_of_all();
};

std::unique_ptr<DrawnElements> VolumeInParts::Impl::opened(std::span<const std::uint64_t> elements,
                                                           const std::array<double, 6>& bounds) const {
    return std::make_unique<DrawnElements>(volume.open(elements), device, precision, control, bounds);
}

void VolumeInParts::Impl::open_bare_parts() {
    for (std::size_t index = bare_parts.size(); index < parts.size(); ++index) {
        const std::uint32_t part = parts[index].part;
        bare_parts.push_back({part, opened(partition.elements(part), ranges->bounds())});
    }
}

void VolumeInParts::Impl::open_part(std::uint32_t part, const std::array<double, 6>& bounds) {
    const std::vector<std::uint64_t> own = partition.elements(part);
    std::vector<std::uint64_t> elements = with_surroundings(boxes, own);
    std::erase_if(elements, [&](std::uint64_t element) { return !volume.can_open(element); });
    parts.push_back({part, OwnNumbers(whole, partition.runs(part)), opened(elements, bounds)});
    renderers.push_back(&parts.back().elements->renderer());
    ++work.n_parts;
    work.n_own_elements += own.size();
    work.n_elements += elements.size();
}

/** Of fields the device has what is left when the middle of their range is taken away: of all parts the same middle. */
void VolumeInParts::Impl::share_ranges(const FrameRequest& request) {
    for (const std::uint32_t field : fields_of(request)) {
        const VolumeRanges::Ranges all = ranges->of_components(field, request.time_step);
        for (Renderer* const renderer : renderers) {
            renderer->ranges().set_components(field, request.time_step, all);
        }
        for (const BarePart& part : bare_parts) {
            part.elements->renderer().ranges().set_components(field, request.time_step, all);
        }
    }
}

/** Each process follows all lines, and places all arrows, by itself: they are the same in all of them. */
Scene VolumeInParts::Impl::with_glyphs(const Scene& scene) {
    Scene made = scene;
    const bool has_glyphs = std::ranges::any_of(scene.surfaces, [](const SceneSurface& surface) {
        return surface.streamlines.has_value() || surface.arrows.has_value();
    });
    if (has_glyphs && volume.shared_mapping()) {
        throw Error(scene.volume, "streamlines, pathlines and arrows cannot be drawn where no process knows all elements");
    }
    if (has_glyphs) {
        const TaskControl none;
        streamlines.provide(made, whole, ranges->bounds(), control != nullptr ? *control : none);
        arrows.provide(made, whole, ranges->bounds(), control != nullptr ? *control : none);
    }
    return made;
}

DrawParts VolumeInParts::Impl::drawing(const FrameRequest& request) {
    return [this, &request](const std::function<void(const PartPicture&)>& take) {
        for (const DrawnPart& part : parts) {
            std::array<Renderer*, 1> alone{&part.elements->renderer()};
            Frame frame = render_in_bands(alone, for_part(request, part), control);
            take(part_picture(part.part, std::move(frame), [&](std::int64_t number) { return part.own.hold(number); }));
        }
    };
}

/** Of what can be drawn in one piece alone. */
void VolumeInParts::Impl::need_memory_for(const FrameRequest& request, const Renderer& renderer,
                                          const std::string& what) const {
    if (renderer.most_pixels(request) < std::uint64_t{request.width} * request.height) {
        throw Error("image", "a picture of so many pixels of " + what + " cannot be drawn in parts on this device");
    }
}

/** Of a surface that can be seen through. */
DrawParts VolumeInParts::Impl::drawing_layers(const FrameRequest& alone) {
    FrameRequest request = alone;
    request.gives_layers = true;
    return [this, request](const std::function<void(const PartPicture&)>& take) {
        for (const DrawnPart& part : parts) {
            Renderer& renderer = part.elements->renderer();
            need_memory_for(request, renderer, "a surface that can be seen through");
            take(part_layers(part.part, renderer.render(for_part(request, part), control),
                             [&](std::int64_t number) { return part.own.hold(number); }));
        }
    };
}

/** `depths`: of what hides the volume, of each pixel; `stops`: FrameRequest::stops. */
DrawParts VolumeInParts::Impl::drawing_light(const FrameRequest& request, std::vector<double> depths,
                                             std::vector<std::vector<double>> stops) {
    FrameRequest light = request;
    light.surfaces.clear();
    light.with_buffers = false;
    light.gives_runs = true;
    light.hidden_from = std::make_shared<const std::vector<double>>(std::move(depths));
    light.stops = std::move(stops);
    return [this, light](const std::function<void(const PartPicture&)>& take) {
        for (const BarePart& part : bare_parts) {
            Renderer& renderer = part.elements->renderer();
            need_memory_for(light, renderer, "the volume itself");
            take(part_picture(part.part, renderer.render(light, control), {}));
        }
    };
}

/** Of a surface with line integral convolution, in all processes. */
std::vector<double> VolumeInParts::Impl::shades(const FrameRequest& alone, SharedFold& fold) {
    std::array<Frame, 3> components;
    double error = 0;
    for (std::size_t component = 0; component < components.size(); ++component) {
        const FrameRequest request = component_request(alone, component);
        components[component] = fold.collected(fold.surface(request, drawing(request)), true);
        if (!renderers.empty()) {
            const FieldChoice& vector = alone.surfaces[0].lic->vectors[component];
            error = std::hypot(error, renderers[0]->ranges().value_error(vector, alone.time_step, 0));
        }
    }
    return team.of_first(team.is_first() ? shades_of(device, precision, alone, components, ranges->bounds(), error)
                                         : std::vector<double>{});
}

/** As in the whole, an Error if there is nothing to draw. */
void VolumeInParts::Impl::need_faces(FrameRequest request) const {
    for (Surface& surface : request.surfaces) {
        ElementSelection* const selection = selection_of(surface);
        if (selection == nullptr) {
            continue;
        }
        double none = 1;
        for (const DrawnPart& part : parts) {
            selection->own = part.own.all();
            none = faces_of_elements(part.elements->volume(), *selection, control).empty() ? none : 0;
        }
        team.minimum(std::span(&none, 1));
        if (none > 0) {
            throw Error(whole.path(), "has no such faces of elements for which all conditions hold");
        }
    }
}

SharedFrame VolumeInParts::Impl::draw_surfaces(const FrameRequest& request, SharedFold& fold) {
    SharedFrame picture = fold.empty();
    // One by one: a part cannot tell which lines of a surface another surface hides.
    for (const std::size_t index : drawing_order(request.surfaces)) {
        FrameRequest alone = request;
        alone.surfaces = {request.surfaces[index]};
        alone.volume.reset();
        if (alone.surfaces[0].lic) {
            alone.shades = std::make_shared<const std::vector<double>>(shades(alone, fold));
        }
        if (alone.surfaces[0].opacity < 1) {
            fold.add_layers(alone, drawing_layers(alone), index, picture);
        } else {
            fold.add(fold.surface(alone, drawing(alone)), index, picture);
        }
    }
    fold.finish_surfaces(picture);
    return picture;
}

/** Of the first process; elsewhere empty. */
Frame VolumeInParts::Impl::draw(const FrameRequest& request, bool with_buffers) {
    SharedFold fold(request, precision, diagonal_of(ranges->bounds()), team);
    SharedFrame picture = draw_surfaces(request, fold);
    if (request.volume) {
        fold.add_light(drawing_light(request, fold.depths(picture), fold.stops(picture)), picture);
    }
    work.fold = fold.work();
    return fold.collected(std::move(picture), with_buffers);
}

/**
 * With several samples a pixel, colours are means of a finer picture, which is never in memory as a whole. Between parts its
 * lines may be open where those of the picture itself are not: doubt is taken, too.
 */
void VolumeInParts::Impl::take_means_of_finer(const FrameRequest& request, std::uint32_t n, std::uint32_t most_pixels,
                                              Frame& frame) {
    FrameRequest fine = finer(request, n);
    fine.with_buffers = true; // Of what parts show, not of the picture.
    const std::uint32_t unit = part_rows * n, n_rows = std::max(unit, most_pixels / std::max(1u, fine.width) / unit * unit);
    const Frame of_means = render_band_by_band(
        fine, n_rows, [this](const FrameRequest& band) { return draw(band, false); },
        [&](const Frame& band, const Rows& rows) {
            if (team.is_first()) {
                take_means(band, rows, n, frame.color);
                take_doubts(band, rows, n, frame);
            }
        });
    frame.render_milliseconds += of_means.render_milliseconds;
    frame.device_milliseconds += of_means.device_milliseconds;
}

std::vector<PartsWork> VolumeInParts::Impl::work_of_all() {
    work.rank = team.rank();
    work.device_bytes = 0;
    for (const DrawnPart& part : parts) {
        work.device_bytes += device_bytes(part.elements->renderer());
    }
    for (const BarePart& part : bare_parts) {
        work.device_bytes += device_bytes(part.elements->renderer());
    }
    work.peak_memory_bytes = peak_memory();
    const auto own = std::as_bytes(std::span(&work, 1));
    std::vector<PartsWork> all;
    for (const std::vector<std::byte>& bytes : team.gathered({own.begin(), own.end()})) {
        std::memcpy(&all.emplace_back(), bytes.data(), sizeof work);
    }
    return all;
}

VolumeInParts::VolumeInParts(const PartedVolume& volume, const Device& device, Precision precision, Partition partition,
                             Team& team, const TaskControl* control)
    : m_impl(new Impl{volume, volume.whole(), device, precision, std::move(partition), team, control}) {
    Impl& impl = *m_impl;
    impl.boxes = all_boxes(impl.whole, impl.partition, team, control);
    const std::array<double, 6> bounds = box_around(impl.boxes);
    const Span own = own_parts(impl.partition, team);
    for (std::uint64_t part = own.first; part < own.end; ++part) {
        if (impl.partition.n_elements(part) > 0) {
            impl.open_part(static_cast<std::uint32_t>(part), bounds);
        }
    }
    impl.ranges = std::make_unique<WholeRanges>(volume, impl.boxes, impl.renderers, team);
}

VolumeInParts::~VolumeInParts() = default;

const PartsWork& VolumeInParts::own_work() const { return m_impl->work; }

void VolumeInParts::forget_fields(std::span<const std::uint32_t> fields) {
    for (const DrawnPart& part : m_impl->parts) {
        part.elements->forget_fields(fields);
    }
    for (const BarePart& part : m_impl->bare_parts) {
        part.elements->forget_fields(fields);
    }
    m_impl->ranges->forget_fields();
    m_impl->streamlines.forget();
    m_impl->arrows.forget();
}

PartsPicture VolumeInParts::draw(const Scene& asked, bool with_buffers, std::uint32_t most_fine_pixels) {
    Impl& impl = *m_impl;
    need_parts_can_draw(asked);
    const Scene scene = impl.with_glyphs(asked);
    PartsPicture picture;
    FrameRequest& request = picture.still.request;
    request = make_frame_request(scene, impl.whole, *impl.ranges);
    need_parts_can_draw(request, scene);
    impl.need_faces(request);
    request.with_buffers = true;
    ask_about_isosurfaces(request, *impl.ranges);
    if (request.volume) {
        impl.open_bare_parts();
    }
    impl.share_ranges(request);
    picture.still.frame = impl.draw(request, with_buffers);
    if (scene.samples > 1) {
        const FoldWork of_picture = impl.work.fold;
        impl.take_means_of_finer(request, scene.samples, most_fine_pixels, picture.still.frame);
        impl.work.fold = of_picture;
    }
    if (!with_buffers) {
        picture.still.frame.flags = {};
    }
    picture.work = impl.work_of_all();
    std::uint64_t n_lit_pixels = 0;
    for (const PartsWork& of_rank : picture.work) {
        n_lit_pixels += of_rank.fold.n_lit_pixels;
        picture.n_runs += of_rank.fold.n_runs;
        picture.fold_milliseconds = std::max(picture.fold_milliseconds, of_rank.fold.milliseconds);
    }
    picture.still.frame.counts.volume_pixels = n_lit_pixels;
    if (impl.team.is_first()) {
        picture.still.remarks = remarks_on(scene, request);
        finish_still(scene, impl.whole, picture.still);
        MissedSurfaces missed;
        missed.add(request, picture.still.frame);
        for (const std::string& text : missed.remarks(scene, request, *impl.ranges)) {
            picture.still.remarks.push_back({true, text});
        }
    }
    return picture;
}

void need_parts_can_draw(const Scene& scene) {
    if (!scene.volumes.empty()) {
        refuse(scene, "several volumes");
    }
    if (scene.memory) {
        refuse(scene, "a scene with a budget of memory ('memory')");
    }
}

} // namespace elvis
