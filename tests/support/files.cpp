#include <tests/support/files.hpp>

#include <catch2/catch.hpp>

#include <fstream>
#include <iterator>

namespace elvis::test {

std::vector<std::string> names_in(const TemporaryFolder& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        names.push_back(entry.path().filename().string());
    }
    return names;
}

std::string data_file(const std::string& name) {
    const std::string path = ELVIS_TEST_DATA "/" + name;
    INFO(path);
    REQUIRE(std::filesystem::exists(path));
    return path;
}

std::string read_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    INFO(path.string());
    REQUIRE(file);
    return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace elvis::test
