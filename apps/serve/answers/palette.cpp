#include "palette.hpp"

namespace elvis::serve {

nlohmann::json palette_of(const Served& served, nlohmann::json map) {
    for (const char* const key : {"range", "scale", "below", "above", "nan"}) {
        map.erase(key);
    }
    const Scene scene{{"version", 1}, {"color_map", map}};
    return nlohmann::json::parse(served.library_scene(scene).transfer({0, 1}, 1))["color"];
}

} // namespace elvis::serve
