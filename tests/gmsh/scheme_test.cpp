// $InterpolationScheme: bases that a file brings along.
#include "fixture.hpp"
#include "msh_mesh.hpp"
#include "msh_writer.hpp"
#include "reference.hpp"
#include "scripts.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdio>

namespace {

using Exponents = std::vector<std::array<int, 3>>;

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g ", value);
    return text;
}

/** A matrix of random coefficients, and the section's text for one topology. */
struct TopologyScheme {
    int topology;
    Exponents exponents;
    std::vector<std::vector<double>> coefficients;

    TopologyScheme(int of_topology, Exponents of_exponents) : topology(of_topology), exponents(std::move(of_exponents)) {
        std::uniform_real_distribution<double> uniform(-1, 1);
        // One function less than monomials: the matrix need not be square.
        coefficients.assign(exponents.size() - 1, std::vector<double>(exponents.size()));
        for (auto& row : coefficients) {
            for (double& entry : row) {
                entry = uniform(random_numbers());
            }
        }
    }

    std::string text() const {
        std::string out = std::to_string(topology) + "\n2\n" + std::to_string(coefficients.size()) + " " +
                          std::to_string(exponents.size()) + "\n";
        for (const auto& row : coefficients) {
            for (const double entry : row) {
                out += number(entry);
            }
            out += "\n";
        }
        const int n_columns = topology <= 4 ? 2 : 3;
        out += std::to_string(exponents.size()) + " " + std::to_string(n_columns) + "\n";
        for (const auto& row : exponents) {
            for (int column = 0; column < n_columns; ++column) {
                out += std::to_string(row[static_cast<std::size_t>(column)]) + " ";
            }
            out += "\n";
        }
        return out;
    }

    double value(const std::vector<double>& values, const Point& xi) const {
        double sum = 0;
        for (std::size_t function = 0; function < coefficients.size(); ++function) {
            for (std::size_t index = 0; index < exponents.size(); ++index) {
                sum += values[function] * coefficients[function][index] * monomial(topology, exponents[index], xi);
            }
        }
        return sum;
    }
};

Exponents complete(int topology, int order) {
    return monomials(
        {.dimension = topology <= 4 ? 2 : 3, .n_nodes = 0, .topology = topology, .order = order, .is_serendipity = false});
}

} // namespace

TEST_CASE("interpolation schemes are exact on all shapes", "[gmsh]") {
    for (const int dimension : {3, 2}) {
        for (const bool is_binary : {false, true}) {
            const TemporaryFolder folder;
            const std::string options = "-order 2 -format msh41 -o mesh.msh -setnumber curved 1";
            run_gmsh(folder, boxes_script, options + (dimension == 3 ? " -3" : " -2"));
            const MshMesh mesh = read_mesh(folder.path("mesh.msh"));
            const Variant variant{.is_binary = is_binary};
            std::map<int, TopologyScheme> schemes;
            std::string text = write_mesh(mesh, variant) + "$InterpolationScheme\n\"own\"\n" + (dimension == 3 ? "4\n" : "2\n");
            // Different orders by shape, and a hexahedron with different ones by direction.
            for (const int topology : dimension == 3 ? std::vector<int>{5, 6, 7, 8} : std::vector<int>{3, 4}) {
                const auto exponents = topology == 8 ? Exponents{{0, 0, 0}, {4, 0, 1}, {1, 2, 0}, {0, 1, 1}, {3, 2, 1}}
                                                     : complete(topology, 6 - topology / 3);
                text += schemes.try_emplace(topology, topology, exponents).first->second.text();
            }
            text += "$EndInterpolationScheme\n";
            ViewText view{.section = "ElementNodeData", .scheme = "own"};
            const auto elements = mesh.of_dimension(dimension);
            std::uniform_real_distribution<double> uniform(-1, 1);
            for (const MshElement& element : elements) {
                std::vector<double> values(schemes.at(facts(element.type).topology).coefficients.size());
                for (double& value : values) {
                    value = uniform(random_numbers()) / static_cast<double>(values.size());
                }
                view.records.push_back({element.tag, values});
            }
            const auto source = open_msh({folder.write("scheme.msh", text + write_view(view, variant))});
            std::unique_ptr<Converted> converted;
            if (dimension == 3) {
                converted = std::make_unique<Converted>(source);
                CHECK(converted->report().fields.at(0).exact);
            }
            double error = 0, converted_error = 0;
            for (std::size_t element = 0; element < elements.size(); ++element) {
                const TopologyScheme& scheme = schemes.at(facts(elements[element].type).topology);
                for (int trial = 0; trial < 10; ++trial) {
                    const Point xi = random_point(shape_of(source, element));
                    const double expected = scheme.value(view.records[element].second, xi);
                    error = std::max(error, std::abs(sample(source, element, xi)[0] - expected));
                    if (converted) {
                        converted_error = std::max(converted_error, std::abs(converted->value(0, element, xi)[0] - expected));
                    }
                }
                std::vector<elvis_source_space> spaces(1);
                source.spaces(0, element, 1, spaces);
                if (scheme.topology == 8) {
                    CHECK((spaces[0].order[0] == 4 && spaces[0].order[1] == 2 && spaces[0].order[2] == 1));
                }
            }
            WARN(dimension << "D: sampled " << error << ", converted " << converted_error);
            CHECK(error <= 1e-11);
            CHECK(converted_error <= 1e-11);
        }
    }
}

TEST_CASE("matrices that gmsh writes say what it draws", "[gmsh]") {
    for (const int order : {1, 2, 3, 5}) {
        const TemporaryFolder folder;
        // The program fails on views with prisms above order 2.
        const std::string options =
            " -format msh41 -3 -order " + std::to_string(order) + " -setnumber prisms " + (order > 2 ? "0" : "1");
        run_gmsh(folder, boxes_script, "-o straight.msh" + options);
        run_gmsh(folder, boxes_script, "-o curved.msh -setnumber curved 1" + options);
        const MshMesh straight = read_mesh(folder.path("straight.msh")), curved = read_mesh(folder.path("curved.msh"));
        const auto elements = curved.of_dimension(3);
        ViewText view{.section = "ElementNodeData", .name = "f"};
        std::vector<SpaceFunction> functions;
        for (std::size_t element = 0; element < elements.size(); ++element) {
            const SpaceFunction& function = functions.emplace_back(facts(elements[element].type));
            std::vector<double> values;
            for (const Point& node : nodes_from_straight(straight, straight.of_dimension(3)[element])) {
                values.push_back(function(node));
            }
            view.records.push_back({elements[element].tag, values});
        }
        folder.write("view.msh", read_file(folder.path("curved.msh")) + write_view(view, {}));
        run_gmsh(folder,
                 "Merge \"view.msh\"; PostProcessing.SaveInterpolationMatrices = 1; PostProcessing.SaveMesh = 1;"
                 "Save View[0] \"saved.msh\";\n",
                 "-parse_and_exit");
        REQUIRE(read_file(folder.path("saved.msh")).find("\"INTERPOLATION_SCHEME\"\n1\n") != std::string::npos);
        const auto source = open_msh({folder.path("saved.msh")});
        double error = 0;
        for (std::size_t element = 0; element < elements.size(); ++element) {
            for (int trial = 0; trial < 10; ++trial) {
                const Point xi = random_point(shape_of(source, element));
                error = std::max(error, std::abs(sample(source, element, xi)[0] - functions[element](xi)));
            }
        }
        WARN("order " << order << ": " << error);
        CHECK(error <= 1e-11);
    }
}
