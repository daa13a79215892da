/**
 * @file plugin.cpp
 * Nektar++ meshes and fields, drawn as they are (runtime/) or converted (converter/).
 */
#include "converter/source.hpp"
#include "runtime/direct_volume.hpp"

#include <elvis/plugin.hpp>

namespace {

constexpr elvis_file_format formats[] = {elvis::api::file_format("Nektar++ session or mesh", ".xml"),
                                         elvis::api::file_format("Nektar++ field, after its mesh", ".fld .chk .rst")};
constexpr elvis_formats formats_table = elvis::api::formats_table(formats);

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.nektarpp", .name = "Nektar++ reader", .version = "1.2.0", .vendor = "ElVis",
             .description = "Draws and converts Nektar++ meshes (.xml) and fields (.fld, .chk): all shapes, curved and "
                            "mixed-order elements, partitioned directories.",
             .runtime = nektarpp::runtime_interface(), .converter = nektarpp::converter_interface(),
             .extrema = nektarpp::extrema_interface(), .apex_bounds = nektarpp::apex_bounds_interface(),
             .formats = &formats_table, .parts = nektarpp::parts_interface());
