#include "binary_file.hpp"
#include "mesh_files.hpp"

#include <core/base/xml_text.hpp>
#include <core/export/appended_data.hpp>

#include <functional>
#include <numeric>
#include <span>

namespace elvis::commands {

namespace {

/** A file while it is written: texts of arrays first, then their numbers. */
class PolyData {
public:
    explicit PolyData(std::ofstream& file) : m_file(file) {}

    template <class Number>
    void declare(const char* type, const std::string& name, std::size_t n_components, std::vector<Number> numbers) {
        m_file << "<DataArray type=\"" << type << "\" Name=\"" << xml_text(name) << "\" NumberOfComponents=\"" << n_components
               << "\" format=\"appended\" offset=\"";
        const std::streampos offset_at = reserve_offset(m_file);
        m_file << "\"/>\n";
        m_writers.push_back([this, offset_at, all = std::move(numbers)](std::streampos begin) {
            fill_offset(m_file, offset_at, begin);
            AppendedArray array(m_file, all.size() * sizeof(Number));
            array.append(std::span<const Number>(all));
            array.finish();
        });
    }
    void write_arrays() {
        m_file << "<AppendedData encoding=\"raw\">\n_";
        const std::streampos begin = m_file.tellp();
        for (const auto& write : m_writers) {
            write(begin);
        }
        m_file << "\n</AppendedData>\n";
    }

private:
    std::ofstream& m_file;
    std::vector<std::function<void(std::streampos)>> m_writers;
};

void declare_points(PolyData& data, const extracted& mesh, const std::vector<MeshColumn>& columns, std::ofstream& file) {
    file << "<PointData Normals=\"normal\">\n";
    data.declare("Float64", "normal", 3, mesh.normals);
    data.declare("Int64", "element", 1, mesh.elements);
    for (const MeshColumn& column : columns) {
        std::vector<double> values;
        for (std::size_t vertex = 0; vertex < mesh.info.n_vertices; ++vertex) {
            const auto first = mesh.values.begin() + static_cast<std::ptrdiff_t>(vertex * mesh.info.n_values + column.first);
            values.insert(values.end(), first, first + column.n_components);
        }
        data.declare("Float64", column.name, column.n_components, std::move(values));
    }
    file << "</PointData>\n<Points>\n";
    data.declare("Float64", "Points", 3, mesh.positions);
    file << "</Points>\n";
}

void declare_cells(PolyData& data, const extracted& mesh, std::ofstream& file) {
    const bool has_lines = mesh.info.n_lines > 0;
    const std::vector<std::uint32_t>& vertices = has_lines ? mesh.line_vertices : mesh.triangles;
    std::vector<std::int64_t> ends(has_lines ? mesh.info.n_lines : mesh.info.n_triangles);
    for (std::size_t cell = 0; cell < ends.size(); ++cell) {
        ends[cell] = static_cast<std::int64_t>(has_lines ? mesh.line_first[cell + 1] : 3 * (cell + 1));
    }
    file << "<CellData>\n";
    if (has_lines) {
        data.declare("Float64", "isovalue", 1, mesh.line_values);
    } else {
        data.declare("Int64", "element", 1, mesh.triangle_elements);
    }
    file << "</CellData>\n" << (has_lines ? "<Lines>\n" : "<Polys>\n");
    data.declare("Int64", "connectivity", 1, std::vector<std::int64_t>(vertices.begin(), vertices.end()));
    data.declare("Int64", "offsets", 1, std::move(ends));
    file << (has_lines ? "</Lines>\n" : "</Polys>\n");
}

} // namespace

void write_mesh_vtp(const extracted& mesh, const std::vector<MeshColumn>& columns, const std::string& path) {
    BinaryFile output(path);
    std::ofstream& file = output.stream();
    file << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
            "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<PolyData>\n<Piece NumberOfPoints=\""
         << mesh.info.n_vertices << "\" NumberOfLines=\"" << mesh.info.n_lines << "\" NumberOfPolys=\"" << mesh.info.n_triangles
         << "\">\n";
    PolyData data(file);
    declare_points(data, mesh, columns, file);
    declare_cells(data, mesh, file);
    file << "</Piece>\n</PolyData>\n";
    data.write_arrays();
    file << "</VTKFile>\n";
    output.commit();
}

} // namespace elvis::commands
