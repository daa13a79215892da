// Wrong files: refused with their place, and random damage never does harm.
#include "fixture.hpp"
#include "msh_mesh.hpp"
#include "msh_writer.hpp"
#include "scripts.hpp"

#include <catch2/catch.hpp>
#include <core/base/error.hpp>
#include <sys/resource.h>

#include <chrono>

using Catch::Contains;

namespace {

const std::string head = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string nodes = "$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n";
const std::string elements = "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";
const std::string data = "$NodeData\n1\n\"f\"\n1\n0\n3\n0\n1\n4\n1 1\n2 2\n3 3\n4 4\n$EndNodeData\n";

/** The failure of the small file after one replacement. */
std::string changed(const std::string& from, const std::string& to) {
    std::string text = head + nodes + elements + data;
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
    const TemporaryFolder folder;
    return failure({folder.write("wrong.msh", text)});
}

/** Reads all of a source: what was accepted must work. */
void use(const elvis::SourceVolume& source) {
    const std::uint64_t n = source.info().n_elements;
    std::vector<elvis_source_space> spaces(n);
    for (std::uint32_t field = 0; field < source.fields().size(); ++field) {
        source.spaces(field, 0, n, spaces);
    }
    for (std::uint64_t element = 0; element < n; ++element) {
        const Point xi = random_point(shape_of(source, element));
        position(source, element, xi);
        sample(source, element, xi, static_cast<std::uint32_t>(source.times().size() - 1));
    }
}

std::size_t draw(std::size_t below) { return std::uniform_int_distribution<std::size_t>(0, below - 1)(random_numbers()); }

/** One kind of damage at a random place. */
std::string damage(std::string bytes) {
    switch (draw(6)) {
    case 0:
        bytes.resize(draw(bytes.size()));
        break;
    case 1:
        for (std::size_t flips = 1 + draw(4); flips > 0; --flips) {
            bytes[draw(bytes.size())] = static_cast<char>(draw(256));
        }
        break;
    case 2: { // another number in the text
        const std::size_t at = bytes.find_first_of("0123456789", draw(bytes.size()));
        if (at != std::string::npos) {
            static const char* const numbers[] = {"-1",    "0",   "4294967295", "18446744073709551615",
                                                  "1e308", "nan", "99",         "2147483647"};
            bytes.replace(at, bytes.find_first_not_of("0123456789.", at) - at, numbers[draw(8)]);
        }
        break;
    }
    case 3: { // a line away, or a section's mark
        const std::size_t at = bytes.find(draw(2) ? '\n' : '$', draw(bytes.size()));
        if (at != std::string::npos) {
            bytes.erase(at, std::min(bytes.find('\n', at + 1), bytes.size()) - at);
        }
        break;
    }
    case 4: { // a piece twice
        const std::size_t at = draw(bytes.size());
        bytes.insert(draw(bytes.size()), bytes.substr(at, draw(200)));
        break;
    }
    default: // huge or negative numbers in binary
        for (std::size_t at = draw(bytes.size()), count = 0; count < 8 && at + count < bytes.size(); ++count) {
            bytes[at + count] = draw(2) ? '\xff' : '\x7f';
        }
    }
    return bytes;
}

} // namespace

TEST_CASE("wrong files are refused with their place", "[gmsh]") {
    REQUIRE(changed("4 4\n", "4 5\n") == "no failure");
    CHECK_THAT(changed(head, ""), Contains("wrong.msh") && Contains("$MeshFormat"));
    CHECK_THAT(changed("4.1", "4.0"), Contains("line 2") && Contains("4.0"));
    CHECK_THAT(changed("4.1", "3"), Contains("version"));
    CHECK_THAT(changed("0 8", "0 4"), Contains("data size 4"));
    CHECK_THAT(changed("$EndNodes", "$EndNode"), Contains("$EndNodes") && Contains("line 15"));
    CHECK_THAT(changed("1 4 1 4", "1 5 1 5"), Contains("$Nodes") && Contains("less"));
    CHECK_THAT(changed("1 4 1 4", "1 400000000000 1 4"), Contains("cannot hold 400000000000 nodes"));
    CHECK_THAT(changed("3 1 0 4", "3 1 0 5"), Contains("more nodes"));
    CHECK_THAT(changed("0 1 0\n0 0 1\n$", "0 1 nan\n0 0 1\n$"), Contains("line 13") && Contains("not finite"));
    CHECK_THAT(changed("0 1 0\n0 0 1\n$", "0 1 x\n0 0 1\n$"), Contains("line 13") && Contains("'x'"));
    CHECK_THAT(changed("\n2\n3\n4\n0", "\n2\n3\n3\n0"), Contains("node 3 is given twice"));
    CHECK_THAT(changed("1 1 2 3 4\n$", "1 1 2 3 5\n$"), Contains("element 1") && Contains("node 5"));
    CHECK_THAT(changed("3 1 4 1\n", "3 1 34 1\n"), Contains("element type 34"));
    CHECK_THAT(changed("3 1 4 1\n", "3 1 125 1\n"), Contains("$Elements"));
    CHECK_THAT(changed("3 1 4 1\n", "2 1 4 1\n"), Contains("dimension 2"));
    CHECK_THAT(changed("\n3\n0\n1\n4\n", "\n3\n0\n2\n4\n"), Contains("2 components") && Contains("line 28"));
    CHECK_THAT(changed("\n3\n0\n1\n4\n", "\n2\n0\n1\n"), Contains("integer tags"));
    CHECK_THAT(changed("3 3\n", "7 3\n"), Contains("no node 7") && Contains("'f'"));
    CHECK_THAT(changed("$NodeData\n1\n\"f\"", "$NodeData\n2\n\"f\"\n\"own\""), Contains("no $InterpolationScheme named 'own'"));
    CHECK_THAT(changed(elements, ""), Contains("no mesh"));
    CHECK_THAT(changed(data, "$Elem"), Contains("no end"));
    CHECK_THAT(changed("3 1 4 1\n1 1 2 3 4", "2 1 2 1\n1 1 2 3"), Contains("no failure"));
    CHECK_THAT(changed("3 1 4 1\n1 1 2 3 4", "1 1 1 1\n1 1 2"), Contains("no elements of two or three dimensions"));
    const std::string in_elements = "$ElementNodeData\n1\n\"g\"\n1\n0\n3\n0\n1\n1\n1 3 1 2 3\n$EndElementNodeData\n";
    CHECK_THAT(changed(data, in_elements), Contains("element 1") && Contains("3 values"));
    const std::string scheme = "$InterpolationScheme\n\"own\"\n1\n5\n2\n1 1\n1\n1 3\n31 0 0\n$EndInterpolationScheme\n";
    CHECK_THAT(changed(data, scheme), Contains("exponent 31"));
    const TemporaryFolder folder;
    CHECK_THAT(failure({folder.path("")}), Contains("not a file"));
    CHECK_THAT(failure({folder.path("missing.msh")}), Contains("missing.msh"));
    CHECK_THAT(failure({folder.write("old.msh", "$NOD\n1\n1 0 0 0\n$ENDNOD\n")}), Contains("version 1"));
}

TEST_CASE("serendipity pyramids without functions are refused", "[gmsh]") {
    const TemporaryFolder folder;
    run_gmsh(folder, boxes_script, "-3 -order 3 -setnumber Mesh.SecondOrderIncomplete 1 -format msh41 -o mesh.msh");
    CHECK_THAT(failure({folder.path("mesh.msh")}), Contains("21-node pyramid") && Contains("no interpolation"));
}

TEST_CASE("damaged files are refused or accepted, and do no harm", "[gmsh]") {
    const TemporaryFolder folder;
    run_gmsh(folder, boxes_script, "-3 -order 2 -format msh41 -o mesh.msh -setnumber curved 1");
    const MshMesh mesh = read_mesh(folder.path("mesh.msh"));
    ViewText at_nodes{.name = "at nodes"}, in_elements{.section = "ElementNodeData", .name = "in elements", .scheme = "own"};
    for (const auto& [tag, x] : mesh.nodes) {
        at_nodes.records.push_back({tag, {x[0]}});
    }
    for (const MshElement& element : mesh.of_dimension(3)) {
        if (facts(element.type).topology == 5) {
            in_elements.records.push_back({element.tag, {1, 2}});
        }
    }
    const std::string scheme =
        "$InterpolationScheme\n\"own\"\n1\n5\n2\n2 3\n1 0 0\n0 1 2\n3 3\n0 0 0\n1 0 0\n0 2 1\n$EndInterpolationScheme\n";
    const auto start = std::chrono::steady_clock::now();
    int n_refused = 0, n_all = 0;
    double slowest = 0;
    for (const Variant& variant : {Variant{true, false, false}, Variant{true, true, false}, Variant{true, true, true},
                                   Variant{false, false, false}, Variant{false, true, false}}) {
        const std::string bytes =
            write_mesh(mesh, variant) + scheme + write_view(at_nodes, variant) + write_view(in_elements, variant);
        use(open_msh({folder.write("good.msh", bytes)}));
        for (int trial = 0; trial < 200; ++trial) {
            const std::string path = folder.write("damaged.msh", damage(bytes));
            const auto begin = std::chrono::steady_clock::now();
            ++n_all;
            try {
                use(open_msh({path}));
            } catch (const elvis::Error& error) {
                ++n_refused;
                CHECK_THAT(error.what(), Contains("damaged.msh"));
            }
            slowest = std::max(slowest, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
        }
    }
    rusage usage{};
    REQUIRE(getrusage(RUSAGE_SELF, &usage) == 0);
    WARN(n_refused << " of " << n_all << " refused in "
                   << std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() << " s, slowest "
                   << slowest << " s, largest memory " << usage.ru_maxrss / 1024 << " MiB");
    CHECK(n_refused > n_all / 2);
    CHECK(usage.ru_maxrss / 1024 < 1024);
    // Milliseconds, and more on a busy machine; none hangs.
    CHECK(slowest < 60);
}
