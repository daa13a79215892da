// Which files count as part of a data set.

#include <core/base/temporary_folder.hpp>
#include <core/convert/data_set_files.hpp>

#include <catch2/catch.hpp>

using elvis::data_set_files;
using elvis::TemporaryFolder;

namespace {

std::vector<std::string> names(const TemporaryFolder& folder, const std::vector<std::string>& inputs) {
    std::vector<std::string> paths;
    for (const std::string& input : inputs) {
        paths.push_back(folder.path(input));
    }
    std::vector<std::string> found;
    const auto files = data_set_files(paths);
    REQUIRE(files);
    for (const auto& file : *files) {
        found.push_back(file.lexically_relative(folder.path()).string());
    }
    return found;
}

} // namespace

TEST_CASE("Files that a list mentions belong to its data set, and those that these mention") {
    const TemporaryFolder folder;
    folder.write("run.pvd", R"(<DataSet file="steps/one.pvtu"/>)");
    folder.write("steps/one.pvtu", R"(<Piece Source="piece.vtu"/>)");
    folder.write("steps/piece.vtu", "1.5e3 2.");
    folder.write("steps/other.vtu", "");
    CHECK(names(folder, {"run.pvd"}) == std::vector<std::string>{"run.pvd", "steps/one.pvtu", "steps/piece.vtu"});
}

TEST_CASE("Files whose names begin alike belong to a data set, pictures and results do not") {
    const TemporaryFolder folder;
    for (const char* name : {"case0.f00001", "case0.f00002", "case.re2", "case.png", "case.h5", "other.re2"}) {
        folder.write(name, "x");
    }
    CHECK(names(folder, {"case0.f00001"}) == std::vector<std::string>{"case.re2", "case0.f00001", "case0.f00002"});
    CHECK(names(folder, {"case.h5"}).size() == 4);
}

TEST_CASE("HDF5 files beside one belong to its data set, whatever their names") {
    const TemporaryFolder folder;
    const std::string hdf5 = "\x89HDF\r\n\x1a\n";
    folder.write("state.h5", hdf5);
    folder.write("mesh.h5", hdf5);
    folder.write("mesh.txt", "x");
    CHECK(names(folder, {"state.h5"}) == std::vector<std::string>{"mesh.h5", "state.h5"});
}

TEST_CASE("Of a data set of more files than can be watched nothing is known") {
    const TemporaryFolder folder;
    for (int i = 0; i < 20001; ++i) {
        folder.write("case0.f" + std::to_string(100000 + i), "");
    }
    CHECK(!data_set_files({folder.path("case0.f100000")}));
}
