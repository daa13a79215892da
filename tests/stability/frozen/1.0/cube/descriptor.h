/*
 * Exports a descriptor with a runtime table, a converter table, or both (else NULL).
 */
#ifndef FIXTURE_DESCRIPTOR_H
#define FIXTURE_DESCRIPTOR_H

#include <elvis/converter.h>
#include <elvis/plugin.h>
#include <elvis/runtime.h>

#include <string.h>

#define FIXTURE_PLUGIN(plugin_id, abi, runtime_table, converter_table)                                                         \
    static const void* get_interface(const char* interface_id) {                                                               \
        return strcmp(interface_id, ELVIS_RUNTIME_INTERFACE) == 0     ? (const void*)(runtime_table)                           \
               : strcmp(interface_id, ELVIS_CONVERTER_INTERFACE) == 0 ? (const void*)(converter_table)                         \
                                                                      : NULL;                                                  \
    }                                                                                                                          \
    const elvis_plugin_descriptor* elvis_plugin_get_descriptor(void) {                                                         \
        static const elvis_plugin_descriptor descriptor = {sizeof descriptor, (abi), (plugin_id), "Fixture",                   \
                                                           "1.2.3",           NULL,  NULL,        get_interface};              \
        return &descriptor;                                                                                                    \
    }

#endif
