#include <core/base/error.hpp>
#include <core/base/in_parts.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/probe/cpu_evaluator.hpp>
#include <core/probe/device_evaluator.hpp>
#include <core/probe/probe.hpp>

#include <algorithm>
#include <cmath>
#include <thread>

namespace elvis {
namespace {

std::unique_ptr<PointEvaluator> make_evaluator(const RuntimeVolume& volume, const ProbeOptions& options) {
    // What is inside of elements that are cut, only their snippet tells.
    const bool is_cut = volume.is_cut();
    const bool on_cpu = options.evaluation == ProbeOptions::Evaluation::cpu ||
                        (options.evaluation == ProbeOptions::Evaluation::automatic && volume.has_evaluation() && !is_cut);
    if (!on_cpu) {
        if (volume.dimension() != 3)
            throw Error(volume.path(), "has two dimensions, in which points are found on the CPU alone; the plugin " +
                                           volume.plugin().id() + " does not evaluate there");
        return std::make_unique<DeviceEvaluator>(volume, options.device);
    }
    if (is_cut)
        throw Error(volume.path(),
                    "has elements that are only parts of their reference shape, which their snippet tells (elvis_inside); "
                    "evaluate on the device");
    if (!volume.has_evaluation())
        throw Error(volume.path(),
                    "the plugin " + volume.plugin().id() + " cannot evaluate on the CPU; evaluate on the device");
    return std::make_unique<CpuEvaluator>(volume);
}

// Points that a thread takes at once: so many that those in one element are together.
constexpr std::uint64_t least_part = 4096;

// An element that contains a point.
struct Owner {
    std::int64_t number = 0;
    ReferencePoint point;
};

} // namespace

Prober::Prober(const RuntimeVolume& volume, const ProbeOptions& options)
    : m_volume(&volume), m_evaluator(make_evaluator(volume, options)), m_finder(volume),
      m_background(std::make_unique<Background>(std::max(1u, std::thread::hardware_concurrency()))) {
    m_numbers.resize(volume.n_elements());
    volume.element_numbers(0, volume.n_elements(), m_numbers);
}

std::vector<ProbedPoint> Prober::probe(std::span<const Vector3> positions, std::uint32_t time_step, const ProbeWishes& wishes) {
    if (time_step >= m_volume->times().size())
        throw UsageError(m_volume->path(), "there is no time step " + std::to_string(time_step) + "; the volume has " +
                                               std::to_string(m_volume->times().size()));
    std::vector<ProbedPoint> points(positions.size());
    const auto has_facts = [](const auto& expression) { return expression->needs_element_facts(); };
    const bool is_divided = m_evaluator->is_for_any_thread() && std::ranges::none_of(wishes.expressions, has_facts);
    const std::uint64_t n = positions.size(), n_threads = std::max(1u, std::thread::hardware_concurrency()),
                        part = is_divided ? std::max(least_part, n / (2 * n_threads) + 1) : n + 1;
    in_parts(*m_background, n, part, [&](std::uint64_t first, std::uint64_t count) {
        probe_part(positions.subspan(first, count), time_step, wishes, std::span(points).subspan(first, count));
    });
    return points;
}

void Prober::probe_part(std::span<const Vector3> positions, std::uint32_t time_step, const ProbeWishes& wishes,
                        std::span<ProbedPoint> points) const {
    std::vector<InversionQuery> queries;
    std::vector<std::size_t> query_point;
    std::vector<std::uint32_t> elements;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        points[i].position = positions[i];
        if (!std::ranges::all_of(positions[i], [](double x) { return std::isfinite(x); }))
            continue;
        elements.clear();
        m_finder.append_near(positions[i], elements);
        for (const std::uint32_t element : elements) {
            queries.push_back({element, positions[i]});
            query_point.push_back(i);
        }
    }

    const std::vector<Inversion> inversions = m_evaluator->invert(queries);
    std::vector<std::vector<Owner>> owners(positions.size());
    for (std::size_t i = 0; i < inversions.size(); ++i) {
        ProbedPoint& point = points[query_point[i]];
        point.n_failures += inversions[i].outcome == Inversion::Outcome::failed;
        if (inversions[i].outcome != Inversion::Outcome::inside)
            continue;
        owners[query_point[i]].push_back({m_numbers[queries[i].element], {queries[i].element, inversions[i].xi}});
    }

    std::vector<ReferencePoint> found;
    std::vector<std::size_t> found_point;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (owners[i].empty())
            continue;
        std::ranges::sort(owners[i], {}, &Owner::number);
        points[i].element = owners[i].front().number;
        points[i].xi = owners[i].front().point.xi;
        for (std::size_t other = 1; other < owners[i].size(); ++other)
            points[i].also.push_back(owners[i][other].number);
        found.push_back(owners[i].front().point);
        found_point.push_back(i);
    }
    for (std::uint32_t field = 0; field < m_volume->fields().size(); ++field) {
        const bool is_wanted = !wishes.fields || (*wishes.fields)[field];
        std::vector<FieldSample> samples = is_wanted ? m_evaluator->evaluate(field, time_step, found, wishes.with_gradients)
                                                     : std::vector<FieldSample>(found.size());
        for (std::size_t i = 0; i < samples.size(); ++i)
            points[found_point[i]].fields.push_back(std::move(samples[i]));
    }
    for (const std::shared_ptr<const Expression>& expression : wishes.expressions) {
        const std::vector<ExpressionSample> samples =
            m_evaluator->evaluate(expression, time_step, found, wishes.with_gradients);
        for (std::size_t i = 0; i < samples.size(); ++i)
            points[found_point[i]].expressions.push_back(samples[i]);
    }
}

} // namespace elvis
