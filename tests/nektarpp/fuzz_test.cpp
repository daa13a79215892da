// Damaged files: each is refused with an error or read, none crashes, hangs or takes memory without bound.
#include "fixture.hpp"
#include "nektar_writer.hpp"

#include <catch2/catch.hpp>
#include <core/base/error.hpp>

#include <cmath>
#include <cstdlib>
#include <random>

#include <sys/resource.h>

using namespace elvis;

namespace {

using Random = std::mt19937;

std::size_t below(Random& random, std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); }

/** Where a damage may begin: anywhere, but half of the time outside of long runs of base64. */
std::size_t place(Random& random, const std::string& text) {
    if (below(random, 2) == 0) {
        return below(random, text.size());
    }
    const std::size_t found = text.find('<', below(random, text.size()));
    return found == std::string::npos ? 0 : std::min(found + below(random, 60), text.size() - 1);
}

void flip_bytes(Random& random, std::string& text) {
    for (std::size_t n = 1 + below(random, 8); n > 0; --n) {
        text[place(random, text)] = static_cast<char>(below(random, 256));
    }
}

void replace_number(Random& random, std::string& text) {
    constexpr const char* numbers[] = {"-1", "0",   "1e308", "nan", "999999999999", "9223372036854775807", "1e-320",
                                       "",   "7-3", "31",    "2"};
    const std::size_t first = text.find_first_of("0123456789", place(random, text));
    if (first != std::string::npos) {
        const std::size_t last = std::min(text.find_first_not_of("0123456789.", first), text.size());
        text.replace(first, last - first, numbers[below(random, std::size(numbers))]);
    }
}

void remove_part(Random& random, std::string& text) {
    const std::size_t first = text.find('<', below(random, text.size()));
    if (first != std::string::npos) {
        const std::size_t last = text.find('>', first + below(random, 400));
        text.erase(first, last == std::string::npos ? 1 : last - first + 1);
    }
}

void copy_part(Random& random, std::string& text) {
    const std::size_t first = below(random, text.size());
    text.insert(below(random, text.size()), text.substr(first, below(random, 300)));
}

/** Changes words inside of compressed content, which stays valid as such. */
void change_content(Random& random, std::string& text) {
    const std::size_t first = text.find(">eJ", below(random, text.size())) + 1;
    const std::size_t last = text.find('<', first);
    if (first == 0 || last == std::string::npos) {
        flip_bytes(random, text);
        return;
    }
    std::vector<std::uint64_t> words = nektar_writer::unpack(text.substr(first, last - first));
    for (std::size_t n = 1 + below(random, 4); n > 0 && !words.empty(); --n) {
        constexpr std::uint64_t values[] = {
            0, 1, 2, 5, 17, 22, 1000, ~std::uint64_t{0}, 0x7ff8000000000000, 0x7fefffffffffffff, std::uint64_t{1} << 63};
        words[below(random, words.size())] = values[below(random, std::size(values))];
    }
    if (below(random, 8) == 0 && !words.empty()) {
        words.resize(below(random, words.size()));
    }
    text.replace(first, last - first, nektar_writer::pack(words));
}

std::string damaged(Random& random, std::string text) {
    switch (below(random, 6)) {
    case 0:
        text.resize(below(random, text.size()));
        break;
    case 1:
        flip_bytes(random, text);
        break;
    case 2:
        for (std::size_t n = 1 + below(random, 3); n > 0; --n) {
            replace_number(random, text);
        }
        break;
    case 3:
        remove_part(random, text);
        break;
    case 4:
        change_content(random, text);
        break;
    default:
        copy_part(random, text);
    }
    return text.empty() ? " " : text;
}

/** Opens and asks for everything once; false if refused. */
bool is_accepted(const std::vector<std::string>& paths) {
    try {
        const SourceVolume source = open_nektar(paths);
        std::vector<elvis_source_element> elements(source.info().n_elements);
        source.elements(0, elements.size(), elements);
        for (std::uint64_t element = 0; element < elements.size(); ++element) {
            const std::array<double, 3> inside{-0.5, -0.6, -0.7};
            position_at(source, element, inside);
            if (source.n_values() > 0) {
                value_at(source, element, inside);
            }
        }
        return true;
    } catch (const Error& error) {
        CHECK(std::string(error.what()).size() > 10);
        return false;
    }
}

} // namespace

TEST_CASE("damaged files are refused or read", "[nektarpp][data]") {
    struct Sample {
        std::string mesh;
        std::string fields;
    };
    const TemporaryFolder folder;
    std::vector<Sample> samples;
    for (const char* name : {"Hex_01_01_01_03Mode_x2", "Hex_CurvedFace", "Helmholtz3D_Pyr_Deformed", "Helmholtz3D_Prism_VarP",
                             "Helmholtz3D_Tet_VarP", "CubeAllElements", "cA"}) {
        samples.push_back(
            {read_file(sample_file(std::string(name) + ".xml")), read_file(sample_file(std::string(name) + ".fld"))});
    }
    // Compressed curves, which no sample has.
    const nektar_writer::Element element{elvis::native::Shape::prism,
                                         [](const nektar_writer::Point& xi) { return xi; },
                                         5,
                                         "GaussLobattoLegendre",
                                         "NodalTriEvenlySpaced",
                                         3,
                                         true,
                                         {}};
    samples.push_back(
        {nektar_writer::geometry_file(element),
         nektar_writer::field_file({{"u", "Prism", "Ortho_A,Ortho_A,Ortho_B", "UNIORDER:2,2,2", "7", {1, 2, 3, 4, 5, 6}}})});
    Random random(20);
    std::size_t n_accepted = 0, n_total = 0;
    for (const Sample& sample : samples) {
        const std::string mesh = folder.write("mesh.xml", sample.mesh), fields = folder.write("fields.fld", sample.fields);
        REQUIRE(is_accepted({mesh, fields}));
        const int n_variants = sample.mesh.size() > 100000 ? 60 : 200;
        for (int variant = 0; variant < n_variants; ++variant) {
            const bool is_mesh = variant % 2 == 0;
            const std::string wrong = is_mesh ? folder.write("wrong.xml", damaged(random, sample.mesh))
                                              : folder.write("wrong.fld", damaged(random, sample.fields));
            n_accepted += is_accepted(is_mesh ? std::vector{wrong, fields} : std::vector{mesh, wrong}) ? 1 : 0;
            ++n_total;
        }
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    WARN(n_total << " damaged files, " << n_accepted << " still readable; peak memory " << usage.ru_maxrss / 1024 << " MiB");
    CHECK(n_accepted < n_total / 2);
    CHECK(usage.ru_maxrss < 2 * 1024 * 1024);
}
