#include "written_hexahedra.hpp"

#include <elvis/native/space.hpp>
#include <tests/support/written_hdf5.hpp>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

namespace {

using elvis::test::number_type;
using elvis::test::WrittenFile;

std::size_t n(int count) { return static_cast<std::size_t>(count); }

/** vtkHigherOrderHexahedron::PointIndexFromIJK of VTK 9, for equal degrees. */
std::size_t node_at(int i, int j, int k, int p) {
    const auto is_end = [&](int at) { return at == 0 || at == p; };
    const int ends = is_end(i) + is_end(j) + is_end(k), m = p - 1;
    if (ends == 3) {
        return n((i ? (j ? 2 : 1) : (j ? 3 : 0)) + (k ? 4 : 0));
    }
    if (ends == 2) {
        if (!is_end(i)) {
            return n(8 + (i - 1) + (j ? 2 * m : 0) + (k ? 4 * m : 0));
        }
        if (!is_end(j)) {
            return n(8 + (j - 1) + (i ? m : 3 * m) + (k ? 4 * m : 0));
        }
        return n(8 + 8 * m + (k - 1) + m * (i ? (j ? 2 : 1) : (j ? 3 : 0)));
    }
    const int faces = 8 + 12 * m;
    if (ends == 1) {
        if (is_end(i)) {
            return n(faces + (j - 1) + m * (k - 1) + (i ? m * m : 0));
        }
        if (is_end(j)) {
            return n(faces + 2 * m * m + (i - 1) + m * (k - 1) + (j ? m * m : 0));
        }
        return n(faces + 4 * m * m + (i - 1) + m * (j - 1) + (k ? m * m : 0));
    }
    return n(faces + 6 * m * m + (i - 1) + m * ((j - 1) + m * (k - 1)));
}

template <class Number> std::string text(const std::vector<Number>& numbers) {
    std::ostringstream out;
    out.precision(17);
    for (const Number number : numbers) {
        out << number << ' ';
    }
    return out.str();
}

/** Numbers 0, 1, .. or multiples. */
std::vector<std::int64_t> count_up(std::size_t size, std::int64_t step = 1, std::int64_t first = 0) {
    std::vector<std::int64_t> numbers;
    for (std::size_t index = 0; index < size; ++index) {
        numbers.push_back(first + step * static_cast<std::int64_t>(index));
    }
    return numbers;
}

template <class Number> void append(std::vector<Number>& to, const std::vector<Number>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

void write_integers(WrittenFile& file, const std::string& name, const std::vector<std::int64_t>& numbers) {
    file.dataset(name, number_type(H5T_STD_I64LE), {numbers.size()}, numbers.data());
}

void write_reals(WrittenFile& file, const std::string& name, const std::vector<double>& numbers, bool is_single,
                 hsize_t n_columns) {
    std::vector<hsize_t> shape{numbers.size() / n_columns};
    if (n_columns > 1) {
        shape.push_back(n_columns);
    }
    if (is_single) {
        const std::vector<float> rounded(numbers.begin(), numbers.end());
        file.dataset(name, number_type(H5T_IEEE_F32LE), shape, rounded.data());
    } else {
        file.dataset(name, number_type(H5T_IEEE_F64LE), shape, numbers.data());
    }
}

void write_type(WrittenFile& file, const std::string& group, const std::string& type) {
    const std::array<std::int64_t, 2> version{2, 0};
    file.attribute(group, "Version", number_type(H5T_STD_I64LE), {2}, version.data());
    file.texts_attribute(group, "Type", {type}, type.size() + 1);
}

/** Lists that grow from step to step. */
struct Lists {
    std::vector<std::int64_t> n_points, n_cells, n_ids, connectivity, offsets;
    std::vector<std::uint8_t> types;
    std::vector<double> points, values, of_cells;
};

void add_mesh(Lists& lists, const Hexahedra& cells, std::size_t n_parts) {
    const auto nodes = static_cast<std::int64_t>(cells.n_nodes());
    for (std::size_t part = 0; part < n_parts; ++part) {
        const std::size_t count = n_parts == 1 ? cells.n_cells : part == 0 ? 1 : part == 1 ? cells.n_cells - 1 : 0;
        const auto n_here = static_cast<std::int64_t>(count);
        lists.n_points.push_back(n_here * nodes);
        lists.n_cells.push_back(n_here);
        lists.n_ids.push_back(n_here * nodes);
        append(lists.connectivity, count_up(count * cells.n_nodes()));
        append(lists.offsets, count_up(count + 1, nodes));
        lists.types.resize(lists.types.size() + count, 72);
    }
    append(lists.points, cells.points());
}

void add_values(Lists& lists, const Hexahedra& cells, double time) {
    append(lists.values, cells.values(time));
    for (std::size_t cell = 0; cell < cells.n_cells; ++cell) {
        lists.of_cells.push_back(static_cast<double>(cell) + time);
    }
}

void write_steps(WrittenFile& file, const Hexahedra& cells, const HdfLayout& layout) {
    const std::string group = layout.group + "/Steps";
    const std::size_t n_steps = layout.times.size();
    const auto nodes = static_cast<std::int64_t>(cells.n_nodes()), count = static_cast<std::int64_t>(cells.n_cells);
    const std::int64_t again = layout.repeats_mesh ? 1 : 0;
    file.group(group);
    file.group(group + "/PointDataOffsets");
    file.group(group + "/CellDataOffsets");
    file.dataset(group + "/Values", number_type(H5T_IEEE_F64LE), {n_steps}, layout.times.data());
    write_integers(file, group + "/PartOffsets", count_up(n_steps, again * static_cast<std::int64_t>(layout.n_parts)));
    write_integers(file, group + "/PointOffsets", count_up(n_steps, again * count * nodes));
    write_integers(file, group + "/CellOffsets", count_up(n_steps, again * count));
    write_integers(file, group + "/ConnectivityIdOffsets", count_up(n_steps, again * count * nodes));
    write_integers(file, group + "/PointDataOffsets/u", count_up(n_steps, count * nodes));
    write_integers(file, group + "/CellDataOffsets/number", count_up(n_steps, count));
    if (layout.has_number_of_parts) {
        write_integers(file, group + "/NumberOfParts", count_up(n_steps, 0, static_cast<std::int64_t>(layout.n_parts)));
    }
}

void write_grid(WrittenFile& file, const Hexahedra& cells, const HdfLayout& layout) {
    Lists lists;
    for (std::size_t step = 0; step < std::max<std::size_t>(1, layout.times.size()); ++step) {
        if (step == 0 || layout.repeats_mesh) {
            add_mesh(lists, cells, layout.n_parts);
        } else if (!layout.has_number_of_parts) {
            // As MFEM does where the mesh stays.
            for (auto* list : {&lists.n_points, &lists.n_cells, &lists.n_ids, &lists.offsets}) {
                list->resize(list->size() + layout.n_parts, 0);
            }
        }
        add_values(lists, cells, layout.times.empty() ? 0 : layout.times[step]);
    }
    const std::string& group = layout.group;
    file.group(group);
    write_type(file, group, layout.type);
    write_integers(file, group + "/NumberOfPoints", lists.n_points);
    write_integers(file, group + "/NumberOfCells", lists.n_cells);
    write_integers(file, group + "/NumberOfConnectivityIds", lists.n_ids);
    write_integers(file, group + "/Connectivity", lists.connectivity);
    write_integers(file, group + "/Offsets", lists.offsets);
    file.dataset(group + "/Types", number_type(H5T_STD_U8LE), {lists.types.size()}, lists.types.data());
    write_reals(file, group + "/Points", lists.points, layout.is_single, 3);
    file.group(group + "/PointData");
    file.group(group + "/CellData");
    write_reals(file, group + "/PointData/u", lists.values, layout.is_single, 1);
    write_reals(file, group + "/CellData/number", lists.of_cells, layout.is_single, 1);
    if (!layout.times.empty()) {
        write_steps(file, cells, layout);
    }
}

} // namespace

double Hexahedra::field(std::size_t cell, const Vector& r, double time) const {
    const double a = std::pow(2 * r[0] - 1, degree), b = std::pow(2 * r[1] - 1, degree), c = std::pow(2 * r[2] - 1, degree);
    return (1 + static_cast<double>(cell)) * (a + b * r[0] - c * r[1] * a) + time * (1 + b * c);
}

std::size_t Hexahedra::n_nodes() const { return n((degree + 1) * (degree + 1) * (degree + 1)); }

void Hexahedra::for_each_node(const std::function<void(std::size_t, const Vector&)>& visit) const {
    for (int k = 0; k <= degree; ++k) {
        for (int j = 0; j <= degree; ++j) {
            for (int i = 0; i <= degree; ++i) {
                visit(node_at(i, j, k, degree), {line[n(i)], line[n(j)], line[n(k)]});
            }
        }
    }
}

std::vector<double> Hexahedra::points() const {
    std::vector<double> all(3 * n_cells * n_nodes());
    for (std::size_t cell = 0; cell < n_cells; ++cell) {
        for_each_node([&](std::size_t node, const Vector& r) {
            const Vector x = map({r[0] + static_cast<double>(cell), r[1], r[2]});
            std::copy(x.begin(), x.end(), all.begin() + static_cast<std::ptrdiff_t>(3 * (cell * n_nodes() + node)));
        });
    }
    return all;
}

std::vector<double> Hexahedra::values(double time) const {
    std::vector<double> all(n_cells * n_nodes());
    for (std::size_t cell = 0; cell < n_cells; ++cell) {
        for_each_node([&](std::size_t node, const Vector& r) { all[cell * n_nodes() + node] = field(cell, r, time); });
    }
    return all;
}

std::vector<double> equidistant_line(int degree) {
    std::vector<double> line;
    for (int i = 0; i <= degree; ++i) {
        line.push_back(static_cast<double>(i) / degree);
    }
    return line;
}

std::vector<double> lobatto_line(int degree) {
    std::vector<double> line(n(degree) + 1);
    elvis::native::gauss_lobatto_legendre(line);
    for (double& x : line) {
        x = 0.5 * (1 + x);
    }
    return line;
}

std::vector<double> chebyshev_line(int degree) {
    std::vector<double> line;
    for (int i = 0; i <= degree; ++i) {
        line.push_back(0.5 - 0.5 * std::cos(std::numbers::pi * i / degree));
    }
    return line;
}

Hexahedra::Vector bent(const Hexahedra::Vector& x) {
    return {x[0] + 0.15 * std::sin(2 * x[1] + x[2]), x[1] + 0.2 * std::sin(x[0]) * (1 + x[2]),
            x[2] + 0.1 * std::exp(x[1] - x[0] / 2)};
}

void write_vtu(const std::string& path, const Hexahedra& cells, double time) {
    const std::size_t n_points = cells.n_cells * cells.n_nodes();
    std::ofstream(path) << "<VTKFile type=\"UnstructuredGrid\" version=\"2.2\"><UnstructuredGrid><Piece NumberOfPoints=\""
                        << n_points << "\" NumberOfCells=\"" << cells.n_cells
                        << "\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">" << text(cells.points())
                        << "</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\">"
                        << text(count_up(n_points)) << "</DataArray><DataArray type=\"Int64\" Name=\"offsets\">"
                        << text(count_up(cells.n_cells, static_cast<std::int64_t>(cells.n_nodes()),
                                         static_cast<std::int64_t>(cells.n_nodes())))
                        << "</DataArray><DataArray type=\"UInt8\" Name=\"types\">" << text(std::vector<int>(cells.n_cells, 72))
                        << "</DataArray></Cells><PointData><DataArray type=\"Float64\" Name=\"u\">" << text(cells.values(time))
                        << "</DataArray></PointData></Piece></UnstructuredGrid></VTKFile>";
}

void write_vtkhdf(const std::string& path, const Hexahedra& cells, const HdfLayout& layout) {
    WrittenFile file(path);
    write_grid(file, cells, layout);
}

void write_collection(const std::string& path, const Hexahedra& cells, const HdfLayout& layout) {
    WrittenFile file(path);
    file.group("VTKHDF");
    write_type(file, "VTKHDF", "PartitionedDataSetCollection");
    file.group("VTKHDF/Assembly");
    HdfLayout block = layout;
    block.group = "VTKHDF/first";
    write_grid(file, cells, block);
    Hexahedra moved = cells;
    moved.map = [map = cells.map](const Hexahedra::Vector& x) {
        Hexahedra::Vector y = map(x);
        y[0] += 100;
        return y;
    };
    block.group = "VTKHDF/second";
    write_grid(file, moved, block);
}
