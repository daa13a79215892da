/*
 * A library whose debug information holds every type that crosses the boundary, for abidiff.
 */
#include <elvis/converter.h>
#include <elvis/plugin.h>
#include <elvis/runtime.h>

/** All structs and tables, as parameters: types that no function mentions are left out of the comparison. */
ELVIS_EXPORT void elvis_abi_surface(const elvis_plugin_descriptor* descriptor, const elvis_host* host,
                                    const elvis_runtime* runtime, const elvis_converter* converter, const elvis_text* text,
                                    const elvis_constant* constant);

void elvis_abi_surface(const elvis_plugin_descriptor* descriptor, const elvis_host* host, const elvis_runtime* runtime,
                       const elvis_converter* converter, const elvis_text* text, const elvis_constant* constant) {
    (void)descriptor;
    (void)host;
    (void)runtime;
    (void)converter;
    (void)text;
    (void)constant;
}
