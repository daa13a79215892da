/**
 * @file plugin.h
 * The one symbol that a plugin library exports, and the descriptor it returns.
 *
 * Since 1.0.
 */
#ifndef ELVIS_PLUGIN_H
#define ELVIS_PLUGIN_H

#include "abi.h"

/**
 * Describes a plugin. Static data of the library: valid while the library is loaded, never changing.
 */
typedef struct elvis_plugin_descriptor {
    uint32_t struct_size;
    /** ELVIS_ABI_VERSION that the plugin was compiled with. The host refuses another major version. */
    uint32_t abi_version;
    /** Unique, reverse-domain style, lower case, e.g. "org.nektar.elvis-reader". Required. */
    elvis_string id;
    /** For people, e.g. "Nektar++ reader". Required. */
    elvis_string name;
    /** Version of the plugin itself, e.g. "1.2.0". Required. */
    elvis_string version;
    /** May be NULL. */
    elvis_string vendor;
    /** One sentence. May be NULL. */
    elvis_string description;

    /**
     * The table of one interface, or NULL if the plugin does not offer it. The id names the table's type and revision:
     * ELVIS_RUNTIME_INTERFACE -> elvis_runtime, ELVIS_CONVERTER_INTERFACE -> elvis_converter.
     * Static data, like the descriptor. Any thread. Must not have side effects.
     */
    const void* (*get_interface)(const char* interface_id);
} elvis_plugin_descriptor;

/** Name of the exported symbol. */
#define ELVIS_PLUGIN_ENTRY "elvis_plugin_get_descriptor"

/**
 * The exported function. Called once after loading, from any thread; must be quick and touch no file.
 * Returns NULL if the plugin cannot work on this machine.
 */
ELVIS_EXTERN_C ELVIS_EXPORT const elvis_plugin_descriptor* elvis_plugin_get_descriptor(void);

#endif
