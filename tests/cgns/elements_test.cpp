// Elements of every type and order, against closed forms at points inside.
#include "fixture.hpp"
#include "node_tables.hpp"

#include <catch2/catch.hpp>

#include <map>

using namespace elvis;
using cgns_test::ElementTable;

namespace {

/** What sums of 125 products of numbers of size 1 to 100 round to, relative to the largest coordinate, which is 160. */
constexpr double rounding = 1e-12;

/** The tables' coordinates are affine functions of Elvis's, which the corners determine. */
class ToTable {
public:
    /** Corners are told by where they lie. */
    ToTable(const SourceVolume& source, std::uint64_t element, native::Shape shape, const ElementTable& table, int degree) {
        const std::vector<int> used = native::dimension(shape) == 2
                                          ? std::vector{0, 1, native::n_corners(shape) - 1}
                                          : std::vector{0, 1, shape == native::Shape::tetrahedron ? 2 : 3, 4};
        for (const int corner : used) {
            const int last = native::n_corners(shape) - 1;
            const native::Point xi = native::corner(shape, std::min(corner, last));
            m_xi.push_back(xi);
            m_x.push_back(node_at(position(source, element, xi), static_cast<double>(element), table, degree));
        }
    }

    Point operator()(const Point& xi) const {
        // Each further corner differs from the first one along one axis.
        Point x = m_x[0];
        for (std::size_t corner = 1; corner < m_xi.size(); ++corner) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double step = m_xi[corner][axis] - m_xi[0][axis];
                for (std::size_t to = 0; to < 3 && step != 0; ++to) {
                    x[to] += (xi[axis] - m_xi[0][axis]) / step * (m_x[corner][to] - m_x[0][to]);
                }
            }
        }
        return x;
    }

private:
    static Point node_at(const Point& world, double place, const ElementTable& table, int degree) {
        for (const Point& node : table.nodes) {
            const Point at = cgns_test::bent(degree, table.dimension, node, place);
            if (std::abs(at[0] - world[0]) + std::abs(at[1] - world[1]) + std::abs(at[2] - world[2]) < 1e-9) {
                return node;
            }
        }
        FAIL("a corner of " << table.name << " is none of its nodes");
        return {};
    }

    std::vector<Point> m_xi;
    std::vector<Point> m_x;
};

double difference(const Point& a, const Point& b) {
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

/** Largest differences. */
struct Errors {
    double position = 0;
    double value = 0;
};

void raise(double& largest, double error) { largest = std::isnan(error) ? HUGE_VAL : std::max(largest, std::abs(error)); }

void raise(Errors& largest, const Errors& errors) {
    raise(largest.position, errors.position);
    raise(largest.value, errors.value);
}

/** The tables of one dimension, in the order of the file's elements. */
std::vector<ElementTable> tables(int dimension) {
    std::vector<ElementTable> all = cgns_test::element_tables();
    std::erase_if(all, [&](const ElementTable& table) { return table.dimension != dimension; });
    return all;
}

int degree_of(const ElementTable& table) { return table.is_complete ? table.order : std::min(table.order, 2); }

std::size_t field_index(const SourceVolume& source, const std::string& name) {
    const std::vector<std::string> names = field_names(source);
    const auto found = std::ranges::find(names, name);
    REQUIRE(found != names.end());
    return static_cast<std::size_t>(found - names.begin());
}

} // namespace

TEST_CASE("every type of element has the polynomials of its degree", "[cgns]") {
    const int dimension = GENERATE(2, 3);
    const std::string container = GENERATE("hdf5", "adf");
    const TemporaryFolder folder;
    const SourceVolume source = open_cgns({write_cgns(folder, dimension == 3 ? "volumes" : "surfaces", container)});
    const std::vector<ElementTable> all = tables(dimension);
    REQUIRE(source.info().n_elements == all.size());
    CHECK(source.info().dimension == static_cast<std::uint32_t>(dimension));
    CHECK(field_names(source) == std::vector<std::string>{"Density", "Velocity", "Density (cells)"});
    const std::vector<elvis_source_element> elements = all_elements(source);

    const TemporaryFolder converted_folder;
    const std::string converted = converted_folder.path("volume.h5");
    const ConvertReport report = convert(source, converted, {}, {});
    CHECK(report.geometry_exact);
    for (const FieldReport& field : report.fields) {
        INFO(field.name);
        CHECK(field.exact);
    }
    const oracle::Volume density(oracle::read_volume(converted, field_index(source, "Density")));
    const oracle::Volume velocity(oracle::read_volume(converted, field_index(source, "Velocity")));
    std::map<std::int64_t, std::size_t> in_volume;
    for (std::size_t element = 0; element < density.n_elements(); ++element) {
        in_volume[density.number(element)] = element;
    }

    Errors largest_of_source, largest_of_converted;
    for (std::uint64_t element = 0; element < all.size(); ++element) {
        const ElementTable& table = all[element];
        INFO(table.name);
        Errors of_source, of_converted;
        const auto shape = static_cast<native::Shape>(elements[element].shape);
        const ToTable to_table(source, element, shape, table, degree_of(table));
        const std::size_t at = in_volume.at(static_cast<std::int64_t>(element));
        for (int trial = 0; trial < 20; ++trial) {
            const Point xi = random_point(shape), x = to_table(xi);
            const Point world = cgns_test::bent(degree_of(table), dimension, x, static_cast<double>(element));
            const double expected = cgns_test::value(degree_of(table), x);
            const std::vector<double> values = sample(source, element, xi);
            raise(of_source.position, difference(position(source, element, xi), world) / 160);
            raise(of_source.value, values[0] - expected);
            for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis) {
                raise(of_source.value, (values[1 + axis] - world[axis]) / 160);
                raise(of_converted.value, (velocity.field(at, {xi[0], xi[1], xi[2]})[axis] - world[axis]) / 160);
            }
            CHECK(values.back() == static_cast<double>(element) + 0.5);
            const auto in_file = density.position(at, {xi[0], xi[1], xi[2]});
            raise(of_converted.position, difference({in_file[0], in_file[1], in_file[2]}, world) / 160);
            raise(of_converted.value, density.field(at, {xi[0], xi[1], xi[2]})[0] - expected);
        }
        CHECK(of_source.position < rounding);
        CHECK(of_source.value < rounding);
        CHECK(of_converted.position < rounding);
        CHECK(of_converted.value < rounding);
        raise(largest_of_source, of_source);
        raise(largest_of_converted, of_converted);
    }
    std::printf("%d dimensions, %s: %zu types; in the source positions %.1e, values %.1e; converted %.1e, %.1e\n", dimension,
                container.c_str(), all.size(), largest_of_source.position, largest_of_source.value,
                largest_of_converted.position, largest_of_converted.value);
}
