#include "bench_suites.hpp"

#include <core/accuracy/isosurface_study.hpp>
#include <core/base/error.hpp>

namespace elvis::commands {

namespace {

nlohmann::ordered_json to_json(const oracle::IsosurfaceComparison& comparison, Precision precision) {
    return {{"precision", name_of(precision)},
            {"is_good", oracle::holds(comparison, precision)},
            {"pixels", comparison.n_pixels},
            {"with_a_crossing", comparison.n_hits},
            {"agree", comparison.n_agree},
            {"differ_within_rounding", comparison.n_rounding},
            {"differ_and_flagged", comparison.n_wrong_flagged},
            {"differ_and_graze", comparison.n_wrong_grazing},
            {"wrong", comparison.n_wrong},
            {"flagged", comparison.n_flagged},
            {"flagged_and_agree", comparison.n_needless_flags},
            {"wrong_masks", comparison.n_wrong_masks},
            {"other_element", comparison.n_other_element},
            {"depth_error", comparison.depth_error},
            {"normal_error", comparison.normal_error},
            {"grazing_distance", comparison.grazing_distance},
            {"residual", comparison.residual}};
}

} // namespace

nlohmann::ordered_json run_accuracy(const BenchArguments& arguments, bool& is_good) {
    const BenchArguments::Accuracy& wanted = arguments.accuracy;
    oracle::IsosurfaceStudyOptions options;
    options.seed = wanted.seed;
    options.count = wanted.count;
    options.size = wanted.size;
    options.finder_stride = wanted.finder_stride;
    options.device = arguments.device;
    options.method = wanted.method == "interval"    ? IsosurfaceMethod::interval
                     : wanted.method == "bernstein" ? IsosurfaceMethod::bernstein
                                                    : IsosurfaceMethod::companion;
    options.precisions = wanted.precisions;
    nlohmann::ordered_json remarks = nlohmann::ordered_json::array(), list = remarks;
    const oracle::IsosurfaceStudy study = oracle::study_isosurfaces(PluginRegistry(), options, [&](const std::string& line) {
        remarks.push_back(line);
        say(arguments, "%s\n", line.c_str());
    });
    is_good = study.is_good(options.precisions);
    for (std::size_t i = 0; i < options.precisions.size(); ++i) {
        const oracle::IsosurfaceComparison& comparison = study.comparisons[i];
        list.push_back(to_json(comparison, options.precisions[i]));
        say(arguments, "%s, %llu fields: %s\n%s\n", name_of(options.precisions[i]),
            static_cast<unsigned long long>(study.n_fields),
            oracle::holds(comparison, options.precisions[i]) ? "good" : "WRONG", oracle::to_text(comparison).c_str());
    }
    const oracle::FinderComparison& finders = study.finders;
    say(arguments,
        "%llu pixels drawn by projection, %llu evaluations; the exact renderer: %llu failures\n"
        "its ways to find roots, on %zu rays, %zu of them with a crossing:\n"
        "  series and samples differ              %zu\n"
        "  series and companion matrix differ     %zu\n"
        "  apart by                               %.3g and %.3g of the range\n",
        static_cast<unsigned long long>(study.n_projected_pixels), static_cast<unsigned long long>(study.n_evaluations),
        static_cast<unsigned long long>(study.n_oracle_failures), finders.n_rays, finders.n_hits, finders.n_samples_differ,
        finders.n_companion_differ, finders.samples_error, finders.companion_error);
    return {{"is_good", is_good},
            {"fields", study.n_fields},
            {"size", options.size},
            {"precisions", list},
            {"remarks", remarks},
            {"projected_pixels", study.n_projected_pixels},
            {"field_evaluations", study.n_evaluations},
            {"oracle",
             {{"failures", study.n_oracle_failures},
              {"rays", finders.n_rays},
              {"hits", finders.n_hits},
              {"samples_differ", finders.n_samples_differ},
              {"companion_differ", finders.n_companion_differ},
              {"samples_error", finders.samples_error},
              {"companion_error", finders.companion_error}}}};
}

} // namespace elvis::commands
