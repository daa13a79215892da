#include "drawing.hpp"

#include <core/scene/read/json_reader.hpp>
#include <core/scene/write/write_scene.hpp>
#include <core/session/complete_scene.hpp>

#include <filesystem>

namespace elvis::library {

namespace {

using Json = nlohmann::json;

/** The file that a scene without one is named by in messages; paths are seen from the working directory. */
constexpr const char* no_file = "scene";

elvis_scene* new_scene(const std::shared_ptr<Context>& context, Json document, const std::string& file) {
    Scene scene = scene_of(document, file);
    return new elvis_scene{{context, std::move(document), file, std::move(scene)}};
}

Json parsed(const std::string& text, const std::string& what) {
    try {
        return Json::parse(text);
    } catch (const Json::parse_error& error) {
        throw InvalidArgument(what, std::string("is no JSON: ") + error.what());
    }
}

Json::json_pointer parsed_pointer(const std::string& text) {
    try {
        return Json::json_pointer(text);
    } catch (const Json::exception&) {
        throw InvalidArgument("'" + text + "'", "is no JSON Pointer, such as /camera/eye or /surfaces/0");
    }
}

/** The document with one value set, or removed where there is none. */
Json changed(Json document, const std::string& where, elvis_string value) {
    const Json::json_pointer pointer = parsed_pointer(where);
    try {
        if (value == nullptr) {
            if (!document.contains(pointer) || pointer.empty()) {
                throw InvalidArgument("'" + where + "'", "there is nothing to remove");
            }
            document.at(pointer.parent_pointer()).is_array()
                ? document.at(pointer.parent_pointer()).erase(std::stoul(pointer.back()))
                : static_cast<void>(document.at(pointer.parent_pointer()).erase(pointer.back()));
        } else {
            Json& place = document[pointer];
            place = parsed(value, "the value for '" + where + "'");
        }
    } catch (const Json::exception&) {
        throw InvalidArgument("'" + where + "'", "there is no such place in the scene");
    }
    return document;
}

} // namespace

} // namespace elvis::library

using namespace elvis;
using namespace elvis::library;

elvis_result elvis_scene_create(elvis_context* context, elvis_scene** scene) {
    return call(context, [&] {
        need(scene, "scene");
        *scene = nullptr;
        *scene = new_scene(context->state, {{"version", 1}}, no_file);
    });
}

elvis_result elvis_scene_read(elvis_context* context, elvis_string path, elvis_scene** scene) {
    return call(context, [&] {
        need(scene, "scene");
        *scene = nullptr;
        need(path, "path");
        *scene = new_scene(context->state, parse_json_file(path), path);
    });
}

elvis_result elvis_scene_parse(elvis_context* context, elvis_string text, elvis_string folder, elvis_scene** scene) {
    return call(context, [&] {
        need(scene, "scene");
        *scene = nullptr;
        need(text, "text");
        const std::filesystem::path file = std::filesystem::path(text_or_empty(folder)) / no_file;
        *scene = new_scene(context->state, parsed(text, "the scene"), file.string());
    });
}

elvis_result elvis_scene_copy(const elvis_scene* scene, elvis_scene** copy) {
    return call(scene, [&] {
        need(copy, "copy");
        *copy = nullptr;
        *copy = new elvis_scene(*scene);
    });
}

elvis_result elvis_scene_complete(const elvis_scene* scene, elvis_data* data, elvis_scene** complete) {
    return call(scene, [&] {
        need(complete, "complete");
        *complete = nullptr;
        need(data, "data");
        const Scene& own = scene->state.scene;
        const std::shared_ptr<Data> shown = shown_data(data->state, own, nullptr);
        Data& state = *shown;
        const DataTask running(state, nullptr);
        Scene said = complete_scene(scene_for(state, own), state.volume, state.renderer(precision_of(own)).ranges());
        said.volume = own.volume;
        const std::string& file = scene->state.file;
        *complete = new elvis_scene{{scene->state.context, Json::parse(scene_json(said, file).dump()), file, said}};
    });
}

void elvis_scene_release(elvis_scene* scene) { delete scene; }

elvis_result elvis_scene_set(elvis_scene* scene, elvis_string pointer, elvis_string value) {
    return call(scene, [&] {
        need(pointer, "pointer");
        Json document = changed(scene->state.document, pointer, value);
        scene->state.scene = scene_of(document, scene->state.file);
        scene->state.document = std::move(document);
    });
}

elvis_result elvis_scene_get(const elvis_scene* scene, elvis_string pointer, char** text) {
    return call(scene, [&] {
        need(pointer, "pointer");
        need(text, "text");
        const Json::json_pointer place = parsed_pointer(pointer);
        if (!scene->state.document.contains(place)) {
            throw InvalidArgument("'" + std::string(pointer) + "'", "the scene does not say it");
        }
        *text = text_for_caller(scene->state.document.at(place).dump());
    });
}

elvis_result elvis_scene_write(const elvis_scene* scene, elvis_string path) {
    return call(scene, [&] {
        need(path, "path");
        write_scene(scene->state.scene, path);
    });
}

elvis_result elvis_scene_get_volume(const elvis_scene* scene, char** path) {
    return call(scene, [&] {
        need(path, "path");
        *path = text_for_caller(scene->state.scene.volume);
    });
}

elvis_string elvis_scene_schema(void) { return scene_schema_text().data(); }
