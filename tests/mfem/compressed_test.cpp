// Files compressed by gzip.
#include "fixture.hpp"

#include <catch2/catch.hpp>

#include <zlib.h>

#include <cstdio>

using namespace elvis;
using Catch::Contains;

namespace {

std::string pack(const std::string& path, const std::string& text) {
    const gzFile file = gzopen(path.c_str(), "wb");
    REQUIRE(file != nullptr);
    REQUIRE(gzwrite(file, text.data(), static_cast<unsigned>(text.size())) == static_cast<int>(text.size()));
    REQUIRE(gzclose(file) == Z_OK);
    return path;
}

} // namespace

TEST_CASE("compressed files are read like others", "[mfem][data]") {
    const TemporaryFolder folder;
    const auto plain_path = [](const char* name) { return test::data_file(std::string("mfem-more/star-h1-p3/") + name); };
    const std::string mesh = pack(folder.path("mesh.mesh.gz"), read_file(plain_path("mesh.mesh")));
    const std::string solution = pack(folder.path("sol.gf.gz"), read_file(plain_path("sol.gf")));
    const auto packed = open_mfem({mesh, solution});
    const auto plain = open_mfem({plain_path("mesh.mesh"), plain_path("sol.gf")});
    REQUIRE(packed.info().n_elements == plain.info().n_elements);
    CHECK(packed.fields().at(0).name == "sol");
    std::array<double, 1> here, there;
    packed.sample(0, 7, std::array{0.3, -0.2, 0.0}, here);
    plain.sample(0, 7, std::array{0.3, -0.2, 0.0}, there);
    CHECK(here == there);
}

TEST_CASE("damaged compressed files are refused", "[mfem][data]") {
    const TemporaryFolder folder;
    const std::string text = read_file(test::data_file("mfem-more/star-h1-p3/mesh.mesh"));
    const std::string packed = read_file(pack(folder.path("good.gz"), text));
    CHECK(failure({folder.path("good.gz")}) == "no failure");
    CHECK_THAT(failure({folder.write("short.gz", packed.substr(0, packed.size() / 2))}),
               Contains("short.gz") && Contains("damaged"));
    CHECK_THAT(failure({folder.write("cut.gz", packed.substr(0, packed.size() - 3))}), Contains("damaged"));
    // Headers have bits that mean nothing to readers; everything behind them is checked.
    for (std::size_t place = 12; place < packed.size(); place += 7) {
        std::string flipped = packed;
        flipped[place] = static_cast<char>(flipped[place] ^ 4);
        INFO(place);
        CHECK_THAT(failure({folder.write("flipped.gz", flipped)}), Contains("flipped.gz"));
    }
}

TEST_CASE("a small compressed file cannot take all memory", "[mfem]") {
    const TemporaryFolder folder;
    const std::string path = folder.path("bomb.gz");
    const gzFile file = gzopen(path.c_str(), "wb");
    const std::string blanks(std::size_t{1} << 24, ' ');
    for (int i = 0; i < 10; ++i) {
        REQUIRE(gzwrite(file, blanks.data(), static_cast<unsigned>(blanks.size())) > 0);
    }
    REQUIRE(gzclose(file) == Z_OK);
    CHECK_THAT(failure({path}), Contains("100 times"));
}
