#include "first_scene.hpp"

namespace elvis::view {

Scene first_scene(const context& library, const data& volume, const std::vector<std::string>& files) {
    Scene scene = scene_of_files(files);
    scene["image"]["annotation"] = Json::object();
    if (volume.info().dimension == 3 && Json::parse(volume.describe_briefly())["n_faces"] > 0) {
        scene["lighting"] = Json::object();
    }
    Scene complete = Json::parse(library.parse_scene(scene.dump()).completed(volume).text());
    complete.erase("camera");
    return complete;
}

} // namespace elvis::view
