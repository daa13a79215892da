/**
 * @file served.hpp
 * What all sessions share: the library, the open volume, and the scene that each begins with.
 */
#pragma once

#include <apps/elvis/view/model/volume_facts.hpp>
#include <apps/elvis/view/scene/scene.hpp>
#include <apps/serve/answers/histograms.hpp>
#include <apps/serve/session/scene_edit.hpp>

#include <core/base/temporary_folder.hpp>

#include <elvis/elvis.hpp>

#include <atomic>
#include <cstdint>
#include <string>

namespace elvis::serve {

using view::Scene;

struct Served {
    context library;
    data volume;
    view::VolumeFacts facts;
    /** With all of its camera said. */
    Scene first;
    /** The camera is that of a file; else the volume fills the picture, whatever its size. */
    bool is_placed = false;
    /** From which scenes see other files; empty: the working directory. */
    std::string folder;
    ScenePaths paths;
    /** That the server may hold, in all sessions; 0: as many as there are. */
    std::uint64_t most_bytes = 0;
    /** The device's memory is not the machine's. */
    bool has_device_memory = false;
    TemporaryFolder pictures;
    mutable Histograms histograms;
    /** Sessions that draw or answer what somebody waits for: exact pictures of others make way. */
    mutable std::atomic<int> n_urgent = 0;

    Served(context library_, data volume_, view::VolumeFacts facts_, Scene first_, bool is_placed_, std::string folder_,
           ScenePaths paths_, std::uint64_t most_bytes_)
        : library(std::move(library_)), volume(std::move(volume_)), facts(std::move(facts_)), first(std::move(first_)),
          is_placed(is_placed_), folder(std::move(folder_)), paths(std::move(paths_)), most_bytes(most_bytes_),
          has_device_memory(nlohmann::json::parse(library.describe_device()).value("type", "") != "cpu") {}

    /** What the library calls a scene. */
    elvis::scene library_scene(const Scene& scene) const { return library.parse_scene(scene.dump(), folder); }
};

} // namespace elvis::serve
