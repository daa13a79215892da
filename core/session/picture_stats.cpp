#include <core/session/picture_stats.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>

namespace elvis {

namespace {

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

} // namespace

PictureStats::PictureStats(const Device& device, Precision precision, const Frame& frame, const Renderer& renderer)
    : PictureStats(device, precision, frame) {
    m_times = renderer.times();
    m_memory = renderer.memory();
}

PictureStats::PictureStats(const Device& device, Precision precision, const Frame& frame)
    : m_device(device.summary().name), m_driver(device.summary().driver), m_precision(precision),
      m_render_milliseconds(frame.render_milliseconds), m_device_milliseconds(frame.device_milliseconds),
      m_submissions(frame.submissions), m_host_waits(frame.host_waits), m_counts(frame.counts),
      m_kernels(device.kernel_builds()) {}

std::string PictureStats::json() const {
    nlohmann::ordered_json root;
    root["device"] = m_device;
    root["driver"] = m_driver;
    root["precision"] = name_of(m_precision);
    root["milliseconds"] = {{"upload", m_times.upload_milliseconds},     {"hierarchy", m_times.hierarchy_milliseconds},
                            {"overlaps", m_times.overlaps_milliseconds}, {"compile", m_times.compile_milliseconds},
                            {"render", m_render_milliseconds},           {"device", m_device_milliseconds}};
    root["submissions"] = m_submissions;
    root["host_waits"] = m_host_waits;
    root["counts"] = counts_json(m_counts);
    root["bytes"] = {
        {"field", m_memory.field_bytes}, {"geometry", m_memory.geometry_bytes}, {"hierarchy", m_memory.hierarchy_bytes}};
    root["kernels"] = kernels_json(m_kernels);
    return root.dump(2);
}

} // namespace elvis
