#include "view_sections.hpp"

#include <cmath>

namespace gmsh {

namespace {

void read_header(Cursor& cursor, DataSection& section) {
    const auto n_texts = cursor.text<std::uint64_t>();
    cursor.end_of_line();
    for (std::uint64_t index = 0; index < n_texts; ++index) {
        std::string content = cursor.quoted();
        if (index == 0) {
            section.view = std::move(content);
        } else if (index == 1) {
            section.scheme = std::move(content);
        }
    }
    if (section.view.empty()) {
        section.view = "unnamed";
    }
    const auto n_reals = cursor.text<std::uint64_t>();
    for (std::uint64_t index = 0; index < n_reals; ++index) {
        const auto number = cursor.text<double>();
        if (index == 0) {
            section.time = number;
        }
    }
    if (!std::isfinite(section.time)) {
        cursor.fail("the time is not finite");
    }
}

/** Integer tags; returns the number of records. */
std::uint64_t read_integers(Cursor& cursor, DataSection& section) {
    const auto n_integers = cursor.text<std::uint64_t>();
    if (n_integers < 3) {
        cursor.fail("less than three integer tags: time step, components and number of records are needed");
    }
    section.step = cursor.text<std::int32_t>();
    const std::size_t begin = cursor.next();
    section.n_components = cursor.text<std::uint32_t>();
    if (section.n_components != 1 && section.n_components != 3 && section.n_components != 9) {
        cursor.fail_at(begin, std::to_string(section.n_components) + " components; Gmsh's views have 1, 3 or 9");
    }
    const auto n_records = cursor.text<std::uint64_t>();
    for (std::uint64_t index = 3; index < n_integers; ++index) {
        const auto number = cursor.text<std::int32_t>();
        if (index == 3) {
            section.partition = number;
        }
    }
    return n_records;
}

Eigen::MatrixXd read_matrix(Cursor& cursor) {
    const auto n_rows = cursor.text<std::uint32_t>();
    const auto n_columns = cursor.text<std::uint32_t>();
    // Functions of the largest order in all three directions; keeps the product below small, too.
    constexpr std::uint32_t most = 31 * 31 * 31;
    if (n_rows == 0 || n_columns == 0 || n_rows > most || n_columns > most) {
        cursor.fail("a matrix of " + std::to_string(n_rows) + " rows and " + std::to_string(n_columns) + " columns");
    }
    // Text whatever the kind of file: two bytes a number at least.
    if (static_cast<std::uint64_t>(n_rows) * n_columns > (cursor.left() + 1) / 2) {
        cursor.fail("the rest of the file cannot hold a matrix of " + std::to_string(n_rows) + " by " +
                    std::to_string(n_columns) + " numbers");
    }
    Eigen::MatrixXd matrix(n_rows, n_columns);
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
        for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
            matrix(row, column) = cursor.text<double>();
            if (!std::isfinite(matrix(row, column))) {
                cursor.fail("a number that is not finite");
            }
        }
    }
    return matrix;
}

std::vector<std::array<int, 3>> to_exponents(const Cursor& cursor, const Eigen::MatrixXd& matrix, Topology topology) {
    if (matrix.cols() < dimension(topology) || matrix.cols() > 3) {
        cursor.fail("a matrix of exponents with " + std::to_string(matrix.cols()) + " columns");
    }
    std::vector<std::array<int, 3>> exponents;
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
        std::array<int, 3>& added = exponents.emplace_back();
        int sum = 0;
        // A third column of a two-dimensional topology has no meaning.
        for (Eigen::Index axis = 0; axis < dimension(topology); ++axis) {
            const double number = matrix(row, axis);
            if (number < 0 || number > max_exponent || number != std::floor(number)) {
                cursor.fail("exponent " + std::to_string(number) + " is not a whole number in 0.." +
                            std::to_string(max_exponent));
            }
            added[static_cast<std::size_t>(axis)] = static_cast<int>(number);
            sum += added[static_cast<std::size_t>(axis)];
        }
        const bool degrees_add = topology == Topology::triangle || topology == Topology::tetrahedron ||
                                 topology == Topology::prism || topology == Topology::pyramid;
        if (degrees_add && sum > max_exponent) {
            cursor.fail("a monomial of degree " + std::to_string(sum) + "; at most " + std::to_string(max_exponent) +
                        " can be converted");
        }
    }
    return exponents;
}

} // namespace

std::string section_name(DataKind kind) {
    return kind == DataKind::node ? "$NodeData" : kind == DataKind::element ? "$ElementData" : "$ElementNodeData";
}

DataSection read_data(Cursor& cursor, DataKind kind) {
    DataSection section;
    section.kind = kind;
    section.path = cursor.path();
    read_header(cursor, section);
    const std::uint64_t n_records = read_integers(cursor, section);
    cursor.end_of_line();
    const std::size_t n_components = section.n_components;
    cursor.check_count(n_records, 1 + n_components, 4 + 8 * n_components, "records");
    for (std::uint64_t record = 0; record < n_records; ++record) {
        const std::size_t begin = cursor.next();
        const auto tag = cursor.value<std::int32_t>();
        if (tag <= 0) {
            cursor.fail_at(begin, "tag " + std::to_string(tag) + ", where Gmsh's tags are above 0");
        }
        std::size_t n_values = n_components;
        if (kind == DataKind::element_node) {
            const auto n_points = cursor.value<std::int32_t>();
            if (n_points <= 0) {
                cursor.fail_at(begin, std::to_string(n_points) + " nodes in element " + std::to_string(tag));
            }
            n_values *= static_cast<std::size_t>(n_points);
            cursor.check_count(n_values, 1, 8, "values");
        }
        section.tags.push_back(static_cast<std::uint64_t>(tag));
        for (std::size_t index = 0; index < n_values; ++index) {
            section.values.push_back(cursor.value<double>());
        }
        section.first.push_back(section.values.size());
    }
    return section;
}

std::pair<std::string, Scheme> read_scheme(Cursor& cursor) {
    std::pair<std::string, Scheme> result;
    result.first = cursor.quoted();
    const auto n_topologies = cursor.text<std::uint64_t>();
    for (std::uint64_t index = 0; index < n_topologies; ++index) {
        const std::size_t begin = cursor.next();
        const auto number = cursor.text<std::int32_t>();
        const auto n_matrices = cursor.text<std::int32_t>();
        if (number < 1 || number > 10 || n_matrices != 2) {
            cursor.fail_at(begin, "element topology " + std::to_string(number) + " with " + std::to_string(n_matrices) +
                                      " matrices; topologies are 1 to 10, and two matrices are read, for the field (the mesh "
                                      "says what the geometry is)");
        }
        Eigen::MatrixXd coefficients = read_matrix(cursor);
        const Eigen::MatrixXd exponents = read_matrix(cursor);
        if (coefficients.cols() != exponents.rows()) {
            cursor.fail("a matrix of coefficients with " + std::to_string(coefficients.cols()) + " columns for " +
                        std::to_string(exponents.rows()) + " monomials");
        }
        const auto topology = static_cast<Topology>(number);
        // Points, lines, polygons and polyhedra are not converted.
        if (number >= static_cast<int>(Topology::triangle) && number <= static_cast<int>(Topology::hexahedron)) {
            result.second[topology] =
                scheme_basis(topology, std::move(coefficients), to_exponents(cursor, exponents, topology));
        }
    }
    return result;
}

} // namespace gmsh
