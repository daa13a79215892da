#include <core/render/color_pass.hpp>
#include <core/render/cut_plane_geometry.hpp>
#include <core/render/cut_plane_pass.hpp>
#include <core/render/device_time.hpp>
#include <core/render/face_pass.hpp>
#include <core/render/field_range.hpp>
#include <core/render/real_array.hpp>
#include <core/render/renderer.hpp>

#include <core/base/error.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace elvis {

namespace {

using Clock = std::chrono::steady_clock;
double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/** Rounding of a float32 field value, relative to the largest: what evaluations of orders up to 10 show (5e-7), doubled. */
constexpr double float32_value_error = 1e-6;
/** What a colour channel may be off. */
constexpr double channel_tolerance = 1e-3;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

FieldRange magnitude_range(const std::vector<FieldRange>& components) {
    double lower = 0, upper = 0;
    for (const FieldRange& range : components) {
        const double near = range.lower > 0 ? range.lower : range.upper < 0 ? -range.upper : 0;
        const double far = std::max(std::abs(range.lower), std::abs(range.upper));
        lower += near * near;
        upper += far * far;
    }
    return {std::sqrt(lower), std::sqrt(upper)};
}

/** One sample as the device writes it (shaders/library/samples.glsl). */
template <class Real> struct Sample {
    Real value, depth;
    std::uint32_t number;
};

} // namespace

struct Renderer::Impl {
    const Device& device;
    const RuntimeVolume& volume;
    Precision precision;
    const TaskControl* control;
    DeviceVolume data;
    ColorPass color_pass;
    std::optional<CutPlanePass> cut_planes;
    /** Boundary faces by the groups asked for, and the pass that draws those of the last frame. */
    std::map<std::vector<std::string>, FaceSet> face_sets;
    std::optional<FacePass> faces;
    std::optional<std::vector<std::string>> drawn_boundary;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::vector<FieldRange>, elvis_certainty>> ranges;
    std::optional<FieldChoice> selected;
    std::uint32_t selected_step = 0;
    RendererTimes times;
    /** Kept from frame to frame: fresh memory costs a page fault for each page. */
    std::optional<Buffer> samples, marks, colors, normals;

    Impl(const Device& on, const RuntimeVolume& of, Precision with, const TaskControl* task)
        : device(on), volume(of), precision(with), control(task), data(on, of, with, task), color_pass(on, with) {
        times.hierarchy_milliseconds = data.hierarchy_milliseconds();
    }

    const std::pair<std::vector<FieldRange>, elvis_certainty>& component_ranges(std::uint32_t field, std::uint32_t time_step);
    void select(const FieldChoice& field, std::uint32_t time_step);
    template <class Real>
    void read_samples(const std::vector<Vector3>& plane_normals, double offset, bool with_buffers, Frame& frame) const;
    std::uint32_t flags_of_range(const FrameRequest& request, double offset);
    void provide_buffers(std::uint64_t n_pixels);
    void provide_faces(const FrameRequest& request, std::uint64_t n_pixels);
    bool is_surface() const { return volume.dimension() == 2; }
    CutPlane plane_across(const Camera& camera) const;
};

void Renderer::Impl::provide_buffers(std::uint64_t n_pixels) {
    if (!samples || samples->bytes() != n_pixels * sample_bytes(precision)) {
        samples.reset();
        colors.reset();
        samples.emplace(device, n_pixels * sample_bytes(precision));
        marks.reset();
        marks.emplace(device, n_pixels * sizeof(Mark));
        colors.emplace(device, 4 * n_pixels * real_bytes(precision));
        normals.reset();
    }
}

/** The pass that draws what the request asks for, if any, and where it writes normals. */
void Renderer::Impl::provide_faces(const FrameRequest& request, std::uint64_t n_pixels) {
    if (!is_surface() && request.boundary != drawn_boundary) {
        faces.reset();
        drawn_boundary = request.boundary;
    }
    const bool is_wanted = is_surface() || request.boundary.has_value();
    if (is_wanted && !faces) {
        const FaceSet* set = nullptr;
        if (!is_surface()) {
            const auto [found, is_new] =
                face_sets.try_emplace(*request.boundary, device, volume, precision, data.centre(), *request.boundary, control);
            set = &found->second;
        }
        const Clock::time_point start = Clock::now();
        faces.emplace(device, volume, data, set);
        times.compile_milliseconds += milliseconds_since(start);
    }
    if (is_wanted && !normals) {
        normals.emplace(device, 3 * n_pixels * real_bytes(precision));
    }
}

const std::pair<std::vector<FieldRange>, elvis_certainty>& Renderer::Impl::component_ranges(std::uint32_t field,
                                                                                            std::uint32_t time_step) {
    const auto [found, is_new] = ranges.try_emplace({field, time_step});
    if (is_new) {
        elvis_certainty certainty = ELVIS_ESTIMATED;
        const std::uint32_t n_components = volume.fields()[field].n_components;
        std::vector<FieldRange> all;
        if (volume.has_field_ranges()) {
            all = ranges_from_plugin(volume, field, time_step, certainty);
        } else {
            data.select(field, time_step, std::vector<double>(n_components, 0.0));
            selected.reset();
            all = ranges_from_samples(device, volume, data, n_components);
        }
        found->second = {std::move(all), certainty};
    }
    return found->second;
}

void Renderer::Impl::select(const FieldChoice& field, std::uint32_t time_step) {
    const bool is_same =
        selected && selected->field == field.field && selected->component == field.component && selected_step == time_step;
    if (is_same) {
        return;
    }
    const std::vector<FieldRange>& components = component_ranges(field.field, time_step).first;
    std::vector<double> offset(components.size(), 0.0);
    // The middle of the range, so that small variations of large values keep their digits; a magnitude needs the values
    // themselves.
    if (field.component >= 0) {
        const FieldRange& range = components[static_cast<std::size_t>(field.component)];
        const double middle = 0.5 * (range.lower + range.upper);
        offset[static_cast<std::size_t>(field.component)] = std::isfinite(middle) ? middle : 0.0;
    }
    // What a field's buffers hold depends on the offset: fill them again for another component.
    data.select(field.field, time_step, offset);
    times.upload_milliseconds = data.upload_milliseconds();
    const Clock::time_point start = Clock::now();
    faces.reset();
    if (!is_surface()) {
        cut_planes.emplace(device, volume, data);
    }
    times.compile_milliseconds = milliseconds_since(start);
    selected = field;
    selected_step = time_step;
}

std::uint32_t Renderer::Impl::flags_of_range(const FrameRequest& request, double offset) {
    if (precision == Precision::float64 || request.colors.points.size() < 2) {
        return 0;
    }
    const auto& [components, certainty] = component_ranges(request.field.field, request.time_step);
    const FieldRange range = request.field.component < 0 ? magnitude_range(components)
                                                         : components[static_cast<std::size_t>(request.field.component)];
    const double largest = std::max(std::abs(range.lower - offset), std::abs(range.upper - offset));
    const double extent = request.colors.points.back().value - request.colors.points.front().value;
    return float32_value_error * largest > channel_tolerance * extent ? pixel_flag::range_too_fine : 0;
}

/** Across the view, through the middle of the volume: what rays are anchored at. */
CutPlane Renderer::Impl::plane_across(const Camera& camera) const {
    CutPlane plane;
    const std::array<double, 6>& bounds = data.bounds();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        plane.plane[axis] = camera.look_at[axis] - camera.eye[axis];
        plane.plane[3] -= plane.plane[axis] * 0.5 * (bounds[axis] + bounds[axis + 3]);
    }
    return plane;
}

template <class Real>
void Renderer::Impl::read_samples(const std::vector<Vector3>& plane_normals, double offset, bool with_buffers,
                                  Frame& frame) const {
    const std::size_t n_pixels = frame.counts.pixels;
    const std::vector<Real> read_colors = colors->read_items<Real>(4 * n_pixels);
    frame.color.assign(read_colors.begin(), read_colors.end());
    const std::vector<Mark> read_marks = marks->read_items<Mark>(n_pixels);
    for (const Mark& mark : read_marks) {
        frame.counts.hit_pixels += mark.surface() != 0 ? 1 : 0;
        frame.counts.undecided_pixels += (mark.flags & pixel_flag::undecided) != 0 ? 1 : 0;
        frame.counts.nan_pixels += (mark.flags & pixel_flag::nan) != 0 ? 1 : 0;
        frame.counts.work_limit_pixels += (mark.flags & pixel_flag::work_limit) != 0 ? 1 : 0;
        frame.counts.estimated_pixels += (mark.flags & pixel_flag::estimated) != 0 ? 1 : 0;
    }
    if (!with_buffers) {
        return;
    }
    const std::vector<Sample<Real>> read = samples->read_items<Sample<Real>>(n_pixels);
    frame.value.assign(n_pixels, not_a_number);
    frame.depth.assign(n_pixels, not_a_number);
    frame.normal.assign(3 * n_pixels, not_a_number);
    frame.element.assign(n_pixels, -1);
    frame.flags.resize(n_pixels);
    const std::vector<Real> of_faces = this->normals ? this->normals->read_items<Real>(3 * n_pixels) : std::vector<Real>();
    for (std::size_t pixel = 0; pixel < n_pixels; ++pixel) {
        const Sample<Real>& sample = read[pixel];
        const Mark& mark = read_marks[pixel];
        frame.flags[pixel] = mark.flags;
        if (mark.surface() != 0) {
            frame.value[pixel] = static_cast<double>(sample.value) + offset;
            frame.depth[pixel] = static_cast<double>(sample.depth);
            frame.element[pixel] = sample.number;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const bool is_plane = mark.surface() <= plane_normals.size();
                frame.normal[3 * pixel + axis] =
                    is_plane ? plane_normals[mark.surface() - 1][axis] : static_cast<double>(of_faces[3 * pixel + axis]);
            }
        }
    }
}

Renderer::Renderer(const Device& device, const RuntimeVolume& volume, Precision precision, const TaskControl* control) {
    m_impl = std::make_unique<Impl>(device, volume, precision, control);
}

Renderer::~Renderer() = default;

std::array<double, 6> Renderer::bounds() const { return m_impl->data.bounds(); }

FieldRange Renderer::field_range(const FieldChoice& field, std::uint32_t time_step, elvis_certainty* certainty) {
    const auto& [components, how_sure] = m_impl->component_ranges(field.field, time_step);
    if (certainty) {
        *certainty = how_sure;
    }
    return field.component < 0 ? magnitude_range(components) : components[static_cast<std::size_t>(field.component)];
}

Frame Renderer::render(const FrameRequest& request) {
    Impl& impl = *m_impl;
    const std::uint64_t n_pixels = std::uint64_t{request.width} * request.height;
    if (n_pixels == 0 || n_pixels >= 0x7fffffffu) {
        throw Error("image", "a picture of " + std::to_string(request.width) + " x " + std::to_string(request.height) +
                                 " pixels cannot be drawn");
    }
    if (impl.is_surface() && (!request.cut_planes.empty() || request.boundary)) {
        throw Error(impl.volume.path(), "is two-dimensional: it is drawn as a surface, without planes or boundary");
    }
    impl.select(request.field, request.time_step);
    const double offset =
        request.field.component < 0 ? 0.0 : impl.data.field_offset(static_cast<std::uint32_t>(request.field.component));
    const std::uint32_t common_flags = impl.flags_of_range(request, offset);

    Frame frame;
    frame.width = request.width;
    frame.height = request.height;
    frame.counts.pixels = n_pixels;

    impl.provide_buffers(n_pixels);
    impl.provide_faces(request, n_pixels);
    const FieldInfo& field = impl.volume.fields()[request.field.field];
    const ShownComponent component{request.field.component, field.n_components,
                                   field.continuity != ELVIS_CONTINUITY_CONTINUOUS};
    std::vector<Vector3> normals;
    const DeviceTimer timer(impl.device);
    impl.marks->fill(0);
    const SampleTarget target{*impl.samples, *impl.marks, request.width, request.height};
    for (std::uint32_t surface = 0; surface < request.cut_planes.size(); ++surface) {
        const CutPlaneGeometry geometry =
            cut_plane_geometry(request.cut_planes[surface], request.camera, request.width, request.height, impl.data.centre());
        normals.push_back(geometry.normal);
        impl.cut_planes->draw(geometry, surface + 1, component, target, frame.counts);
    }
    if (impl.faces) {
        const CutPlaneGeometry view = cut_plane_geometry(impl.plane_across(request.camera), request.camera, request.width,
                                                         request.height, impl.data.centre());
        impl.faces->draw(view, static_cast<std::uint32_t>(request.cut_planes.size()) + 1, component, target, *impl.normals,
                         frame.counts);
    }
    impl.color_pass.draw(target, *impl.colors, request.colors, request.background, offset, common_flags);
    frame.render_milliseconds = timer.wall_milliseconds();
    frame.device_milliseconds = timer.milliseconds();

    if (impl.precision == Precision::float64) {
        impl.read_samples<double>(normals, offset, request.with_buffers, frame);
    } else {
        impl.read_samples<float>(normals, offset, request.with_buffers, frame);
    }
    return frame;
}

const RendererTimes& Renderer::times() const { return m_impl->times; }

RendererMemory Renderer::memory() const {
    return {m_impl->data.field_bytes(), m_impl->data.geometry_bytes(), m_impl->data.hierarchy_bytes()};
}

} // namespace elvis
