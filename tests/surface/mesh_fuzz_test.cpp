// Damaged files give an Error or a mesh whose triangles exist, nothing else. The seed is fixed, so that a failure can be
// repeated; the sanitizers of the preset "sanitize" see what a plain run would not.
#include "mesh_samples.hpp"

#include <core/base/error.hpp>

#include <catch2/catch.hpp>

#include <random>

namespace elvis {

TEST_CASE("damaged mesh files are refused or read, and nothing worse") {
    std::mt19937 random(20240611);
    std::size_t n_read = 0, n_refused = 0;
    std::vector<samples::Sample> all = samples::all();
    all.push_back({"bpt", samples::bpt(), samples::read_bpt_points});
    for (const samples::Sample& sample : all) {
        for (int round = 0; round < 2000; ++round) {
            std::string text = sample.text;
            const auto place = [&] { return std::uniform_int_distribution<std::size_t>(0, text.size() - 1)(random); };
            const int n_changes = 1 + round % 3;
            for (int change = 0; change < n_changes && !text.empty(); ++change) {
                switch (random() % 5) {
                case 0:
                    text[place()] = static_cast<char>(random());
                    break;
                case 1:
                    text.resize(place());
                    break;
                case 2:
                    text.insert(place(), text.substr(place(), random() % 20));
                    break;
                case 3:
                    text.erase(place(), random() % 8);
                    break;
                default:
                    text.insert(place(),
                                std::array<const char*, 4>{"-1", "99999999999999999999", "1e999", "nan"}[random() % 4]);
                }
            }
            try {
                const TriangleMesh mesh = sample.read("file", text);
                ++n_read;
                for (const auto& triangle : mesh.triangles) {
                    for (const std::uint32_t corner : triangle) {
                        REQUIRE(corner < mesh.points.size());
                        REQUIRE(!MeshBuilder::fault_of(mesh.points[corner]));
                    }
                }
            } catch (const Error&) {
                ++n_refused;
            }
        }
    }
    WARN(n_read << " read, " << n_refused << " refused");
    CHECK(n_read > 100);
    CHECK(n_refused > 1000);
}

} // namespace elvis
