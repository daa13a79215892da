#include <core/session/volume/warped.hpp>

#include <core/base/error.hpp>
#include <core/base/nearest_word.hpp>
#include <core/plugin_host/plugin.hpp>

#include <elvis/native/serve.hpp>
#include <elvis/native/volume_file.hpp>
#include <elvis/native/warped_volume.hpp>
#include <elvis/plugin.hpp>

#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

namespace elvis {

namespace {

std::size_t field_named(const native::Description& description, const std::string& wanted, const std::string& volume) {
    std::vector<std::string> names;
    for (const native::Field& field : description.fields) {
        if (field.name == wanted) {
            return names.size();
        }
        names.push_back(field.name);
    }
    const std::string nearest = nearest_word(wanted, names);
    throw Error(volume, "the warp's field '" + wanted + "' is not there" +
                            (nearest.empty() ? std::string() : "; did you mean '" + nearest + "'?"));
}

} // namespace

std::shared_ptr<const native::VolumeSource> native_source(const std::string& path) {
    return std::make_shared<const native::Reader>(path);
}

RuntimeVolume serve_native(std::shared_ptr<const native::VolumeSource> source, const std::string& name,
                           const TaskControl* control, elvis_volume** served) {
    const auto serve = [&](const elvis_host* host) {
        elvis_volume* const volume = native::serve(host, name, std::move(source));
        if (served != nullptr) {
            *served = volume;
        }
        return volume;
    };
    return {Plugin::of_native(name), name, serve, control};
}

std::shared_ptr<const native::VolumeSource> warped_source(std::shared_ptr<const native::VolumeSource> source,
                                                          const SceneWarp& warp, std::uint32_t time_step,
                                                          const std::string& name) {
    const native::Description& description = source->description();
    native::Warp own;
    own.field = field_named(description, warp.field, name);
    if (warp.imaginary) {
        own.imaginary = field_named(description, *warp.imaginary, name);
    }
    own.time_step = time_step;
    own.factor = warp.factor;
    own.phase = warp.phase * std::numbers::pi / 180;
    try {
        return std::make_shared<const native::WarpedVolume>(std::move(source), own);
    } catch (const std::invalid_argument& reason) {
        throw Error(name, std::string("cannot be displaced: ") + reason.what());
    }
}

RuntimeVolume open_warped(std::shared_ptr<const native::VolumeSource> source, const SceneWarp& warp, std::uint32_t time_step,
                          const std::string& name, const TaskControl* control) {
    try {
        RuntimeVolume displaced = serve_native(warped_source(source, warp, time_step, name), name, control);
        displaced.set_undeformed([source = std::move(source), name, control] { return serve_native(source, name, control); });
        return displaced;
    } catch (const api::Error& failure) {
        throw Error(name, std::string("cannot be displaced: ") + failure.what());
    }
}

} // namespace elvis
