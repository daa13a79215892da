#include <core/session/volume/joined.hpp>

#include <core/base/error.hpp>

#include <stdexcept>
#include <utility>

namespace elvis {

std::shared_ptr<const native::VolumeSource> joined_source(std::shared_ptr<const native::VolumeSource> source,
                                                          std::vector<native::Joined> others, const std::string& name) {
    try {
        return std::make_shared<const native::JoinedVolume>(std::move(source), std::move(others));
    } catch (const native::FileError& failure) {
        throw Error(failure.what());
    } catch (const std::invalid_argument& reason) {
        throw Error(name, std::string("no fields can be joined: ") + reason.what());
    }
}

void refuse_joined(const std::string& path) {
    throw Error(path, "only native volumes, and what is converted to them, can be joined (joined)");
}

} // namespace elvis
