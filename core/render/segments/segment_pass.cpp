#include <core/render/device/device_time.hpp>
#include <core/render/segments/segment_pass.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

namespace {

/** Whose lists are in memory at once. */
constexpr std::size_t rays_a_batch = 1u << 15;
/** Segments of a ray's list; a ray that has more goes on when they are taken. */
constexpr std::uint32_t list_capacity = 48;
/** More than any ray has walks, and walks segments in different classes, and their segments take dispatches. */
constexpr std::uint32_t most_segment_rounds = 4096;
constexpr std::uint32_t estimated_segment = 0x80000000u;
/** Of shaders/segments/walk_state.glsl. */
constexpr std::uint32_t ray_seeks = 0, ray_ends = 2, no_element = 0xffffffffu;
constexpr double far = 3e38;

constexpr std::size_t n_segment_counts = 8;
struct SegmentMarchCount {
    enum : std::size_t { moved, segments, evaluations, overlaps, failures, estimated, breaks, full };
};

struct SegmentMarchParameters {
    std::uint32_t width, height;
    std::uint32_t first_row;
    std::uint32_t first_element, n_elements;
    std::uint32_t capacity;
    std::uint32_t zero;
    float extent, data_error;
};

/** Of shaders/segments/segment_state.glsl. */
template <class Real> struct RayState {
    Real done = -static_cast<Real>(far), at = static_cast<Real>(far), start = -static_cast<Real>(far);
    std::uint32_t start_element = no_element, element = no_element;
    std::uint32_t status = ray_seeks, flags = 0;
    Real done_error = 0, at_error = 0, sum = 0;
    std::uint32_t n_segments = 0, is_estimated = 0;
};

template <class Real> struct SegmentRecord {
    Real enter, leave, error;
    std::uint32_t element;
};

Vector3 rounded(const Vector3& v, Precision precision) {
    return precision == Precision::float64 ? v : Vector3{double(float(v[0])), double(float(v[1])), double(float(v[2]))};
}

/** Whether segments may be missing of a ray that has been followed as far as it was. */
template <class Real> bool is_undecided(const RayState<Real>& state) {
    return state.status != ray_ends || (state.flags & (pixel_flag::undecided | pixel_flag::work_limit)) != 0;
}

/** Adds to the list; what goes on in the same element becomes longer. */
void append(std::vector<Segment>& list, const Segment& segment) {
    // A segment that ended early, where a bound could not be held.
    if (!list.empty() && segment.element == list.back().element && segment.enter == list.back().leave) {
        list.back().leave = segment.leave;
        list.back().error = std::max(list.back().error, segment.error);
        list.back().is_estimated = list.back().is_estimated || segment.is_estimated;
    } else {
        list.push_back(segment);
    }
}

} // namespace

SegmentRay near_centre(const Vector3& eye, const Vector3& towards, const std::array<double, 3>& centre, Precision precision) {
    std::array<long double, 3> direction{}, origin{};
    long double square = 0, along = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        direction[i] = static_cast<long double>(towards[i]) - eye[i];
        origin[i] = static_cast<long double>(eye[i]) - centre[i];
        square += direction[i] * direction[i];
        along -= origin[i] * direction[i];
    }
    const long double size = std::sqrt(square);
    SegmentRay ray;
    for (std::size_t i = 0; i < 3; ++i) {
        ray.origin[i] = static_cast<double>(origin[i] + along / square * direction[i]);
        ray.direction[i] = static_cast<double>(direction[i] / size);
    }
    ray.origin = rounded(ray.origin, precision);
    ray.direction = rounded(ray.direction, precision);
    ray.from = static_cast<double>(-along / size);
    return ray;
}

/** Rays on the device, those of a picture or a row of them that are given, and their lists. */
struct SegmentPass::Rays {
    WalkRays walk;
    /** Of a ray's list; 0: no lists. */
    std::uint32_t capacity = 0;
    const Buffer& segments;
};

SegmentPass::SegmentPass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data,
                         const std::optional<SkippedField>& skipped)
    : m_device(device), m_volume(volume), m_data(data), m_precision(data.precision()), m_skipped(skipped),
      m_walk_data(device, volume, data), m_frame(view_buffer(device, data.precision())),
      m_counts(device, n_segment_counts * sizeof(std::uint32_t)) {}

SegmentPass::Kernels& SegmentPass::kernels_for(bool are_given) {
    std::optional<Kernels>& kernels = m_kernels[are_given];
    if (!kernels) {
        kernels.emplace(WalkSearch(m_device, m_data, m_walk_data, m_volume,
                                   {{"CORE_MAKES_SEGMENTS", "1"}, {"CORE_RAYS_ARE_GIVEN", are_given ? "1" : "0"}}, are_given));
        kernels->search.compile();
        for (const WalkSearch::Range& range : kernels->search.ranges()) {
            KernelRequest march = kernels->search.request(range, "segments/segments");
            march.instances = {m_data.instance(range.element_class)};
            march.bindings = buffer_bindings({.uniform = 1, .storage = are_given ? 4u : 3u});
            march.push_constant_bytes = sizeof(SegmentMarchParameters);
            kernels->march.push_back(std::make_unique<ComposedKernel>(m_device, march));
        }
    }
    return *kernels;
}

std::vector<std::vector<bool>> SegmentPass::elements_with(const std::array<double, 2>& wanted) const {
    if (!m_skipped || !m_volume.has_field_ranges()) {
        return {};
    }
    const std::size_t n_components = m_volume.fields()[m_skipped->field].n_components;
    std::vector<std::vector<bool>> kept;
    for (const ClassInfo& info : m_volume.classes()) {
        std::vector<FieldRange> found(info.n_elements * n_components);
        // What is not certified must not be relied on.
        const bool is_certain =
            info.n_elements > 0 && m_volume.field_ranges(m_skipped->field, m_skipped->time_step, info.first_element,
                                                         info.n_elements, found) == ELVIS_CERTIFIED;
        kept.emplace_back(info.n_elements, true);
        for (std::size_t element = 0; is_certain && element < info.n_elements; ++element) {
            const FieldRange& range = found[element * n_components];
            kept.back()[element] = !(range.lower > wanted[1] || range.upper < wanted[0]);
        }
    }
    return kept;
}

/** Until all rays are at their end; calls `take` where lists are full, and at the end. */
template <class Take> void SegmentPass::run(Kernels& kernels, const Rays& rays, SegmentCounts& counts, const Take& take) const {
    const std::uint32_t tiles_a_row = kernels.search.tiles_a_row(rays.walk.width);
    AllRayGroups all;
    const RayGroups groups = rays.walk.given
                                 ? RayGroups{}
                                 : all.of(m_device, GroupShape(kernels.search.tile_width()), rays.walk.width, rays.walk.height);
    counts.seek_evaluations += kernels.search.start_at_eyes(rays.walk, groups);
    bool is_open = true;
    for (std::uint32_t round = 0; is_open && round < most_segment_rounds; ++round) {
        const DeviceTimer timer(m_device);
        bool is_full = false;
        kernels.search.begin_search();
        for (std::size_t index = 0; index < kernels.march.size(); ++index) {
            kernels.search.seek(index, rays.walk, groups);
        }
        const WalkSearch::Found found_starts = kernels.search.found();
        counts.seek_evaluations += found_starts.evaluations;
        is_open = found_starts.is_seeking;
        for (std::size_t index = 0; index < kernels.march.size(); ++index) {
            const WalkSearch::Range& range = kernels.search.ranges()[index];
            m_counts.fill(0);
            const SegmentMarchParameters parameters{
                rays.walk.width,         rays.walk.height,           0, range.first_element, range.n_elements, rays.capacity, 0,
                kernels.search.extent(), kernels.search.data_error()};
            std::vector<const Buffer*> bindings = {&m_frame, &rays.walk.states, &rays.segments, &m_counts};
            if (rays.walk.given != nullptr) {
                bindings.push_back(rays.walk.given);
            }
            kernels.march[index]->dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), tiles_a_row, rays.walk.height);
            const std::vector<std::uint32_t> found = m_counts.read_items<std::uint32_t>(n_segment_counts);
            counts.segments += found[SegmentMarchCount::segments];
            counts.evaluations += found[SegmentMarchCount::evaluations];
            counts.overlaps += found[SegmentMarchCount::overlaps];
            counts.failures += found[SegmentMarchCount::failures];
            counts.estimated += found[SegmentMarchCount::estimated];
            counts.breaks += found[SegmentMarchCount::breaks];
            is_open = is_open || found[SegmentMarchCount::moved] > 0;
            is_full = is_full || found[SegmentMarchCount::full] > 0;
        }
        counts.milliseconds += timer.milliseconds();
        if (is_full || !is_open) {
            take();
        }
    }
}

template <class Real>
void SegmentPass::list_batch(std::span<const SegmentRay> rays, SegmentList* lists, SegmentCounts& counts) {
    const std::size_t count = rays.size();
    const Buffer given(m_device, 8 * sizeof(Real) * count), states(m_device, sizeof(RayState<Real>) * count);
    const Buffer segments(m_device, sizeof(SegmentRecord<Real>) * count * list_capacity);
    std::vector<double> numbers;
    for (const SegmentRay& ray : rays) {
        numbers.insert(numbers.end(), {ray.origin[0], ray.origin[1], ray.origin[2], ray.from, ray.direction[0],
                                       ray.direction[1], ray.direction[2], ray.to});
    }
    write_reals(given, m_precision, numbers);
    states.write_items(std::span<const RayState<Real>>(std::vector<RayState<Real>>(count)));
    const Rays batch{{static_cast<std::uint32_t>(count), 1, m_frame, states, &given}, list_capacity, segments};
    bool has_open = false;
    run(kernels_for(true), batch, counts, [&] {
        auto ends = states.template read_items<RayState<Real>>(count);
        const auto records = segments.template read_items<SegmentRecord<Real>>(count * list_capacity);
        has_open = false;
        for (std::size_t ray = 0; ray < count; ++ray) {
            for (std::size_t i = ray * list_capacity; i < ray * list_capacity + ends[ray].n_segments; ++i) {
                append(lists[ray].segments, {static_cast<double>(records[i].enter), static_cast<double>(records[i].leave),
                                             static_cast<double>(records[i].error), records[i].element & ~estimated_segment,
                                             (records[i].element & estimated_segment) != 0});
            }
            ends[ray].n_segments = 0;
            lists[ray].is_undecided = is_undecided(ends[ray]);
            has_open = has_open || ends[ray].status != ray_ends;
        }
        states.write_items(std::span<const RayState<Real>>(ends));
    });
    counts.given_up += has_open ? 1 : 0;
    for (std::size_t ray = 0; ray < count; ++ray) {
        counts.undecided += lists[ray].is_undecided ? 1 : 0;
    }
}

std::vector<SegmentList> SegmentPass::lists(std::span<const SegmentRay> rays, SegmentCounts& counts,
                                            const std::array<double, 2>& wanted) {
    const double extent = kernels_for(true).search.extent();
    if (m_skipped) {
        m_walk_data.keep_only(elements_with(wanted));
    }
    const std::array<double, 3>& centre = m_data.centre();
    const std::array<double, 4> frame = {centre[0], centre[1], centre[2], 0};
    write_reals(m_frame, m_precision, frame);
    bool is_outside = true;
    ViewStart start;
    for (const SegmentRay& ray : rays) {
        bool is_in = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            start.eye[axis] = centre[axis] + ray.origin[axis] + ray.from * ray.direction[axis];
            is_in = is_in && start.eye[axis] >= m_data.bounds()[axis] - 1e-5 * extent &&
                    start.eye[axis] <= m_data.bounds()[axis + 3] + 1e-5 * extent;
        }
        is_outside = is_outside && !is_in;
    }
    // From outside rays come in through faces, wherever they start.
    if (is_outside) {
        m_walk_data.look_from(start);
    } else {
        m_walk_data.look_from_anywhere();
    }
    std::vector<SegmentList> result(rays.size());
    for (std::size_t first = 0; first < rays.size(); first += rays_a_batch) {
        const std::span<const SegmentRay> batch = rays.subspan(first, std::min(rays_a_batch, rays.size() - first));
        with_real(m_precision, [&]<class Real>(Real) { list_batch<Real>(batch, result.data() + first, counts); });
    }
    return result;
}

std::vector<double> SegmentPass::lengths(const CutPlaneGeometry& view, const ViewStart& start, std::uint32_t width,
                                         std::uint32_t height, SegmentCounts& counts) {
    Kernels& kernels = kernels_for(false);
    m_walk_data.look_from(start);
    write_view(m_frame, m_precision, view);
    const std::size_t count = std::size_t{width} * height;
    return with_real(m_precision, [&]<class Real>(Real) {
        const DeviceTimer timer(m_device);
        const Buffer states(m_device, sizeof(RayState<Real>) * count);
        states.write_items(std::span<const RayState<Real>>(std::vector<RayState<Real>>(count)));
        // No lists: anything.
        const Rays rays{{width, height, m_frame, states, nullptr}, 0, m_counts};
        kernels.search.list_starts(rays.walk);
        counts.milliseconds += timer.milliseconds();
        std::vector<double> sums;
        run(kernels, rays, counts, [&] {
            for (const RayState<Real>& state : states.template read_items<RayState<Real>>(count)) {
                sums.push_back(static_cast<double>(state.sum));
                counts.given_up += state.status != ray_ends ? 1 : 0;
                counts.undecided += is_undecided(state) ? 1 : 0;
            }
        });
        return sums;
    });
}

} // namespace elvis
