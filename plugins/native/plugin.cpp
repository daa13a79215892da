/*
 * The runtime plugin of native volumes: what ElVis::native serves.
 */
#include <elvis/native/serve.hpp>
#include <elvis/plugin.hpp>

namespace {

constexpr elvis_file_format formats[] = {elvis::api::file_format("Native volume", ".h5")};
constexpr elvis_formats formats_table = elvis::api::formats_table(formats);

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.native", .name = "Native volume", .version = "0.1.0", .vendor = "ElVis",
             .description = "Serves ElVis's own HDF5 volumes for rendering.", .runtime = elvis::native::runtime_table(),
             .extrema = elvis::native::extrema_table(), .apex_bounds = elvis::native::apex_bounds_table(),
             .formats = &formats_table);
