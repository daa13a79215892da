/**
 * @file library_checks.cpp
 * Checks of a library by itself: descriptor, tables, and what `probe` says to files that are not the plugin's.
 */
#include <core/base/error.hpp>
#include <core/base/temporary_folder.hpp>
#include <core/conformance/check.hpp>
#include <core/conformance/random.hpp>
#include <core/conformance/test_host.hpp>

#include <dlfcn.h>

#include <chrono>
#include <cstring>

namespace elvis::conformance {

namespace {

/** The descriptor as the library gives it, without Plugin's copy. */
const elvis_plugin_descriptor* raw_descriptor(const std::string& library) {
    void* handle = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle) {
        return nullptr;
    }
    using Entry = const elvis_plugin_descriptor* (*)();
    const auto entry = reinterpret_cast<Entry>(::dlsym(handle, ELVIS_PLUGIN_ENTRY));
    return entry ? entry() : nullptr; // The library stays loaded to the end of the process.
}

void check_descriptor(Context& context) {
    std::shared_ptr<const Plugin> plugin;
    try {
        plugin = Plugin::load(context.subject().library);
    } catch (const Error& error) {
        context.fail(error.cause());
        return;
    }
    context.note(plugin->id() + " " + plugin->version() + ", interface " + abi_version_text(plugin->abi_version()));
    const elvis_plugin_descriptor* first = raw_descriptor(context.subject().library);
    const elvis_plugin_descriptor* second = raw_descriptor(context.subject().library);
    if (first != second || !first) {
        context.fail("the entry point returns another descriptor at every call; it must be static data");
        return;
    }
    if (first->struct_size < sizeof(elvis_plugin_descriptor) || first->struct_size > 65536) {
        context.fail("struct_size of the descriptor is " + std::to_string(first->struct_size) + "; set it to sizeof");
    }
    for (const char* id : {ELVIS_RUNTIME_INTERFACE, ELVIS_CONVERTER_INTERFACE}) {
        if (first->get_interface(id) != first->get_interface(id)) {
            context.fail(std::string("get_interface(\"") + id + "\") returns another table at every call");
        }
    }
    for (const char* id : {"elvis.runtime/999", "org.example.unheard-of/1", ""}) {
        if (first->get_interface(id)) {
            context.fail(std::string("get_interface(\"") + id + "\") must be NULL: that is how later interfaces arrive");
        }
    }
}

void check_tables(Context& context) {
    const Plugin& plugin = *context.plugin();
    const elvis_plugin_descriptor* descriptor = raw_descriptor(context.subject().library);
    const auto check_size = [&](const char* id, std::size_t size) {
        const void* table = descriptor->get_interface(id);
        std::uint32_t stated = 0;
        if (table) {
            std::memcpy(&stated, table, sizeof stated);
            if (stated > 65536 || stated % alignof(void*) != 0) {
                context.fail(std::string("the table of ") + id + " states the size " + std::to_string(stated) + " (here " +
                             std::to_string(size) + "); set struct_size to sizeof");
            }
        }
    };
    check_size(ELVIS_RUNTIME_INTERFACE, sizeof(elvis_runtime));
    check_size(ELVIS_CONVERTER_INTERFACE, sizeof(elvis_converter));
    if (const elvis_runtime* table = plugin.runtime()) {
        if (!table->evaluate_mapping != !table->evaluate_field) {
            context.fail("evaluate_mapping and evaluate_field are of use together only: give both or neither");
        }
        std::string given;
        const auto list = [&](const void* function, const char* name) { given += function ? std::string(" ") + name : ""; };
        list(reinterpret_cast<const void*>(table->get_element_numbers), "get_element_numbers");
        list(reinterpret_cast<const void*>(table->get_faces), "get_faces");
        list(reinterpret_cast<const void*>(table->get_boundary_group), "get_boundary_group");
        list(reinterpret_cast<const void*>(table->get_field_ranges), "get_field_ranges");
        list(reinterpret_cast<const void*>(table->get_note), "get_note");
        list(reinterpret_cast<const void*>(table->evaluate_mapping), "evaluate_mapping");
        list(reinterpret_cast<const void*>(table->evaluate_field), "evaluate_field");
        list(reinterpret_cast<const void*>(table->get_field_derivative_bounds), "get_field_derivative_bounds");
        list(reinterpret_cast<const void*>(table->check_jacobians), "check_jacobians");
        context.note("runtime, optional functions:" + (given.empty() ? std::string(" none") : given));
    }
}

void probe_files(Context& context, Interface interface, elvis_result (*probe)(const elvis_host*, const char*, std::uint32_t*)) {
    const TemporaryFolder scratch;
    const std::vector<std::pair<const char*, std::string>> files{
        {"a file that does not exist", scratch.path("missing.bin")},
        {"an empty file", scratch.write("empty.bin", "")},
        {"a folder", scratch.path("")},
        {"random bytes", scratch.write("random.bin", random_bytes(4096, context.subject().seed))},
        {"a line of text", scratch.write("a b.txt", "This is no volume.\n")},
        {"one very long line", scratch.write("long.txt", std::string(1u << 20, 'x'))},
    };
    for (const auto& [what, path] : files) {
        context.progress(std::string("probe of ") + what);
        TestHost host;
        std::uint32_t confidence = 77;
        const auto begin = std::chrono::steady_clock::now();
        const elvis_result result = probe(host.table(), path.c_str(), &confidence);
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
        const std::string where = std::string(interface_name(interface)) + ": probe of " + what;
        if (result != ELVIS_OK) {
            context.fail(where + " returned " + result_name(result) + "; a file that is not yours is confidence 0, no error");
        } else if (confidence != 0) {
            context.fail(where + " answered " + std::to_string(confidence) + " instead of 0");
        }
        if (seconds.count() > 0.5) {
            context.fail(where + " took " + std::to_string(seconds.count()) + " s; it has milliseconds");
        }
    }
}

void check_probe(Context& context) {
    if (const elvis_runtime* table = context.plugin()->runtime()) {
        probe_files(context, Interface::runtime, table->probe);
    }
    if (const elvis_converter* table = context.plugin()->converter()) {
        probe_files(context, Interface::converter, table->probe);
    }
}

void check_own_file(Context& context) {
    context.need_files();
    if (!context.claims_runtime() && !context.claims_source()) {
        context.fail("no interface's probe claims " + context.subject().files.front() + ", the volume it is checked with");
    }
}

} // namespace

std::vector<Check> library_checks() {
    return {
        {"descriptor", "the library loads; its descriptor and interfaces are complete, static, and of this major version",
         check_descriptor},
        {"tables", "interface tables state their size, and functions that belong together are there together", check_tables},
        {"probe-foreign", "probe answers 0 at once for files that are missing, empty or another program's", check_probe},
        {"probe-own", "probe claims the volume that the plugin is checked with", check_own_file},
    };
}

} // namespace elvis::conformance
