#include "missed_surfaces.hpp"

#include "surface_names.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace elvis::commands {

namespace {

std::string text_of(double number) {
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", number);
    return text;
}

/** Those that are drawn, in the order of requests. */
std::vector<const SceneSurface*> shown_surfaces(const Scene& scene) {
    std::vector<const SceneSurface*> shown;
    for (const SceneSurface& surface : scene.surfaces) {
        if (surface.is_shown) {
            shown.push_back(&surface);
        }
    }
    return shown;
}

/** With its number in the scene, where another one is called the same. */
std::string unique_name(const Scene& scene, const SceneSurface& surface) {
    const std::string name = surface_name(surface);
    const auto n_namesakes =
        std::ranges::count_if(scene.surfaces, [&](const SceneSurface& other) { return surface_name(other) == name; });
    return n_namesakes > 1 ? name + " (surfaces[" + std::to_string(&surface - scene.surfaces.data()) + "])" : name;
}

} // namespace

void MissedSurfaces::add(const FrameRequest& request, const Frame& frame) {
    const bool is_first = m_time_steps.empty();
    const FrameCounts& counts = frame.counts;
    const bool is_open = counts.newton_failures > 0 || counts.work_limit_pixels > 0;
    const bool is_missed = request.volume && counts.volume_pixels == 0 && counts.inexact_volume_pixels == 0 && !is_open;
    m_volume_is_missed = is_missed && (is_first || m_volume_is_missed);
    m_is_met.resize(frame.is_met.size());
    for (std::size_t i = 0; i < m_is_met.size(); ++i) {
        const bool is_isosurface = std::holds_alternative<Isosurfaces>(request.surfaces[i].geometry);
        const bool may_be_met = is_open || (is_isosurface && counts.undecided_isosurface_pixels > 0);
        m_is_met[i] = m_is_met[i] || frame.is_met[i] || may_be_met;
    }
    if (std::ranges::find(m_time_steps, request.time_step) == m_time_steps.end()) {
        m_time_steps.push_back(request.time_step);
    }
}

FieldRange MissedSurfaces::over_steps(Range range_of, const FieldChoice& field, Renderer& renderer, bool& is_certified) const {
    elvis_certainty certainty{};
    FieldRange range = (renderer.*range_of)(field, m_time_steps.front(), &certainty);
    is_certified = certainty == ELVIS_CERTIFIED;
    for (const std::uint32_t step : m_time_steps) {
        const FieldRange at_step = (renderer.*range_of)(field, step, &certainty);
        range = {std::min(range.lower, at_step.lower), std::max(range.upper, at_step.upper)};
        is_certified = is_certified && certainty == ELVIS_CERTIFIED;
    }
    return range;
}

/** Of several values one may hide another: where any is met, only those that the field surely does not take are missed. */
std::string MissedSurfaces::isosurface_remark(const SceneSurface& surface, const std::string& field, const Surface& drawn,
                                              bool is_met, Renderer& renderer) const {
    const auto& isosurfaces = std::get<Isosurfaces>(drawn.geometry);
    if (is_met && (isosurfaces.values.size() == 1 || isosurfaces.field.expression)) {
        return {};
    }
    bool is_certified = false;
    const FieldRange enclosure = over_steps(&Renderer::field_range, isosurfaces.field, renderer, is_certified);
    std::string list;
    std::size_t n_missed = 0;
    for (const double value : isosurfaces.values) {
        if (!is_met || (is_certified && (value < enclosure.lower || value > enclosure.upper))) {
            list += (n_missed > 0 ? ", " : "") + text_of(value);
            ++n_missed;
        }
    }
    const FieldRange range = over_steps(&Renderer::field_values, isosurfaces.field, renderer, is_certified);
    const char* const hits = n_missed > 1 ? " hit no pixel" : " hits no pixel";
    return n_missed == 0
               ? std::string()
               : "the " + surface_name(surface) + (n_missed > 1 ? "s at " : " at ") + list +
                     (field.empty() ? "" : " of '" + field + "'") + hits + ": the field's values lie " +
                     (is_certified ? "in [" : "about in [") + text_of(range.lower) + ", " + text_of(range.upper) + "]";
}

std::vector<std::string> MissedSurfaces::remarks(const Scene& scene, const FrameRequest& request, Renderer& renderer) const {
    std::vector<std::string> remarks;
    const std::vector<const SceneSurface*> shown = shown_surfaces(scene);
    for (std::size_t i = 0; i < m_is_met.size(); ++i) {
        // What the scene does not have is shown by default.
        const SceneSurface fallback{request.surfaces[i].geometry};
        const SceneSurface& surface = i < shown.size() ? *shown[i] : fallback;
        if (std::holds_alternative<Isosurfaces>(surface.geometry)) {
            const std::string field = surface.field.value_or(scene.field.value_or(""));
            std::string remark = isosurface_remark(surface, field, request.surfaces[i], m_is_met[i], renderer);
            if (!remark.empty()) {
                remarks.push_back(std::move(remark));
            }
        } else if (!m_is_met[i]) {
            const std::string name = i < shown.size() ? unique_name(scene, surface) : surface_name(surface);
            remarks.push_back("the " + name + " hits no pixel" + (surface.clip.empty() ? "" : ", or all that does is clipped"));
        }
    }
    if (m_volume_is_missed) {
        remarks.emplace_back("volume rendering colours no pixel: there is no density where the picture sees the volume");
    }
    return remarks;
}

} // namespace elvis::commands
