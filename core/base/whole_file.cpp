#include <core/base/whole_file.hpp>

#include <core/base/error.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace elvis {

std::string read_whole_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file || std::filesystem::is_directory(path)) {
        throw Error(path, "cannot be read");
    }
    std::string content(std::istreambuf_iterator<char>(file), {});
    if (file.bad()) {
        throw Error(path, "cannot be read to its end");
    }
    return content;
}

} // namespace elvis
