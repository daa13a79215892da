/**
 * @file served.hpp
 * What all sessions share: the library, the open volume, and the scene that each begins with.
 */
#pragma once

#include <apps/elvis/view/model/volume_facts.hpp>
#include <apps/serve/answers/histograms.hpp>
#include <apps/serve/session/scene_edit.hpp>

#include <core/base/temporary_folder.hpp>
#include <core/scene/scene.hpp>

#include <elvis/elvis.hpp>

#include <atomic>
#include <cstdint>
#include <string>

namespace elvis::serve {

struct Served {
    context library;
    data volume;
    view::VolumeFacts facts;
    Scene first;
    /** A file in the root folder, which need not be there: what pages get and send has paths as this file would. */
    std::string page_scene;
    ScenePaths paths;
    /** That the server may hold, in all sessions; 0: as many as there are. */
    std::uint64_t most_bytes = 0;
    TemporaryFolder pictures;
    mutable Histograms histograms;
    /** Sessions that draw or answer what somebody waits for: exact pictures of others make way. */
    mutable std::atomic<int> n_urgent = 0;

    Served(context library_, data volume_, view::VolumeFacts facts_, Scene first_, std::string page_scene_, ScenePaths paths_,
           std::uint64_t most_bytes_)
        : library(std::move(library_)), volume(std::move(volume_)), facts(std::move(facts_)), first(std::move(first_)),
          page_scene(std::move(page_scene_)), paths(std::move(paths_)), most_bytes(most_bytes_) {}
};

} // namespace elvis::serve
