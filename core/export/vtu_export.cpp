#include <core/base/xml_text.hpp>
#include <core/export/vtu_export.hpp>

#include <core/base/counted.hpp>
#include <core/base/error.hpp>
#include <core/base/output_file.hpp>
#include <core/export/appended_data.hpp>
#include <core/export/lagrange_nodes.hpp>
#include <core/plugin_host/plugin.hpp>

#include <algorithm>
#include <fstream>
#include <functional>
#include <numeric>
#include <span>

namespace elvis {

namespace {

/** VTK's own limit is 10; this is where equidistant nodes lose more digits than they should. */
constexpr std::uint32_t largest_order = 20;

/** What the cells of one element class have in common. */
struct CellClass {
    std::uint8_t type = 0;
    /** Three coordinates a node. */
    std::vector<double> nodes;

    std::size_t n_nodes() const { return nodes.size() / 3; }
};

/** An array of the file: what its DataArray element says, and who writes its numbers. */
struct ExportArray {
    std::string type;
    std::string name;
    std::uint32_t n_components = 1;
    std::uint64_t n_bytes = 0;
    std::function<void(AppendedArray&)> write;
    /** Where in the file the digits of its offset are. */
    std::streampos offset_place{};
};

class Exporter {
public:
    Exporter(const RuntimeVolume& volume, const ExportOptions& options, const TaskControl& control)
        : m_volume(volume), m_options(options), m_control(control) {
        check();
        for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
            m_classes.push_back(cell_class(index));
        }
        sort_elements();
    }

    ExportReport write(const std::string& output);

private:
    void check() const;
    CellClass cell_class(std::uint32_t index);
    /** Order of a field in a class, -1 if it has none. */
    std::int32_t field_order(std::uint32_t element_class, std::uint32_t field) const;
    bool is_constant(std::uint32_t field) const;
    void sort_elements();
    std::uint32_t class_of(std::uint64_t element) const;

    std::vector<ExportArray> point_arrays() const;
    std::vector<ExportArray> cell_arrays() const;
    std::vector<ExportArray> connectivity_arrays() const;
    ExportArray field_array(std::uint32_t field, bool of_cells) const;
    void for_each_element(const std::function<void(std::uint64_t element, const CellClass& cells)>& visit) const;
    static void write_element(std::ostream& out, ExportArray& array);

    const RuntimeVolume& m_volume;
    ExportOptions m_options;
    const TaskControl& m_control;
    std::vector<CellClass> m_classes;
    /** Elements in the order of their numbers. */
    std::vector<std::uint64_t> m_elements;
    ExportReport m_report;
};

void Exporter::check() const {
    const std::string& path = m_volume.path();
    if (!m_volume.has_evaluation()) {
        throw Error(path, "is served by plugin " + m_volume.plugin().id() +
                              ", which does not evaluate on the CPU; only volumes "
                              "that are evaluated there can be exported");
    }
    if (m_volume.is_cut()) {
        throw Error(path,
                    "has elements that are only parts of their reference shape (elvis_inside); VTK's cells would be all of it");
    }
    if (m_options.time_step >= m_volume.times().size()) {
        throw Error(path, "has " + counted(m_volume.times().size(), "time step") + ", no step " +
                              std::to_string(m_options.time_step) + " (counted from 0)");
    }
    if (m_options.order && (*m_options.order < 1 || *m_options.order > largest_order)) {
        throw Error(path, "order " + std::to_string(*m_options.order) + " is outside 1.." + std::to_string(largest_order));
    }
}

std::int32_t Exporter::field_order(std::uint32_t element_class, std::uint32_t field) const {
    if (m_volume.fields()[field].transform != ELVIS_TRANSFORM_NONE) {
        return -1;
    }
    const ClassFieldInfo info = m_volume.class_field(element_class, field);
    const auto orders = std::span(info.order).first(m_volume.dimension());
    return std::ranges::min(orders) < 0 ? -1 : std::ranges::max(orders);
}

bool Exporter::is_constant(std::uint32_t field) const {
    for (std::uint32_t index = 0; index < m_volume.classes().size(); ++index) {
        if (field_order(index, field) != 0) {
            return false;
        }
    }
    return true;
}

CellClass Exporter::cell_class(std::uint32_t index) {
    const ClassInfo& info = m_volume.classes()[index];
    if (info.geometry_order[0] == 0 && !m_options.order) {
        throw Error(m_volume.path(), "the mapping of element class " + std::to_string(index) +
                                         " is not polynomial; say with which order to sample it (--order)");
    }
    std::uint32_t order = std::max({info.geometry_order[0], info.geometry_order[1], info.geometry_order[2], 1u});
    for (std::uint32_t field = 0; field < m_volume.fields().size(); ++field) {
        const std::int32_t of_field = field_order(index, field);
        if (of_field < 0 && !m_options.order) {
            throw Error(m_volume.path(),
                        "field " + m_volume.fields()[field].name +
                            " is not polynomial in the reference coordinates; say with which order to sample it "
                            "(--order)");
        }
        order = std::max(order, static_cast<std::uint32_t>(std::max(of_field, 0)));
    }
    order = m_options.order.value_or(order);
    if (order > largest_order) {
        throw Error(m_volume.path(), "has elements of order " + std::to_string(order) + "; cells go up to order " +
                                         std::to_string(largest_order) + " (--order approximates)");
    }
    if (info.shape == ELVIS_SHAPE_PYRAMID && order > 1) {
        throw Error(m_volume.path(), "has pyramids of order " + std::to_string(order) +
                                         "; VTK has no Lagrange pyramid, only linear ones (--order 1 approximates)");
    }
    m_report.largest_order = std::max(m_report.largest_order, order);
    CellClass cells;
    cells.type = vtk_cell_type(info.shape);
    cells.nodes = lagrange_nodes(info.shape, order);
    m_report.n_cells += info.n_elements;
    m_report.n_points += info.n_elements * cells.n_nodes();
    return cells;
}

void Exporter::sort_elements() {
    const std::uint64_t n = m_volume.n_elements();
    std::vector<std::int64_t> numbers(n);
    m_volume.element_numbers(0, n, numbers);
    m_elements.resize(n);
    std::iota(m_elements.begin(), m_elements.end(), std::uint64_t(0));
    std::ranges::stable_sort(m_elements, {}, [&](std::uint64_t element) { return numbers[element]; });
}

std::uint32_t Exporter::class_of(std::uint64_t element) const {
    const std::vector<ClassInfo>& classes = m_volume.classes();
    const auto after = std::ranges::upper_bound(classes, element, {}, &ClassInfo::first_element);
    // Empty classes share their first element with the next: the last one that begins at or before the element is meant.
    return static_cast<std::uint32_t>(after - classes.begin() - 1);
}

void Exporter::for_each_element(const std::function<void(std::uint64_t, const CellClass&)>& visit) const {
    for (std::size_t index = 0; index < m_elements.size(); ++index) {
        if (index % 256 == 0) {
            m_control.check();
        }
        visit(m_elements[index], m_classes[class_of(m_elements[index])]);
    }
}

ExportArray Exporter::field_array(std::uint32_t field, bool of_cells) const {
    const FieldInfo& info = m_volume.fields()[field];
    const std::uint64_t n_values = (of_cells ? m_report.n_cells : m_report.n_points) * info.n_components;
    return {"Float64", info.name, info.n_components, 8 * n_values,
            [this, field, of_cells, n = info.n_components](AppendedArray& out) {
                std::vector<double> values;
                for_each_element([&](std::uint64_t element, const CellClass& cells) {
                    const std::span xi(cells.nodes.data(), of_cells ? 3 : cells.nodes.size());
                    values.resize(xi.size() / 3 * n);
                    m_volume.evaluate_field(field, m_options.time_step, element, xi, values, {});
                    out.append(std::span<const double>(values));
                });
            }};
}

std::vector<ExportArray> Exporter::point_arrays() const {
    std::vector<ExportArray> arrays;
    arrays.push_back({"Float64", "Points", 3, 24 * m_report.n_points, [this](AppendedArray& out) {
                          std::vector<double> positions;
                          for_each_element([&](std::uint64_t element, const CellClass& cells) {
                              positions.resize(cells.nodes.size());
                              m_volume.evaluate_mapping(element, cells.nodes, positions, {});
                              out.append(std::span<const double>(positions));
                          });
                      }});
    for (std::uint32_t field = 0; field < m_volume.fields().size(); ++field) {
        if (!is_constant(field)) {
            arrays.push_back(field_array(field, false));
        }
    }
    return arrays;
}

std::vector<ExportArray> Exporter::cell_arrays() const {
    std::vector<ExportArray> arrays;
    for (std::uint32_t field = 0; field < m_volume.fields().size(); ++field) {
        if (is_constant(field)) {
            arrays.push_back(field_array(field, true));
        }
    }
    return arrays;
}

std::vector<ExportArray> Exporter::connectivity_arrays() const {
    std::vector<ExportArray> arrays;
    arrays.push_back({"Int64", "connectivity", 1, 8 * m_report.n_points, [this](AppendedArray& out) {
                          std::vector<std::int64_t> points;
                          std::int64_t next = 0;
                          for_each_element([&](std::uint64_t, const CellClass& cells) {
                              points.resize(cells.n_nodes());
                              std::iota(points.begin(), points.end(), next);
                              next += static_cast<std::int64_t>(points.size());
                              out.append(std::span<const std::int64_t>(points));
                          });
                      }});
    arrays.push_back({"Int64", "offsets", 1, 8 * m_report.n_cells, [this](AppendedArray& out) {
                          std::int64_t end = 0;
                          for_each_element([&](std::uint64_t, const CellClass& cells) {
                              end += static_cast<std::int64_t>(cells.n_nodes());
                              out.append(std::span<const std::int64_t>(&end, 1));
                          });
                      }});
    arrays.push_back({"UInt8", "types", 1, m_report.n_cells, [this](AppendedArray& out) {
                          for_each_element([&](std::uint64_t, const CellClass& cells) {
                              out.append(std::span<const std::uint8_t>(&cells.type, 1));
                          });
                      }});
    return arrays;
}

/** Leaves room for the offset, which is known when the array is written. */
void Exporter::write_element(std::ostream& out, ExportArray& array) {
    out << "<DataArray type=\"" << array.type << "\" Name=\"" << xml_text(array.name) << "\" NumberOfComponents=\""
        << array.n_components << "\" format=\"appended\" offset=\"";
    array.offset_place = reserve_offset(out);
    out << "\"/>\n";
}

ExportReport Exporter::write(const std::string& output) {
    OutputFile file(output);
    std::ofstream out(file.temporary(), std::ios::binary);
    if (!out) {
        throw Error(output, "cannot be written");
    }
    std::vector<ExportArray> points = point_arrays(), cells = cell_arrays(), connectivity = connectivity_arrays();
    out.precision(17);
    // Version 2.2: hexahedra in the node order of VTK 9.
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"2.2\" byte_order=\"LittleEndian\" "
           "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n"
        << "<FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">"
        << m_volume.times()[m_options.time_step] << "</DataArray></FieldData>\n"
        << "<Piece NumberOfPoints=\"" << m_report.n_points << "\" NumberOfCells=\"" << m_report.n_cells << "\">\n<Points>\n";
    write_element(out, points.front());
    out << "</Points>\n<PointData>\n";
    std::for_each(points.begin() + 1, points.end(), [&](ExportArray& array) { write_element(out, array); });
    out << "</PointData>\n<CellData>\n";
    std::ranges::for_each(cells, [&](ExportArray& array) { write_element(out, array); });
    out << "</CellData>\n<Cells>\n";
    std::ranges::for_each(connectivity, [&](ExportArray& array) { write_element(out, array); });
    out << "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";

    const std::streampos begin = out.tellp();
    std::vector<ExportArray> arrays;
    for (auto* group : {&points, &cells, &connectivity}) {
        std::ranges::move(*group, std::back_inserter(arrays));
    }
    for (std::size_t index = 0; index < arrays.size(); ++index) {
        m_control.progress(static_cast<double>(index) / static_cast<double>(arrays.size()), "writing " + arrays[index].name);
        fill_offset(out, arrays[index].offset_place, begin);
        AppendedArray array(out, arrays[index].n_bytes);
        arrays[index].write(array);
        array.finish();
        if (!out) {
            throw Error(output, "cannot be written");
        }
    }
    out << "\n</AppendedData>\n</VTKFile>\n";
    out.close();
    if (!out) {
        throw Error(output, "cannot be written");
    }
    file.commit();
    return m_report;
}

} // namespace

ExportReport export_vtu(const RuntimeVolume& volume, const std::string& output, const ExportOptions& options,
                        const TaskControl& control) {
    return Exporter(volume, options, control).write(output);
}

} // namespace elvis
