#include <core/arrows/scene_places.hpp>

#include <core/arrows/shape_candidates.hpp>
#include <core/base/bounds.hpp>
#include <core/base/error.hpp>
#include <core/base/overloaded.hpp>
#include <core/scene/frame_request.hpp>
#include <core/scene/surface_distance.hpp>
#include <core/scene/write/write_parts.hpp>
#include <core/volume/boundary/element_faces.hpp>
#include <core/volume/element/element_selection.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <variant>

namespace elvis {

namespace {

/** An expression for the field of that text, whose name may be no word of the language. */
std::shared_ptr<const Expression> scalar_of(const std::string& text, const Scene& scene, const RuntimeVolume& volume) {
    const auto& fields = volume.fields();
    const bool is_name = std::ranges::any_of(fields, [&](const FieldInfo& info) { return info.name == text; });
    return std::make_shared<const Expression>(is_name ? "'" + text + "'" : with_distances(text, scene.surfaces), fields,
                                              volume.dimension());
}

/** Throws where the text of an implicit surface, in which x is the coordinate, would mean a field. */
const std::string& with_coordinates(const std::string& level, const CutShape& shape, const RuntimeVolume& volume,
                                    const PlacesUse& use) {
    const auto is_coordinate = [](const FieldInfo& info) { return info.name == "x" || info.name == "y" || info.name == "z"; };
    if (std::holds_alternative<ImplicitSurface>(shape) && std::ranges::any_of(volume.fields(), is_coordinate)) {
        throw Error(use.what,
                    "cannot " + use.verb + " on an implicit surface of a volume with a field that is named as a coordinate");
    }
    return level;
}

bool is_clipped(const SceneSurface& surface, const Vector3& position) {
    return std::ranges::any_of(surface.clip, [&](const std::array<double, 4>& plane) {
        return dot({plane[0], plane[1], plane[2]}, position) + plane[3] < 0;
    });
}

std::vector<ArrowSeed> places_on(const SceneSurface& under, const ArrowSeeds& seeds, const Scene& scene,
                                 const RuntimeVolume& volume, const std::array<double, 6>& bounds, const PlacesUse& use,
                                 const TaskControl& control) {
    const auto on_level = [&](const std::string& level, const std::vector<double>& values) {
        return seeds.on_levels(scalar_of(level, scene, volume), values, scene.time_step);
    };
    const auto refuse = [&]() -> std::vector<ArrowSeed> {
        throw Error(use.what,
                    "cannot " + use.verb + " on '" + under.name +
                        "': wireframes, tubes and other arrows can not be under them, nor ribbons that are not drawn");
    };
    return std::visit(
        Overloaded{
            [&](const CutPlane& plane) { return seeds.on_plane(plane, bounds); },
            [&](const BoundaryFaces& boundary) { return seeds.on_faces(boundary_faces(volume, boundary.groups, &control)); },
            [&](const ElementFaces&) {
                const auto chosen = std::get<ElementFaces>(complete_geometry(under, scene, volume));
                return seeds.on_faces(faces_of_elements(volume, chosen.selection, &control));
            },
            [&](const Isosurfaces& isosurfaces) {
                const std::string first = volume.fields().empty() ? "" : volume.fields()[0].name;
                return on_level(under.field.value_or(scene.field.value_or(first)), isosurfaces.values);
            },
            [&](const CutShape& shape) {
                const auto found = seeds.on_shape(shape);
                const std::optional<std::string> level = found ? std::nullopt : level_of(shape);
                return found ? *found : level ? on_level(with_coordinates(*level, shape, volume, use), {0}) : refuse();
            },
            [&](const FlatElements&) { return refuse(); }, [&](const WireFrame&) { return refuse(); }},
        under.geometry);
}

} // namespace

double spacing_of(const std::optional<double>& wanted, const std::array<double, 6>& bounds) {
    return wanted.value_or(0.05 * diagonal_of(bounds));
}

const SceneSurface* surface_under(const std::string& name, const Scene& scene, const PlacesUse& use) {
    if (name.empty()) {
        return nullptr;
    }
    const auto found = std::ranges::find_if(scene.surfaces, [&](const SceneSurface& surface) { return surface.name == name; });
    if (found == scene.surfaces.end()) {
        throw Error(use.what, "there is no surface named '" + name + "' on which they could " + use.verb);
    }
    return &*found;
}

std::string places_key(const SceneSurface* under, const Scene& scene) {
    // Files are named as seen from the working directory.
    return under == nullptr ? ""
                            : std::to_string(scene.time_step) + '\n' + scene.field.value_or("") + '\n' +
                                  surface_json(*under, "scene").dump();
}

std::vector<ArrowSeed> scene_places(const SceneSurface* under, double spacing, const Scene& scene, const RuntimeVolume& volume,
                                    const std::array<double, 6>& bounds, const PlacesUse& use, const TaskControl& control) {
    const ArrowSeeds seeds(volume, spacing, control);
    if (under == nullptr) {
        return seeds.in_volume(bounds);
    }
    std::vector<ArrowSeed> places = places_on(*under, seeds, scene, volume, bounds, use, control);
    std::erase_if(places, [&](const ArrowSeed& seed) { return is_clipped(*under, seed.position); });
    return places;
}

} // namespace elvis
