#include "open_volumes.hpp"

#include <filesystem>
#include <map>

namespace elvis_paraview {

namespace {

struct Known {
    std::weak_ptr<OpenVolume> volume;
    std::filesystem::file_time_type written;
};

} // namespace

std::shared_ptr<OpenVolume> open_volume(const std::vector<std::string>& files) {
    static std::map<std::vector<std::string>, Known> all;
    std::error_code no_time;
    const std::filesystem::file_time_type written = std::filesystem::last_write_time(files.at(0), no_time);
    Known& known = all[files];
    std::shared_ptr<OpenVolume> volume = known.volume.lock();
    if (volume && known.written == written) {
        return volume;
    }
    // The context of a volume that is open, so that all share a device.
    std::shared_ptr<OpenVolume> other = volume;
    for (auto next = all.begin(); !other && next != all.end(); ++next) {
        other = next->second.volume.lock();
    }
    const elvis::context context = other ? other->context : elvis::context();
    volume = std::make_shared<OpenVolume>(OpenVolume{context, context.open(files)});
    known = {volume, written};
    return volume;
}

} // namespace elvis_paraview
