#include <core/render/device_time.hpp>
#include <core/render/real_array.hpp>
#include <core/render/segment_pass.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

namespace {

constexpr std::uint32_t group_size = 32;
/** Rays of one dispatch, and of one batch, whose lists are in memory at once. */
constexpr std::uint32_t rays_a_dispatch = 1u << 15;
constexpr std::size_t rays_a_batch = 1u << 17;
/** Segments of a ray's list; a ray that has more goes on in another dispatch. */
constexpr std::uint32_t capacity = 32;
/** Turns of a ray in a dispatch: with all loops inside below where drivers end them. */
constexpr std::uint32_t turns_a_dispatch = 1000;
constexpr std::size_t n_counts = 8;
constexpr std::uint32_t most_rounds = 64;
constexpr std::uint32_t estimated_part = 0x80000000u;

/** Of the volume's size: how far ends may be off, with room for rounding below 1e-6 and 1e-13. */
double tolerance(Precision precision) { return precision == Precision::float64 ? 2e-14 : 2.5e-7; }

struct Parameters {
    std::uint32_t first_ray, n_rays, capacity, n_turns, zero;
    float wanted_from, wanted_to;
};

template <class Real> struct RayState {
    Real done, done_error;
    std::uint32_t n_segments, is_over;
};

template <class Real> struct SegmentRecord {
    Real enter, leave, error;
    std::uint32_t element;
};

Vector3 rounded(const Vector3& v, Precision precision) {
    return precision == Precision::float64 ? v : Vector3{double(float(v[0])), double(float(v[1])), double(float(v[2]))};
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

/** A batch of rays on the device. */
struct SegmentPass::Rays {
    std::uint32_t n_rays = 0, capacity = 0;
    const Buffer &rays, &states, &segments;
    const Buffer& counts;
    std::array<double, 2> wanted{-3e38, 3e38};
};

SegmentPass::SegmentPass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data,
                         const std::optional<SkippedField>& skipped)
    : m_device(device), m_data(data), m_precision(data.precision()),
      m_frame(device, 4 * real_bytes(data.precision()), Buffer::Use::uniform) {
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        const ClassInfo& info = volume.classes()[index];
        if (info.n_elements == 0) {
            continue;
        }
        ElementLinks links = make_element_links(device, volume, index, data.hierarchy(index), data.curvatures(index),
                                                skipped ? ranges(volume, info, *skipped) : std::vector<double>{}, m_precision);
        KernelRequest request;
        request.name = "segments of element class " + std::to_string(index);
        request.kernel = "kernels/segments.comp";
        request.precision = m_precision;
        request.instances = {data.instance(index)};
        request.defines = {{"CORE_SKIPS_RANGES", skipped ? "1" : "0"}};
        request.buffers = data.host_buffers(index);
        request.buffers.push_back({"core_links", links.links.get()});
        request.buffers.push_back({"core_node_marks", links.node_marks.get()});
        request.bindings = {{0, BindingType::uniform_buffer},
                            {1, BindingType::storage_buffer},
                            {2, BindingType::storage_buffer},
                            {3, BindingType::storage_buffer},
                            {4, BindingType::storage_buffer}};
        request.push_constant_bytes = sizeof(Parameters);
        m_kernels.push_back({std::move(links), std::make_unique<ComposedKernel>(device, request), info.first_element});
    }
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double side = data.bounds()[i + 3] - data.bounds()[i];
        square += side * side;
    }
    m_tolerance = tolerance(m_precision) * std::sqrt(square);
    const std::array<double, 4> frame = {data.centre()[0], data.centre()[1], data.centre()[2], m_tolerance};
    write_reals(m_frame, m_precision, frame);
}

std::vector<double> SegmentPass::ranges(const RuntimeVolume& volume, const ClassInfo& info, const SkippedField& field) const {
    if (!volume.has_field_ranges()) {
        return {};
    }
    const std::size_t n_components = volume.fields()[field.field].n_components;
    std::vector<FieldRange> found(info.n_elements * n_components);
    // What is not certified must not be relied on.
    const bool is_certain =
        volume.field_ranges(field.field, field.time_step, info.first_element, info.n_elements, found) == ELVIS_CERTIFIED;
    std::vector<double> result;
    for (std::size_t element = 0; is_certain && element < info.n_elements; ++element) {
        const FieldRange& range = found[element * n_components];
        result.insert(result.end(), {range.lower, range.upper});
    }
    return result;
}

void SegmentPass::run(const ClassKernel& of, const Rays& rays, SegmentCounts& counts) const {
    const std::array<const Buffer*, 5> bindings = {&m_frame, &rays.rays, &rays.states, &rays.segments, &rays.counts};
    for (std::uint32_t first = 0; first < rays.n_rays; first += rays_a_dispatch) {
        const Parameters parameters{first, std::min(rays.n_rays, first + rays_a_dispatch), rays.capacity, turns_a_dispatch, 0,
                                    // Outward.
                                    std::nextafter(static_cast<float>(rays.wanted[0]), -std::numeric_limits<float>::max()),
                                    std::nextafter(static_cast<float>(rays.wanted[1]), std::numeric_limits<float>::max())};
        of.kernel->dispatch(bindings, std::as_bytes(std::span(&parameters, 1)),
                            (parameters.n_rays - first + group_size - 1) / group_size);
        ++counts.dispatches;
    }
}

namespace {

/** Calls `take` with the states after each round of dispatches until all rays are over. */
template <class Real, class Run, class Take>
void finish(std::span<const SegmentRay> rays, const Buffer& ray_buffer, const Buffer& states, const Buffer& count_buffer,
            Precision precision, SegmentCounts& counts, const Run& run, const Take& take) {
    std::vector<double> numbers;
    std::vector<RayState<Real>> start;
    for (const SegmentRay& ray : rays) {
        numbers.insert(numbers.end(), {ray.origin[0], ray.origin[1], ray.origin[2], ray.from, ray.direction[0], ray.direction[1],
                                       ray.direction[2], ray.to});
        start.push_back({static_cast<Real>(ray.from), 0, 0, 0});
    }
    write_reals(ray_buffer, precision, numbers);
    states.write_items(std::span<const RayState<Real>>(start));
    for (std::uint32_t round = 0, n_open = 1; n_open > 0; ++round) {
        if (round == most_rounds) {
            counts.failures += n_open;
            break;
        }
        count_buffer.fill(0);
        run();
        const std::vector<std::uint32_t> found = count_buffer.read_items<std::uint32_t>(n_counts);
        counts.segments += found[0];
        counts.evaluations += found[1];
        counts.overlaps += found[2];
        counts.failures += found[3];
        counts.estimated += found[4];
        counts.turns += found[6];
        counts.breaks += found[7];
        n_open = found[5];
        take();
    }
}

} // namespace

std::vector<std::vector<Segment>> SegmentPass::lists(std::span<const SegmentRay> rays, SegmentCounts& counts,
                                                      const std::array<double, 2>& wanted) const {
    std::vector<std::vector<Segment>> result(rays.size());
    const auto trace = [&]<class Real>(Real) {
        const std::size_t size = std::min(rays.size(), rays_a_batch);
        const Buffer ray_buffer(m_device, 8 * sizeof(Real) * size), states(m_device, sizeof(RayState<Real>) * size);
        const Buffer segments(m_device, sizeof(SegmentRecord<Real>) * size * capacity);
        const Buffer count_buffer(m_device, n_counts * sizeof(std::uint32_t));
        for (std::size_t first = 0; first < rays.size(); first += size) {
            const std::size_t count = std::min(size, rays.size() - first);
            const Rays batch{static_cast<std::uint32_t>(count), capacity, ray_buffer, states, segments, count_buffer, wanted};
            std::vector<std::vector<std::vector<Segment>>> of_classes(count);
            for (const ClassKernel& of : m_kernels) {
                std::vector<std::vector<Segment>> found(count);
                const auto take = [&] {
                    const auto ends = states.read_items<RayState<Real>>(count);
                    const auto records = segments.read_items<SegmentRecord<Real>>(count * capacity);
                    for (std::size_t ray = 0; ray < count; ++ray) {
                        for (std::size_t i = ray * capacity; i < ray * capacity + ends[ray].n_segments; ++i) {
                            found[ray].push_back({static_cast<double>(records[i].enter), static_cast<double>(records[i].leave),
                                                  static_cast<double>(records[i].error),
                                                  of.first_element + (records[i].element & ~estimated_part),
                                                  (records[i].element & estimated_part) != 0});
                        }
                    }
                };
                const auto run_class = [&] {
                    const DeviceTimer timer(m_device);
                    run(of, batch, counts);
                    counts.milliseconds += timer.milliseconds();
                };
                finish<Real>(rays.subspan(first, count), ray_buffer, states, count_buffer, m_precision, counts, run_class, take);
                for (std::size_t ray = 0; ray < count; ++ray) {
                    of_classes[ray].push_back(std::move(found[ray]));
                }
            }
            for (std::size_t ray = 0; ray < count; ++ray) {
                result[first + ray] = merge_segments(of_classes[ray], m_tolerance, counts.overlaps);
            }
        }
    };
    if (m_precision == Precision::float64) {
        trace(double{});
    } else {
        trace(float{});
    }
    return result;
}

std::vector<double> SegmentPass::lengths(std::span<const SegmentRay> rays, SegmentCounts& counts) const {
    std::vector<double> result;
    const auto trace = [&]<class Real>(Real) {
        const Buffer ray_buffer(m_device, 8 * sizeof(Real) * rays.size()), states(m_device, sizeof(RayState<Real>) * rays.size());
        const Buffer sums(m_device, sizeof(SegmentRecord<Real>) * rays.size());
        const Buffer count_buffer(m_device, n_counts * sizeof(std::uint32_t));
        sums.fill(0);
        const Rays all{static_cast<std::uint32_t>(rays.size()), 0, ray_buffer, states, sums, count_buffer, {-3e38, 3e38}};
        for (const ClassKernel& of : m_kernels) {
            const auto run_class = [&] {
                const DeviceTimer timer(m_device);
                run(of, all, counts);
                counts.milliseconds += timer.milliseconds();
            };
            finish<Real>(rays, ray_buffer, states, count_buffer, m_precision, counts, run_class, [] {});
        }
        for (const SegmentRecord<Real>& record : sums.read_items<SegmentRecord<Real>>(rays.size())) {
            result.push_back(static_cast<double>(record.enter));
        }
    };
    if (m_precision == Precision::float64) {
        trace(double{});
    } else {
        trace(float{});
    }
    return result;
}

std::vector<Segment> merge_segments(std::span<const std::vector<Segment>> lists, double least_gap, std::uint64_t& n_overlaps) {
    std::vector<Segment> all;
    for (const std::vector<Segment>& list : lists) {
        all.insert(all.end(), list.begin(), list.end());
    }
    std::ranges::stable_sort(all, {}, &Segment::enter);
    std::vector<Segment> merged;
    for (Segment segment : all) {
        if (!merged.empty()) {
            const Segment& last = merged.back();
            const double error = segment.error + last.error;
            const bool is_joined = std::abs(segment.enter - last.leave) <= error + least_gap;
            n_overlaps += !is_joined && segment.enter < last.leave && segment.leave - segment.enter > error ? 1 : 0;
            segment.enter = is_joined ? last.leave : std::max(segment.enter, last.leave);
        }
        if (segment.enter >= segment.leave) {
            continue;
        }
        // A part that ended early, where a bound could not be held, and goes on.
        if (!merged.empty() && segment.element == merged.back().element && segment.enter == merged.back().leave) {
            merged.back().leave = segment.leave;
            merged.back().error = std::max(merged.back().error, segment.error);
            merged.back().is_estimated = merged.back().is_estimated || segment.is_estimated;
        } else {
            merged.push_back(segment);
        }
    }
    return merged;
}

} // namespace elvis
