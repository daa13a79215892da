#include "drawing.hpp"

#include <core/session/volumes_together.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace elvis::library {

namespace {

/** The data of the scene's further volume; kept with those that the picture was asked of. */
std::shared_ptr<Data> data_beside(const std::shared_ptr<Data>& data, const SceneVolume& wanted, const elvis_task* task) {
    if (wanted.path.empty()) {
        return data;
    }
    std::vector<std::string> files{wanted.path};
    files.insert(files.end(), wanted.more_files.begin(), wanted.more_files.end());
    std::string key = wanted.plugin + '\n' + wanted.plugin_options;
    for (const std::string& file : files) {
        key += '\n' + file;
    }
    {
        const DataTask running(*data, nullptr);
        if (const auto known = data->beside.find(key); known != data->beside.end()) {
            return known->second;
        }
    }
    std::shared_ptr<Data> opened = open_data(data->context, files, wanted.plugin, wanted.plugin_options, task);
    const DataTask running(*data, nullptr);
    return data->beside.emplace(key, std::move(opened)).first->second;
}

/** Whose turn it is: the data are used by several volumes, if it is one file. */
class AllTasks {
public:
    AllTasks(const std::vector<std::shared_ptr<Data>>& all, const elvis_task* task) {
        std::vector<Data*> each;
        for (const std::shared_ptr<Data>& data : all) {
            if (std::ranges::find(each, data.get()) == each.end()) {
                each.push_back(data.get());
            }
        }
        for (Data* const data : each) {
            m_tasks.push_back(std::make_unique<DataTask>(*data, task));
        }
    }

private:
    std::vector<std::unique_ptr<DataTask>> m_tasks;
};

} // namespace

void need_one_volume(const Scene& scene, const char* what) {
    if (!scene.volumes.empty()) {
        throw Error(scene.volume, std::string(what) + " is of one volume; the scene has several ('volumes')");
    }
}

namespace {

struct DrawnTogether {
    /** The first volume's, displaced if it is shown so. */
    std::shared_ptr<Data> data;
    StillPicture still;
};

DrawnTogether drawn_together(const std::shared_ptr<Data>& data, const Scene& scene, const elvis_render_options& options,
                             const elvis_task* task) {
    need_drawable_together(scene);
    std::vector<std::shared_ptr<Data>> all;
    std::vector<VolumeInPicture> volumes;
    for (std::size_t number = 0; number <= scene.volumes.size(); ++number) {
        const Scene own = scene_of_volume(scene, number);
        const std::shared_ptr<Data> of_file = number == 0 ? data : data_beside(data, scene.volumes[number - 1], task);
        all.push_back(shown_data(of_file, own, task));
        volumes.push_back({scene_for(*all.back(), own), number == 0 ? Vector3{} : scene.volumes[number - 1].offset,
                           &all.back()->volume, nullptr});
    }
    const AllTasks running(all, task);
    const Precision precision = precision_of(scene);
    for (std::size_t number = 0; number < volumes.size(); ++number) {
        provide_glyphs(*all[number], volumes[number].scene);
        volumes[number].renderer = &all[number]->renderer(precision);
    }
    return {all.front(), draw_together(volumes, still_options(*all.front(), precision, options), all.front()->control.get())};
}

} // namespace

elvis_picture* draw_volumes(const std::shared_ptr<Data>& data, const Scene& scene, const elvis_render_options& options,
                            const elvis_task* task) {
    DrawnTogether drawn = drawn_together(data, scene, options, task);
    return new_picture(drawn.data, precision_of(scene), std::move(drawn.still));
}

elvis_picture* draw_volumes_for_screen(const std::shared_ptr<Data>& data, const Scene& scene, const ScreenOptions& options,
                                       const elvis_task* task) {
    elvis_render_options colors{};
    colors.flags = ELVIS_RENDER_COLOR_ONLY;
    DrawnTogether drawn = drawn_together(data, coarser(scene, options), colors, task);
    return new_picture(drawn.data, precision_of(scene), shown_on_screen(std::move(drawn.still), scene.size));
}

} // namespace elvis::library
