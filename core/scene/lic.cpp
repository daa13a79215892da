#include <core/scene/lic.hpp>

#include <core/base/error.hpp>
#include <core/expression/expression.hpp>
#include <core/scene/frame_request.hpp>
#include <core/scene/line_width.hpp>
#include <core/scene/surface_distance.hpp>

#include <algorithm>
#include <string>

namespace elvis {

namespace {

/** A length of curves, in grains, that shows directions well and takes no longer than it must. */
constexpr double default_length = 20;

/** As the language of expressions has it. */
std::string expression_of(const std::string& text, const Scene& scene, const RuntimeVolume& volume) {
    const bool is_name = std::ranges::any_of(volume.fields(), [&](const FieldInfo& field) { return field.name == text; });
    return is_name ? "'" + text + "'" : with_distances(text, scene.surfaces);
}

} // namespace

Lic lic_of(const SceneLic& own, const Scene& scene, const RuntimeVolume& volume) {
    const std::string text = expression_of(own.field, scene, volume);
    // Errors of the language tell their column in what was written.
    const Expression checked(text, volume.fields(), volume.dimension());
    const auto component = [&](int index) { return choose_field(volume, "(" + text + ")[" + std::to_string(index) + "]"); };
    const auto third = [&] {
        try {
            return component(2);
        } catch (const Error&) {
            if (volume.dimension() == 3) {
                throw;
            }
            return choose_field(volume, "0");
        }
    };
    Lic lic;
    try {
        lic.vectors = {component(0), component(1), third()};
    } catch (const Error&) {
        throw Error("lic", "follows a vector with " + std::string(volume.dimension() == 3 ? "three" : "two or three") +
                               " components, which '" + own.field + "' is not");
    }
    lic.grain = static_cast<std::uint32_t>(default_line_width(scene.size));
    lic.length = own.length.value_or(default_length * lic.grain);
    lic.contrast = own.contrast;
    return lic;
}

} // namespace elvis
