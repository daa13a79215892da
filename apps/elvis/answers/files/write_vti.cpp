#include "sample_files.hpp"

#include <core/base/error.hpp>
#include <core/base/output_file.hpp>
#include <core/base/xml_text.hpp>
#include <core/export/appended_data.hpp>

#include <fstream>
#include <sstream>

namespace elvis::commands {

namespace {

/** Where the text of an array says at which byte it begins. */
struct DeclaredArray {
    const NamedArray* array = nullptr;
    std::streampos offset_at;
};

std::vector<DeclaredArray> declare(std::ofstream& file, const SampleTable& table, const std::vector<NamedArray>& arrays) {
    const auto [nx, ny, nz] = *table.points.grid;
    std::ostringstream extent, origin, spacing;
    origin.precision(17);
    spacing.precision(17);
    extent << "0 " << nx - 1 << " 0 " << ny - 1 << " 0 " << nz - 1;
    origin << table.points.origin[0] << ' ' << table.points.origin[1] << ' ' << table.points.origin[2];
    spacing << table.points.spacing[0] << ' ' << table.points.spacing[1] << ' ' << table.points.spacing[2];
    file << "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
            "header_type=\"UInt64\" "
            "compressor=\"vtkZLibDataCompressor\">\n  <ImageData WholeExtent=\""
         << extent.str() << "\" Origin=\"" << origin.str() << "\" Spacing=\"" << spacing.str() << "\">\n    <Piece Extent=\""
         << extent.str() << "\">\n      <PointData>\n";
    std::vector<DeclaredArray> declared;
    for (const NamedArray& array : arrays) {
        std::size_t n_components = 1;
        for (std::size_t index = 1; index < array.shape.size(); ++index) {
            n_components *= array.shape[index];
        }
        file << "        <DataArray type=\"" << (array.is_integer() ? "Int64" : "Float64") << "\" Name=\""
             << xml_text(array.name) << "\" NumberOfComponents=\"" << n_components << "\" format=\"appended\" offset=\"";
        declared.push_back({&array, reserve_offset(file)});
        file << "\"/>\n";
    }
    file << "      </PointData>\n    </Piece>\n  </ImageData>\n  <AppendedData encoding=\"raw\">\n_";
    return declared;
}

} // namespace

void write_vti(const SampleTable& table, const std::string& path) {
    if (!table.points.is_axis_parallel) {
        throw UsageError(path, "holds grids along the axes (--grid); .csv, .h5 and .npz hold all else");
    }
    std::vector<NamedArray> arrays = arrays_of(table);
    arrays.erase(arrays.begin()); // The points follow from the grid.
    OutputFile output(path);
    std::ofstream file(output.temporary(), std::ios::binary);
    const std::vector<DeclaredArray> declared = declare(file, table, arrays);
    const std::streampos begin = file.tellp();
    for (const auto& [array, offset_at] : declared) {
        fill_offset(file, offset_at, begin);
        AppendedArray data(file, array->n_bytes());
        std::visit([&](const auto& numbers) { data.append(std::span(numbers)); }, array->numbers);
        data.finish();
    }
    file << "\n  </AppendedData>\n</VTKFile>\n";
    file.close();
    if (!file) {
        throw Error(path, "cannot be written");
    }
    output.commit();
}

} // namespace elvis::commands
