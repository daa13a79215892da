#include <core/base/temporary_folder.hpp>

#include <core/base/error.hpp>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>

namespace elvis {

TemporaryFolder::TemporaryFolder(const std::filesystem::path& prefix) {
    std::string name = prefix.string() + "XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) {
        throw Error(name, "cannot be written: " + std::string(std::strerror(errno)));
    }
    m_path = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
}

std::string TemporaryFolder::write(const std::string& name, const std::string& content) const {
    const std::string file = path(name);
    std::filesystem::create_directories((m_path / name).parent_path());
    std::ofstream stream(file, std::ios::binary);
    if (!(stream << content).flush()) {
        throw Error(file, "cannot be written");
    }
    return file;
}

} // namespace elvis
