#include <core/session/picture_stats.hpp>

#include <algorithm>
#include <functional>

namespace elvis {

nlohmann::ordered_json counts_json(const FrameCounts& counts) {
    return {{"pixels", counts.pixels},
            {"hit_pixels", counts.hit_pixels},
            {"field_evaluations", counts.field_evaluations},
            {"newton_iterations", counts.newton_iterations},
            {"newton_failures", counts.newton_failures},
            {"undecided_pixels", counts.undecided_pixels},
            {"overlapping_elements", counts.overlapping_elements},
            {"overlap_pixels", counts.overlap_pixels},
            {"nan_pixels", counts.nan_pixels},
            {"work_limit_pixels", counts.work_limit_pixels},
            {"estimated_pixels", counts.estimated_pixels},
            {"contour_pixels", counts.contour_pixels},
            {"undecided_contour_pixels", counts.undecided_contour_pixels},
            {"mesh_line_pixels", counts.mesh_line_pixels},
            {"undecided_mesh_line_pixels", counts.undecided_mesh_line_pixels},
            {"half_drawn_elements", counts.half_drawn_elements},
            {"refined_pixels", counts.refined_pixels},
            {"isosurface_pixels", counts.isosurface_pixels},
            {"undecided_isosurface_pixels", counts.undecided_isosurface_pixels},
            {"isosurface_crossings", counts.isosurface_crossings},
            {"projected_pixels", counts.projected_pixels},
            {"certified_segments", counts.certified_segments},
            {"fits", counts.fits},
            {"verified_fits", counts.verified_fits},
            {"undecided_fits", counts.undecided_fits},
            {"excluded_intervals", counts.excluded_intervals},
            {"undecided_intervals", counts.undecided_intervals},
            {"volume_pixels", counts.volume_pixels},
            {"inexact_volume_pixels", counts.inexact_volume_pixels},
            {"volume_segments", counts.volume_segments},
            {"empty_segments", counts.empty_segments},
            {"volume_steps", counts.volume_steps},
            {"volume_breakpoints", counts.volume_breakpoints},
            {"hidden_pixels", counts.hidden_pixels},
            {"spared_pixels", counts.spared_pixels}};
}

/** Those that took longest first. */
nlohmann::ordered_json kernels_json(std::vector<KernelBuild> builds) {
    const auto milliseconds = [](const KernelBuild& build) { return build.compiler_milliseconds + build.driver_milliseconds; };
    std::ranges::stable_sort(builds, std::greater{}, milliseconds);
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const KernelBuild& build : builds) {
        list.push_back({{"kernel", build.kernel},
                        {"compiler", build.compiler_milliseconds},
                        {"driver", build.driver_milliseconds},
                        {"bytes", build.code_bytes}});
    }
    return list;
}

nlohmann::ordered_json stats_json(const Device& device, Precision precision, const Frame& frame, const Renderer& renderer,
                                  double load, double total, const std::vector<double>& repeated) {
    nlohmann::ordered_json root;
    root["device"] = device.summary().name;
    root["driver"] = device.summary().driver;
    root["precision"] = name_of(precision);
    const RendererTimes& times = renderer.times();
    root["milliseconds"] = {{"load", load},
                            {"upload", times.upload_milliseconds},
                            {"hierarchy", times.hierarchy_milliseconds},
                            {"overlaps", times.overlaps_milliseconds},
                            {"compile", times.compile_milliseconds},
                            {"render", frame.render_milliseconds},
                            {"device", frame.device_milliseconds},
                            {"total", total}};
    root["submissions"] = frame.submissions;
    root["host_waits"] = frame.host_waits;
    root["counts"] = counts_json(frame.counts);
    const RendererMemory memory = renderer.memory();
    root["bytes"] = {{"field", memory.field_bytes}, {"geometry", memory.geometry_bytes}, {"hierarchy", memory.hierarchy_bytes}};
    root["kernels"] = kernels_json(device.kernel_builds());
    if (!repeated.empty()) {
        root["frame_milliseconds"] = repeated;
    }
    return root;
}

} // namespace elvis
