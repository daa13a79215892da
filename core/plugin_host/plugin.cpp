#include <core/base/error.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/table_copy.hpp>

#include <elvis/native/serve.hpp>

#include <boost/dll/shared_library.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

namespace elvis {

struct Plugin::Impl {
    std::filesystem::path path;
    boost::dll::shared_library library;
    std::string id, name, version, vendor, description;
    std::uint32_t abi_version = 0;
    std::optional<elvis_runtime> runtime;
    std::optional<elvis_converter> converter;
    std::optional<elvis_extrema> extrema;
    std::optional<elvis_apex_bounds> apex_bounds;
    std::vector<FileFormat> formats;
    std::optional<elvis_parts> parts;
};

namespace {

[[noreturn]] void refuse(const std::filesystem::path& library, const std::string& reason) {
    throw Error(library.string(), reason);
}

std::string required_text(const std::filesystem::path& library, const char* text, const char* member) {
    if (!text || !*text) {
        refuse(library, std::string("the descriptor has no ") + member);
    }
    return text;
}

bool is_reverse_domain(const std::string& id) {
    const bool characters = std::all_of(id.begin(), id.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
    });
    return characters && id.find('.') != std::string::npos && id.front() != '.' && id.back() != '.';
}

/** The functions that every volume has. */
const char* missing_volume_function(const elvis_runtime& table) {
    return !table.get_info          ? "get_info"
           : !table.get_class       ? "get_class"
           : !table.get_field       ? "get_field"
           : !table.get_class_field ? "get_class_field"
           : !table.get_time        ? "get_time"
           : !table.get_buffer      ? "get_buffer"
           : !table.get_snippet     ? "get_snippet"
           : !table.get_bounds      ? "get_bounds"
           : !table.fill_buffer     ? "fill_buffer"
                                    : nullptr;
}

/** The functions that every runtime plugin gives. */
const char* missing_function(const elvis_runtime& table) {
    return !table.probe ? "probe" : !table.open ? "open" : !table.close ? "close" : missing_volume_function(table);
}

const char* missing_function(const elvis_converter& table) {
    return !table.probe                           ? "probe"
           : !table.open                          ? "open"
           : !table.close                         ? "close"
           : !table.get_info                      ? "get_info"
           : !table.get_field                     ? "get_field"
           : !table.get_elements                  ? "get_elements"
           : !table.get_spaces                    ? "get_spaces"
           : !table.evaluate_mapping              ? "evaluate_mapping"
           : !table.sample && !table.sample_world ? "sample (or sample_world)"
                                                  : nullptr;
}

const char* missing_function(const elvis_extrema& table) { return table.get_field_extrema ? nullptr : "get_field_extrema"; }

const char* missing_function(const elvis_apex_bounds& table) {
    return table.get_field_apex_bounds ? nullptr : "get_field_apex_bounds";
}

const char* missing_function(const elvis_formats& table) {
    return table.n_formats == 0 || table.formats != nullptr ? nullptr : "formats";
}

const char* missing_function(const elvis_parts& table) {
    return !table.get_n_parts ? "get_n_parts" : !table.get_parts ? "get_parts" : nullptr;
}

template <class Table>
std::optional<Table> read_interface(const std::filesystem::path& library, const elvis_plugin_descriptor& descriptor,
                                    const char* id) {
    const auto* theirs = static_cast<const Table*>(descriptor.get_interface(id));
    if (!theirs) {
        return std::nullopt;
    }
    Table table = copy_known_part(*theirs);
    if (const char* missing = missing_function(table)) {
        refuse(library, std::string("interface ") + id + " lacks the required function " + missing);
    }
    return table;
}

std::vector<FileFormat> formats_of(const elvis_formats& table) {
    std::vector<FileFormat> formats;
    for (std::uint32_t index = 0; index < table.n_formats; ++index) {
        const elvis_file_format theirs = copy_entry(table.formats, index);
        if (theirs.name == nullptr) {
            continue;
        }
        std::istringstream endings(theirs.endings != nullptr ? theirs.endings : "");
        formats.push_back({theirs.name, {std::istream_iterator<std::string>(endings), {}}});
    }
    return formats;
}

} // namespace

Plugin::Plugin() : m_impl(std::make_unique<Impl>()) {}
Plugin::~Plugin() = default;

std::shared_ptr<const Plugin> Plugin::load(const std::filesystem::path& library) {
    std::shared_ptr<Plugin> plugin(new Plugin);
    Impl& impl = *plugin->m_impl;
    impl.path = library;
    try {
        impl.library.load(library.string(), boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local);
    } catch (const std::exception& error) {
        refuse(library, std::string("cannot be loaded: ") + error.what());
    }
    if (!impl.library.has(ELVIS_PLUGIN_ENTRY)) {
        refuse(library, std::string("does not export ") + ELVIS_PLUGIN_ENTRY);
    }
    const elvis_plugin_descriptor* theirs = impl.library.get<const elvis_plugin_descriptor*()>(ELVIS_PLUGIN_ENTRY)();
    if (!theirs) {
        refuse(library, "gives no descriptor: it cannot work on this machine");
    }
    // Size and version stand first, and are all that may be read before they are known to be good.
    if (theirs->struct_size < offsetof(elvis_plugin_descriptor, abi_version) + sizeof theirs->abi_version) {
        refuse(library, "its descriptor states an impossible size");
    }
    impl.abi_version = theirs->abi_version;
    if (impl.abi_version >> 16 != ELVIS_ABI_VERSION_MAJOR) {
        const bool is_newer = impl.abi_version > ELVIS_ABI_VERSION;
        refuse(library, "was made for version " + abi_version_text(impl.abi_version) +
                            " of the plugin interface; this program has " + abi_version_text(ELVIS_ABI_VERSION) +
                            ": the plugin needs " +
                            (is_newer ? "a later ElVis" : "to be compiled with the headers of this one"));
    }
    const elvis_plugin_descriptor descriptor = copy_known_part(*theirs);
    impl.id = required_text(library, descriptor.id, "id");
    impl.name = required_text(library, descriptor.name, "name");
    impl.version = required_text(library, descriptor.version, "version");
    impl.vendor = descriptor.vendor ? descriptor.vendor : "";
    impl.description = descriptor.description ? descriptor.description : "";
    if (!is_reverse_domain(impl.id)) {
        refuse(library, "its id '" + impl.id + "' is not in reverse-domain style (lower case, e.g. org.example.reader)");
    }
    if (!descriptor.get_interface) {
        refuse(library, "its descriptor has no get_interface");
    }
    impl.runtime = read_interface<elvis_runtime>(library, descriptor, ELVIS_RUNTIME_INTERFACE);
    impl.converter = read_interface<elvis_converter>(library, descriptor, ELVIS_CONVERTER_INTERFACE);
    impl.extrema = read_interface<elvis_extrema>(library, descriptor, ELVIS_EXTREMA_INTERFACE);
    impl.apex_bounds = read_interface<elvis_apex_bounds>(library, descriptor, ELVIS_APEX_BOUNDS_INTERFACE);
    impl.parts = read_interface<elvis_parts>(library, descriptor, ELVIS_PARTS_INTERFACE);
    if (const auto formats = read_interface<elvis_formats>(library, descriptor, ELVIS_FORMATS_INTERFACE)) {
        impl.formats = formats_of(*formats);
    }
    if (!impl.runtime && !impl.converter) {
        refuse(library, "offers neither " ELVIS_RUNTIME_INTERFACE " nor " ELVIS_CONVERTER_INTERFACE);
    }
    return plugin;
}

std::shared_ptr<const Plugin> Plugin::of_program(const elvis_runtime& runtime, std::string id,
                                                 const elvis_apex_bounds* apex_bounds) {
    std::shared_ptr<Plugin> plugin(new Plugin);
    Impl& impl = *plugin->m_impl;
    impl.abi_version = ELVIS_ABI_VERSION;
    impl.name = id;
    impl.id = std::move(id);
    impl.runtime = copy_known_part(runtime);
    if (const char* missing = missing_volume_function(*impl.runtime)) {
        throw Error(impl.id, std::string("the table ") + ELVIS_RUNTIME_INTERFACE + " lacks the required function " + missing);
    }
    if (apex_bounds != nullptr) {
        impl.apex_bounds = copy_known_part(*apex_bounds);
    }
    return plugin;
}

std::shared_ptr<const Plugin> Plugin::of_native(std::string id) {
    std::shared_ptr<Plugin> plugin(new Plugin);
    Impl& impl = *plugin->m_impl;
    impl.abi_version = ELVIS_ABI_VERSION;
    impl.name = id;
    impl.id = std::move(id);
    impl.runtime = *native::runtime_table();
    impl.extrema = *native::extrema_table();
    impl.apex_bounds = *native::apex_bounds_table();
    return plugin;
}

std::shared_ptr<const Plugin> Plugin::of_mesh(const elvis_converter& converter, std::string id) {
    std::shared_ptr<Plugin> plugin(new Plugin);
    plugin->m_impl->abi_version = ELVIS_ABI_VERSION;
    plugin->m_impl->name = id;
    plugin->m_impl->id = std::move(id);
    plugin->m_impl->converter = converter;
    return plugin;
}

const std::filesystem::path& Plugin::library() const { return m_impl->path; }
const std::string& Plugin::id() const { return m_impl->id; }
const std::string& Plugin::name() const { return m_impl->name; }
const std::string& Plugin::version() const { return m_impl->version; }
const std::string& Plugin::vendor() const { return m_impl->vendor; }
const std::string& Plugin::description() const { return m_impl->description; }
std::uint32_t Plugin::abi_version() const { return m_impl->abi_version; }
const std::vector<FileFormat>& Plugin::formats() const { return m_impl->formats; }
const elvis_runtime* Plugin::runtime() const { return m_impl->runtime ? &*m_impl->runtime : nullptr; }
const elvis_converter* Plugin::converter() const { return m_impl->converter ? &*m_impl->converter : nullptr; }
const elvis_extrema* Plugin::extrema() const { return m_impl->extrema ? &*m_impl->extrema : nullptr; }
const elvis_parts* Plugin::parts() const { return m_impl->parts ? &*m_impl->parts : nullptr; }
const elvis_apex_bounds* Plugin::apex_bounds() const { return m_impl->apex_bounds ? &*m_impl->apex_bounds : nullptr; }

std::string abi_version_text(std::uint32_t version) {
    return std::to_string(version >> 16) + "." + std::to_string(version & 0xffffu);
}

} // namespace elvis
