/*
 * The runtime plugin of native volumes: what ElVis::native serves.
 */
#include <elvis/native/serve.hpp>
#include <elvis/plugin.hpp>

ELVIS_PLUGIN(.id = "org.elvis.native", .name = "Native volume", .version = "0.1.0", .vendor = "ElVis",
             .description = "Serves ElVis's own HDF5 volumes for rendering.", .runtime = elvis::native::runtime_table(),
             .extrema = elvis::native::extrema_table(), .apex_bounds = elvis::native::apex_bounds_table());
