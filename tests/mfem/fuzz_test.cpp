// Mutated files are refused with a message or read; nothing crashes, hangs or takes gigabytes.
#include "fixture.hpp"

#include <catch2/catch.hpp>
#include <core/base/error.hpp>

#include <algorithm>
#include <random>

#include <sys/resource.h>

namespace {

class Mutator {
public:
    explicit Mutator(std::uint32_t seed) : m_generator(seed) {}

    std::string operator()(std::string text) {
        for (std::size_t n = 1 + below(3); n > 0; --n) {
            mutate(text);
        }
        return text;
    }

private:
    std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(m_generator); }

    /** First and end of a word. Half of them are among the first of the file, where the structure is. */
    std::pair<std::size_t, std::size_t> pick_word(const std::string& text) {
        const std::size_t reach = below(2) == 0 ? std::min<std::size_t>(text.size(), 800) : text.size();
        const std::size_t first = std::min(text.find_first_not_of(" \n", below(reach)), text.size());
        return {first, std::min(text.find_first_of(" \n", first), text.size())};
    }

    void mutate(std::string& text) {
        if (text.empty()) {
            return;
        }
        static const std::vector<std::string> words{"-1",
                                                    "0",
                                                    "1",
                                                    "2147483647",
                                                    "-2147483648",
                                                    "99999999999999999999",
                                                    "nan",
                                                    "1e308",
                                                    "7",
                                                    "16777216",
                                                    "x",
                                                    "H1_3D_P20",
                                                    "#",
                                                    "L2_3D_P7",
                                                    "ND_3D_P3",
                                                    "nodes",
                                                    "vertices",
                                                    "\"",
                                                    "2",
                                                    "L2_2D_P7",
                                                    "RT_2D_P3",
                                                    "hex",
                                                    "="};
        switch (below(6)) {
        case 0:
            text.resize(below(text.size()));
            break;
        case 1:
            text[below(text.size())] = static_cast<char>(below(256));
            break;
        case 2: {
            const auto [first, end] = pick_word(text);
            text.replace(first, end - first, words[below(words.size())]);
            break;
        }
        case 3: {
            const auto [first, end] = pick_word(text);
            text.erase(first, end - first);
            break;
        }
        case 4: {
            // A line.
            const std::size_t first = text.rfind('\n', pick_word(text).first) + 1;
            text.erase(first, std::min(text.find('\n', first), text.size()) - first);
            break;
        }
        default: {
            // One word in place of another.
            const auto [from, from_end] = pick_word(text);
            const std::string copy = text.substr(from, from_end - from);
            const auto [first, end] = pick_word(text);
            text.replace(first, end - first, copy);
        }
        }
    }

    std::mt19937 m_generator;
};

void check_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    CHECK(usage.ru_maxrss < 2 * 1024 * 1024);
}

} // namespace

TEST_CASE("mutated files are read or refused", "[mfem][data][fuzz]") {
    const std::string name = GENERATE(
        "mfem/poisson-inline-pyramid-p3", "mfem/poisson-inline-tet-p6", "mfem/poisson-inline-wedge-p5",
        "mfem/poisson-toroid-wedge-p4", "mfem/poisson-toroid-hex-p5", "mfem/dg-fichera-amr-p2", "mfem/maxwell-fichera-q3-nd3",
        "mfem/graddiv-fichera-rt2", "mfem/poisson-fichera-mixed-p2-p3", "mfem/advect-periodic-p6", "mfem/elast-beam-hex-p4",
        "mfem/dg-fichera-q3-p4", "mfem/poisson-fichera-q3-p5", "mfem-more/star-q3-h1-p5-vec", "mfem-more/amr-quad-h1-p3",
        "mfem-more/klein-bottle-h1-p4", "mfem-more/periodic-hexagon-l2-p3", "mfem-more/rt2d-star-p2",
        "mfem-more/nd2d-star-mixed-p2", "mfem-more/disc-nurbs-nurbs", "mfem-more/pipe-nurbs-nurbs");
    const std::string mesh = read_file(elvis::test::data_file(name + "/mesh.mesh"));
    const std::string solution = read_file(elvis::test::data_file(name + "/sol.gf"));
    const TemporaryFolder folder;
    Mutator mutator(20261121);
    // Fewer of the large ones, for the sake of time.
    const int n_variants = mesh.size() + solution.size() > 500000 ? 60 : 200;
    int n_read = 0;
    for (int variant = 0; variant < n_variants; ++variant) {
        const bool is_mesh = variant % 2 == 0;
        const std::string mesh_path = folder.write("v.mesh", is_mesh ? mutator(mesh) : mesh);
        const std::string solution_path = folder.write("v.gf", is_mesh ? solution : mutator(solution));
        INFO("variant " << variant);
        try {
            const auto source = open_mfem({mesh_path, solution_path});
            ++n_read;
            std::vector<double> values(source.n_values());
            for (std::uint64_t element = 0; element < source.info().n_elements; element += 11) {
                source.sample(0, element, std::array{-0.9, -0.8, -0.7}, values);
            }
        } catch (const elvis::Error& error) {
            CHECK(std::string(error.what()).find("v.") != std::string::npos);
        }
    }
    CHECK(n_read < n_variants);
    check_memory();
}

TEST_CASE("mutated inline meshes are read or refused", "[mfem][data][fuzz]") {
    const std::string mesh = read_file(elvis::test::data_file(
        std::string("mfem-more/meshes/inline-") + GENERATE("quad", "tri", "hex", "tet", "wedge", "pyramid") + ".mesh"));
    const TemporaryFolder folder;
    Mutator mutator(20261125);
    int n_read = 0;
    for (int variant = 0; variant < 300; ++variant) {
        INFO("variant " << variant);
        try {
            const auto source = open_mfem({folder.write("v.mesh", mutator(mesh))});
            ++n_read;
            std::array<double, 3> x;
            source.evaluate_mapping(source.info().n_elements - 1, std::array{-0.9, -0.8, -0.7}, x);
        } catch (const elvis::Error& error) {
            CHECK(std::string(error.what()).find("v.") != std::string::npos);
        }
    }
    CHECK(n_read < 300);
    check_memory();
}
