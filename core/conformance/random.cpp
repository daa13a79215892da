#include <core/conformance/scratch.hpp>

#include <core/base/error.hpp>

#include <unistd.h>

#include <fstream>
#include <sstream>

namespace elvis::conformance {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "elvis-check-XXXXXX").string();
    if (!::mkdtemp(name.data())) {
        throw Error(name, "cannot be made: checks need a temporary folder");
    }
    m_folder = name;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(m_folder, ignored);
}

std::string ScratchFolder::write(const std::string& name, const std::string& content) const {
    const std::string file = path(name);
    std::ofstream stream(file, std::ios::binary);
    stream << content;
    if (!stream.flush()) {
        throw Error(file, "cannot be written");
    }
    return file;
}

std::string read_whole_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    if (!file) {
        throw Error(path, "cannot be read");
    }
    return text.str();
}

std::uint64_t Random::next() {
    m_state += 0x9e3779b97f4a7c15u;
    std::uint64_t z = m_state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

std::string random_bytes(std::size_t count, std::uint64_t seed) {
    Random random(seed);
    std::string bytes(count, '\0');
    for (char& byte : bytes) {
        byte = static_cast<char>(random.next() & 0xffu);
    }
    return bytes;
}

} // namespace elvis::conformance
