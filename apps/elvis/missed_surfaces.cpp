#include "missed_surfaces.hpp"

#include "surface_names.hpp"

#include <algorithm>
#include <cstdio>
#include <functional>

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

/** Values that are missed; all if none of them is told by itself. */
std::vector<double> missed_values(const Isosurfaces& isosurfaces, const SurfaceHits& hits) {
    if (!hits.is_met || hits.values.size() != isosurfaces.values.size()) {
        return hits.is_met ? std::vector<double>{} : isosurfaces.values;
    }
    std::vector<double> missed;
    for (std::size_t i = 0; i < hits.values.size(); ++i) {
        if (!hits.values[i]) {
            missed.push_back(isosurfaces.values[i]);
        }
    }
    return missed;
}

} // namespace

void MissedSurfaces::add(const FrameRequest& request, const Frame& frame) {
    const bool is_first = m_time_steps.empty();
    const FrameCounts& counts = frame.counts;
    const bool is_open = counts.newton_failures > 0 || counts.work_limit_pixels > 0;
    const bool is_missed = request.volume && counts.volume_pixels == 0 && counts.inexact_volume_pixels == 0 && !is_open;
    m_volume_is_missed = is_missed && (is_first || m_volume_is_missed);
    m_hits.resize(frame.hits.size());
    for (std::size_t i = 0; i < m_hits.size(); ++i) {
        const bool is_isosurface = std::holds_alternative<Isosurfaces>(request.surfaces[i].geometry);
        if (is_open || (is_isosurface && counts.undecided_isosurface_pixels > 0)) {
            m_hits[i].is_met = true;
            m_hits[i].values.assign(frame.hits[i].values.size(), true);
            continue;
        }
        m_hits[i].is_met = m_hits[i].is_met || frame.hits[i].is_met;
        const std::vector<bool>& now = frame.hits[i].values;
        std::vector<bool>& met = m_hits[i].values;
        met.resize(now.size());
        std::transform(met.begin(), met.end(), now.begin(), met.begin(), std::logical_or<>());
    }
    if (std::ranges::find(m_time_steps, request.time_step) == m_time_steps.end()) {
        m_time_steps.push_back(request.time_step);
    }
}

std::string MissedSurfaces::isosurface_remark(const SceneSurface& surface, const std::string& field, const Surface& drawn,
                                              const std::vector<double>& values, Renderer& renderer) const {
    std::string list;
    for (const double value : values) {
        list += (list.empty() ? "" : ", ") + text_of(value);
    }
    const FieldChoice& choice = std::get<Isosurfaces>(drawn.geometry).field;
    elvis_certainty certainty{};
    FieldRange range = renderer.field_values(choice, m_time_steps.front(), &certainty);
    bool is_certified = certainty == ELVIS_CERTIFIED;
    for (const std::uint32_t step : m_time_steps) {
        const FieldRange at_step = renderer.field_values(choice, step, &certainty);
        range = {std::min(range.lower, at_step.lower), std::max(range.upper, at_step.upper)};
        is_certified = is_certified && certainty == ELVIS_CERTIFIED;
    }
    const bool is_several = values.size() > 1;
    return std::string("the ") + surface_name(surface) + (is_several ? "s at " : " at ") + list +
           (field.empty() ? "" : " of '" + field + "'") + (is_several ? " hit" : " hits") +
           " no pixel: the field's values lie " + (is_certified ? "in [" : "about in [") + text_of(range.lower) + ", " +
           text_of(range.upper) + "]";
}

std::vector<std::string> MissedSurfaces::remarks(const Scene& scene, const FrameRequest& request, Renderer& renderer) const {
    std::vector<std::string> remarks;
    const std::vector<const SceneSurface*> shown = shown_surfaces(scene);
    for (std::size_t i = 0; i < m_hits.size(); ++i) {
        // What the scene does not have is shown by default.
        const SceneSurface fallback{request.surfaces[i].geometry};
        const SceneSurface& surface = i < shown.size() ? *shown[i] : fallback;
        if (const auto* isosurfaces = std::get_if<Isosurfaces>(&surface.geometry)) {
            if (const std::vector<double> values = missed_values(*isosurfaces, m_hits[i]); !values.empty()) {
                const std::string field = surface.field.value_or(scene.field.value_or(""));
                remarks.push_back(isosurface_remark(surface, field, request.surfaces[i], values, renderer));
            }
        } else if (!m_hits[i].is_met) {
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
