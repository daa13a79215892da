#include "isosurface_study.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace elvis::oracle {
namespace {

FinderComparison compare_finders_on(const RandomVolume& random, const IsosurfaceStudyOptions& options) {
    const Model model(random.data);
    const Isosurface isosurface{scalar_of_field(model.volume, 0), random.values, random.clip};
    return compare_finders(model, isosurface, random.camera, options.size, options.size, options.finder_stride);
}

} // namespace

bool holds(const IsosurfaceComparison& comparison, Precision precision) {
    return comparison.n_wrong + comparison.n_wrong_masks + comparison.n_other_element == 0 &&
           (precision == Precision::float32 || comparison.n_wrong_grazing == 0);
}

bool IsosurfaceStudy::is_good(const std::vector<Precision>& precisions) const {
    bool is_held = n_oracle_failures == 0 && finders.n_samples_differ + finders.n_companion_differ == 0;
    for (std::size_t i = 0; i < precisions.size(); ++i)
        is_held = is_held && holds(comparisons[i], precisions[i]);
    return is_held;
}

IsosurfaceStudy study_isosurfaces(const PluginRegistry& registry, const IsosurfaceStudyOptions& options,
                                  const std::function<void(const std::string&)>& report) {
    IsosurfaceStudy study;
    study.comparisons.resize(options.precisions.size());
    std::atomic<std::uint64_t> next = options.seed;
    std::mutex mutex;
    std::exception_ptr error;
    const auto add = [&](std::uint64_t seed, const RandomVolume& random, const RandomAccuracy& one,
                         const FinderComparison& ways) {
        const std::lock_guard lock(mutex);
        const std::string place = "seed " + std::to_string(seed) + ", ";
        for (std::size_t i = 0; i < options.precisions.size(); ++i) {
            const IsosurfaceComparison& c = one.comparisons[i];
            if (!holds(c, options.precisions[i]))
                report(place + name_of(options.precisions[i]) + ": " + random.description + ": " + std::to_string(c.n_wrong) +
                       " wrong, " + std::to_string(c.n_wrong_grazing) + " grazing, " + std::to_string(c.n_wrong_masks) +
                       " masks, " + std::to_string(c.n_other_element) + " other elements; pixel " +
                       std::to_string(c.worst_pixel));
            study.comparisons[i] += c;
            study.n_projected_pixels += one.counts[i].projected_pixels;
            study.n_evaluations += one.counts[i].field_evaluations;
        }
        if (one.oracle_failures != 0)
            report(place + std::to_string(one.oracle_failures) + " failures of the oracle: " + random.description);
        if (ways.n_samples_differ + ways.n_companion_differ != 0)
            report(place + "the oracle's ways differ: " + random.description);
        study.finders += ways;
        study.n_oracle_failures += one.oracle_failures;
        ++study.n_fields;
    };
    {
        // Most of the time of a small picture goes to the driver's compiler, which has one thread: hence a field a thread.
        std::vector<std::jthread> threads;
        for (unsigned thread = 0; thread < std::max(1u, std::thread::hardware_concurrency()); ++thread)
            threads.emplace_back([&] {
                try {
                    // Of its own, so that threads do not wait for each other's submissions.
                    const Device device(options.device);
                    for (std::uint64_t seed = next++; seed < options.seed + options.count; seed = next++) {
                        const RandomVolume random = random_volume(seed);
                        const RandomAccuracy one =
                            measure_random(device, registry, random, options.size, options.precisions, options.method);
                        add(seed, random, one,
                            options.finder_stride > 0 ? compare_finders_on(random, options) : FinderComparison{});
                    }
                } catch (...) {
                    const std::lock_guard lock(mutex);
                    error = std::current_exception();
                    next = options.seed + options.count;
                }
            });
    }
    if (error)
        std::rethrow_exception(error);
    return study;
}

} // namespace elvis::oracle
