#include <core/session/missed_surfaces.hpp>

#include <core/session/surface_names.hpp>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace elvis {

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
        const bool is_isosurface = traits_of(request.surfaces[i].geometry).isosurfaces != nullptr;
        const bool may_be_met = is_open || (is_isosurface && counts.undecided_isosurface_pixels > 0);
        m_is_met[i] = m_is_met[i] || frame.is_met[i] || may_be_met;
    }
    if (std::ranges::find(m_time_steps, request.time_step) == m_time_steps.end()) {
        m_time_steps.push_back(request.time_step);
    }
}

MissedSurfaces::Range MissedSurfaces::values_of(const FieldChoice& field, PictureRanges& ranges) const {
    Range all{ranges.extrema(field, m_time_steps.front()).range(), true};
    for (const std::uint32_t step : m_time_steps) {
        const FieldExtrema extrema = ranges.extrema(field, step);
        all.range = {std::min(all.range.lower, extrema.range().lower), std::max(all.range.upper, extrema.range().upper)};
        all.is_certified = all.is_certified && extrema.certainty == ELVIS_CERTIFIED;
    }
    return all;
}

MissedSurfaces::Range MissedSurfaces::enclosure_of(const FieldChoice& field, PictureRanges& ranges) const {
    Range all{ranges.range(field, m_time_steps.front()), true};
    for (const std::uint32_t step : m_time_steps) {
        elvis_certainty certainty{};
        const FieldRange range = ranges.range(field, step, &certainty);
        all.range = {std::min(all.range.lower, range.lower), std::max(all.range.upper, range.upper)};
        all.is_certified = all.is_certified && certainty == ELVIS_CERTIFIED;
    }
    return all;
}

/** Of several values one may hide another: where any is met, only those that the field surely does not take are missed. */
std::string MissedSurfaces::isosurface_remark(const SceneSurface& surface, const std::string& field, const Surface& drawn,
                                              bool is_met, PictureRanges& ranges) const {
    const Isosurfaces& isosurfaces = *traits_of(drawn.geometry).isosurfaces;
    if (is_met && (isosurfaces.values.size() == 1 || isosurfaces.field.expression)) {
        return {};
    }
    const auto [enclosure, is_certified] = enclosure_of(isosurfaces.field, ranges);
    std::string list;
    std::size_t n_missed = 0;
    for (const double value : isosurfaces.values) {
        if (!is_met || (is_certified && (value < enclosure.lower || value > enclosure.upper))) {
            list += (n_missed > 0 ? ", " : "") + text_of(value);
            ++n_missed;
        }
    }
    const Range values = values_of(isosurfaces.field, ranges);
    const char* const hits = n_missed > 1 ? " hit no pixel" : " hits no pixel";
    return n_missed == 0 ? std::string()
                         : "the " + surface_name(surface) + (n_missed > 1 ? "s at " : " at ") + list +
                               (field.empty() ? "" : " of '" + field + "'") + hits + ": the field's values lie " +
                               (values.is_certified ? "in [" : "about in [") + text_of(values.range.lower) + ", " +
                               text_of(values.range.upper) + "]";
}

std::vector<std::string> MissedSurfaces::remarks(const Scene& scene, const FrameRequest& request, PictureRanges& ranges) const {
    std::vector<std::string> remarks;
    const std::vector<const SceneSurface*> shown = shown_surfaces(scene);
    for (std::size_t i = 0; i < m_is_met.size(); ++i) {
        // What the scene does not have is shown by default.
        const SceneSurface fallback{request.surfaces[i].geometry};
        const SceneSurface& surface = i < shown.size() ? *shown[i] : fallback;
        if (traits_of(surface.geometry).isosurfaces != nullptr) {
            const std::string field = surface.field.value_or(scene.field.value_or(""));
            std::string remark = isosurface_remark(surface, field, request.surfaces[i], m_is_met[i], ranges);
            if (!remark.empty()) {
                remarks.push_back(std::move(remark));
            }
        } else if (!m_is_met[i]) {
            const std::string name = i < shown.size() ? unique_name(scene, surface) : surface_name(surface);
            const bool is_cut = !surface.clip.empty() || scene.threshold.has_value();
            remarks.push_back("the " + name + " hits no pixel" + (is_cut ? ", or all that does is clipped" : ""));
        }
    }
    if (m_volume_is_missed) {
        remarks.emplace_back("volume rendering colours no pixel: there is no density where the picture sees the volume");
    }
    return remarks;
}

} // namespace elvis
