#include "grid_fields.hpp"

#include <algorithm>
#include <set>

namespace elvis_vtk {

namespace {

/** Names of arrays in the service of the format, and none. */
std::set<std::string> reserved_names(const Piece& piece, Section section) {
    std::set<std::string> names{"vtkGhostType", "vtkGhostLevels", ""};
    for (const char* attribute : {"RationalWeights", "HigherOrderDegrees", "GlobalIds", "PedigreeIds", "ProcessIds"}) {
        names.insert(piece.named_by(section, attribute));
    }
    return names;
}

} // namespace

void add_fields(const Piece& piece, Section section, Grid& grid, const elvis::api::Host& host) {
    std::vector<FieldArray>& known = section == Section::point_data ? grid.point_arrays : grid.cell_arrays;
    std::set<std::string> seen = reserved_names(piece, section);
    std::vector<std::string> present;
    for (const FieldArray& array : piece.arrays(section)) {
        if (!seen.insert(array.name).second) {
            continue;
        }
        const auto found = std::ranges::find(known, array.name, &FieldArray::name);
        if (found == known.end()) {
            if (grid.n_pieces > 1) {
                host.log(ELVIS_LOG_WARNING, piece.path() + ": field '" + array.name + "' is not in all pieces; left out");
                continue;
            }
            known.push_back(array);
        } else if (array.n_components != found->n_components) {
            piece.fail(section, "array '" + array.name + "' has " + std::to_string(array.n_components) +
                                    " components, in another piece " + std::to_string(found->n_components));
        }
        present.push_back(array.name);
        grid.mantissa_bits = std::min(grid.mantissa_bits, piece.mantissa_bits(section, array));
    }
    std::erase_if(known, [&](const FieldArray& array) {
        const bool is_missing = std::ranges::find(present, array.name) == present.end();
        if (is_missing) {
            host.log(ELVIS_LOG_WARNING,
                     piece.path() + ": has no field '" + array.name + "', which other pieces have; left out");
        }
        return is_missing;
    });
}

} // namespace elvis_vtk
