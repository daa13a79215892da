#include <core/arrows/scene_arrows.hpp>

#include <core/arrows/scene_places.hpp>
#include <core/base/counted.hpp>
#include <core/base/error.hpp>
#include <core/base/log.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/probe/cpu_evaluator.hpp>
#include <core/render/field/chosen_values.hpp>
#include <core/scene/frame_request.hpp>
#include <core/scene/surface_distance.hpp>
#include <core/scene/threshold.hpp>
#include <core/scene/write/write_parts.hpp>
#include <core/streamline/flow.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace elvis {

namespace {

/** More are in no picture. */
constexpr std::size_t most_known = 32;
const PlacesUse of_arrows{"arrows", "stand"};

/** All that glyphs rest on. */
std::string key_of(const SceneSurface& own, const SceneSurface* under, const Scene& scene) {
    // Files are named as seen from the working directory.
    return std::to_string(scene.time_step) + '\n' + scene.field.value_or("") + '\n' + scene.threshold.value_or("") + '\n' +
           surface_json(own, "scene").dump() + '\n' + places_key(under, scene);
}

class ArrowMaker {
public:
    ArrowMaker(const Scene& scene, const RuntimeVolume& volume, const std::array<double, 6>& bounds, const TaskControl& control)
        : m_scene(scene), m_volume(volume), m_bounds(bounds), m_control(control), m_evaluator(volume) {}

    std::shared_ptr<const ArrowSet> make(const SceneSurface& own, const SceneSurface* under) {
        const SceneArrows& wanted = *own.arrows;
        const double spacing = spacing_of(wanted.spacing, m_bounds);
        std::vector<ArrowSeed> seeds = scene_places(under, spacing, m_scene, m_volume, m_bounds, of_arrows, m_control);
        const std::size_t n_all = seeds.size();
        keep_shown(seeds);
        std::vector<Vector3> vectors = vectors_at(wanted.vectors, seeds);
        double largest = 0;
        for (const Vector3& vector : vectors) {
            largest = std::isfinite(length(vector)) ? std::max(largest, length(vector)) : largest;
        }
        const double scale = wanted.scale.value_or(largest > 0 ? spacing / largest : 1);
        auto set = std::make_shared<ArrowSet>();
        const std::vector<double> values = values_at(own.field ? own.field : m_scene.field, seeds);
        for (std::size_t i = 0; i < seeds.size(); ++i) {
            const Vector3 along = scaled(vectors[i], scale), to = plus(seeds[i].position, along);
            if (std::isfinite(length(along)) && to != seeds[i].position) {
                std::int64_t number = 0;
                m_volume.element_numbers(seeds[i].place.element, 1, std::span(&number, 1));
                set->arrows.push_back({seeds[i].position, to, values[i], static_cast<std::uint32_t>(number)});
            }
        }
        log_line(LogLevel::info, "arrows of {}: {} of {} places; {} stand for a vector of length 1", wanted.vectors,
                 counted(set->arrows.size(), "arrow"), n_all, scale);
        return set;
    }

private:
    /** Those that are not out of the scene's threshold. */
    void keep_shown(std::vector<ArrowSeed>& seeds) {
        if (!m_scene.threshold) {
            return;
        }
        for (const Condition& condition : threshold_conditions(*m_scene.threshold, m_scene, m_volume)) {
            const std::vector<double> values = values_of(condition.field, seeds);
            std::vector<ArrowSeed> kept;
            for (std::size_t i = 0; i < seeds.size(); ++i) {
                const double margin = (condition.is_above ? 1 : -1) * (values[i] - condition.value);
                if (margin > 0 || (condition.takes_equal && margin == 0)) {
                    kept.push_back(seeds[i]);
                }
            }
            seeds = std::move(kept);
        }
    }

    std::vector<Vector3> vectors_at(const std::string& text, const std::vector<ArrowSeed>& seeds) const {
        const Flow flow(m_volume, text, m_scene.time_step);
        std::vector<Vector3> vectors;
        for (const ArrowSeed& seed : seeds) {
            m_control.check();
            vectors.push_back(flow.at(seed.place, 0).velocity);
        }
        return vectors;
    }

    std::vector<double> values_at(const std::optional<std::string>& field, const std::vector<ArrowSeed>& seeds) {
        return values_of(choose_field(m_volume, field ? std::optional(with_distances(*field, m_scene.surfaces)) : field),
                         seeds);
    }

    std::vector<double> values_of(const FieldChoice& field, const std::vector<ArrowSeed>& seeds) {
        std::vector<ReferencePoint> places;
        std::ranges::transform(seeds, std::back_inserter(places), &ArrowSeed::place);
        return chosen_values(m_evaluator, field, m_scene.time_step, places);
    }

    const Scene& m_scene;
    const RuntimeVolume& m_volume;
    const std::array<double, 6>& m_bounds;
    const TaskControl& m_control;
    CpuEvaluator m_evaluator;
};

void need_points(const RuntimeVolume& volume) {
    if (!volume.has_evaluation() || volume.is_cut()) {
        throw Error(volume.path(), "the plugin " + volume.plugin().id() +
                                       " does not evaluate whole elements on the CPU, in which arrows are placed");
    }
}

} // namespace

void SceneArrowSets::provide(Scene& scene, const RuntimeVolume& volume, const std::array<double, 6>& bounds,
                             const TaskControl& control) {
    for (SceneSurface& surface : scene.surfaces) {
        if (!surface.arrows || !surface.is_shown) {
            continue;
        }
        const SceneSurface* const under = surface_under(surface.arrows->on, scene, of_arrows);
        const std::string key = key_of(surface, under, scene);
        auto known = m_known.find(key);
        if (known == m_known.end()) {
            need_points(volume);
            if (m_known.size() >= most_known) {
                m_known.clear();
            }
            known = m_known.emplace(key, ArrowMaker(scene, volume, bounds, control).make(surface, under)).first;
        }
        surface.geometry = ArrowSurface{known->second};
        surface.is_shown = !known->second->arrows.empty();
    }
}

} // namespace elvis
