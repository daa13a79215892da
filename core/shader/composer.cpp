#include <core/shader/composer.hpp>

#include <core/base/error.hpp>
#include <core/shader/compiler.hpp>
#include <core/shader/fetch.hpp>
#include <core/shader/glsl_scan.hpp>
#include <core/shader/includes.hpp>
#include <core/shader/index_checks.hpp>
#include <core/shader/poison.hpp>
#include <core/shader/request_records.hpp>
#include <core/shader/snippet_check.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

namespace elvis {

namespace {

/** Included once, before everything else. */
constexpr std::array<std::string_view, 2> common_files{"arithmetic/types.glsl", "arithmetic/math.glsl"};

/** A library file that gives an instance a function which its snippet lacks. */
struct DefaultFile {
    std::uint32_t capability;
    const char* path;
};

/** In the order in which they may rest on each other. */
constexpr std::array<DefaultFile, 4> default_files{
    DefaultFile{ELVIS_SNIPPET_MAPPING_JACOBIAN, "element/mapping_jacobian_default.glsl"},
    DefaultFile{ELVIS_SNIPPET_FIELD_GRADIENT, "field/gradient_default.glsl"},
    DefaultFile{ELVIS_SNIPPET_FIELD_HESSIAN, "field/field_hessian_default.glsl"},
    DefaultFile{ELVIS_SNIPPET_MAPPING_HESSIAN, "element/mapping_hessian_default.glsl"},
};

constexpr std::array<std::pair<const char*, std::uint32_t>, 8> capability_macros{
    std::pair{"ELVIS_HAS_FIELD_GRADIENT", ELVIS_SNIPPET_FIELD_GRADIENT},
    std::pair{"ELVIS_HAS_MAPPING_JACOBIAN", ELVIS_SNIPPET_MAPPING_JACOBIAN},
    std::pair{"ELVIS_HAS_INVERSE_MAPPING", ELVIS_SNIPPET_INVERSE_MAPPING},
    std::pair{"ELVIS_HAS_FIELD_OFFSET", ELVIS_SNIPPET_FIELD_OFFSET},
    std::pair{"ELVIS_HAS_LOCAL_ORIGIN", ELVIS_SNIPPET_LOCAL_ORIGIN},
    std::pair{"ELVIS_HAS_FIELD_HESSIAN", ELVIS_SNIPPET_FIELD_HESSIAN},
    std::pair{"ELVIS_HAS_MAPPING_HESSIAN", ELVIS_SNIPPET_MAPPING_HESSIAN},
    std::pair{"ELVIS_HAS_INSIDE", ELVIS_SNIPPET_INSIDE},
};

std::string define(const std::string& name, const std::string& value) { return "#define " + name + " " + value + "\n"; }
std::string undef(const std::string& name) { return "#undef " + name + "\n"; }

/** An integer as GLSL writes it, in 32 bits. */
std::string integer_literal(const std::string& name, std::int64_t value) {
    if (value < std::numeric_limits<std::int32_t>::min() || value > std::numeric_limits<std::uint32_t>::max()) {
        throw Error("constant " + name, std::to_string(value) + " does not fit into the 32 bits of a GLSL integer");
    }
    std::string text = value < 0 ? "(" : "";
    text += std::to_string(value);
    text += value < 0 ? ")" : value > std::numeric_limits<std::int32_t>::max() ? "u" : "";
    return text;
}

std::string suffix(std::size_t instance) {
    return instance == 0 ? std::string() : std::string("_").append(std::to_string(instance));
}

std::string header(const KernelRequest& request) {
    // Extensions must be named before the first declaration, so the kernel cannot ask for them itself. GL_GOOGLE_...: see
    // expand_includes.
    std::string text = "#version 460\n";
    for (const char* extension :
         {"GL_GOOGLE_cpp_style_line_directive", "GL_EXT_control_flow_attributes", "GL_KHR_shader_subgroup_basic",
          "GL_KHR_shader_subgroup_vote", "GL_KHR_shader_subgroup_ballot", "GL_KHR_shader_subgroup_arithmetic"}) {
        text += std::string("#extension ") + extension + " : enable\n";
    }
    text += define("ELVIS_GLSL_VERSION", std::to_string(ELVIS_ABI_VERSION));
    text += define("ELVIS_REAL_IS_DOUBLE", request.precision == Precision::float64 ? "1" : "0");
    text += define("ELVIS_N_INSTANCES", std::to_string(request.instances.size()));
    text += define("ELVIS_WANTS_HESSIANS", request.with_second_derivatives ? "1" : "0");
    for (const auto& [name, value] : request.defines) {
        text += define(name, value);
    }
    return text;
}

bool is_common(std::string_view name) {
    return std::find(common_files.begin(), common_files.end(), name) != common_files.end();
}

/** Files by name: a snippet's own sources, then the library, of which the common files are already there. */
IncludeResolver resolver(const Snippet& snippet) {
    return [&snippet](std::string_view name) -> std::string_view {
        for (const SnippetText& source : snippet.sources) {
            if (source.name == name) {
                return source.text;
            }
        }
        return is_common(name) ? std::string_view{} : shader_source(name);
    };
}

/** The text of one instance and what its names need. */
class InstanceWriter {
public:
    InstanceWriter(const KernelRequest& request, std::size_t index, const RequestRecords& records)
        : m_instance(request.instances[index]), m_host_buffers(request.buffers), m_suffix(suffix(index)),
          m_is_debug_build(request.is_debug_build), m_records(records) {
        const Snippet& snippet = m_instance.snippet;
        check_snippet(snippet);
        m_snippet_text = expand_includes(snippet.sources.front().text, snippet.sources.front().name, resolver(snippet));
        m_snippet_names = scan_glsl(m_snippet_text);
        if (m_is_debug_build) {
            m_snippet_text = check_indices(poison_outputs(m_snippet_text, m_snippet_names));
        }
        std::string defaults = "#include \"element/reference_shape.glsl\"\n";
        constexpr std::uint32_t second_derivatives = ELVIS_SNIPPET_FIELD_HESSIAN | ELVIS_SNIPPET_MAPPING_HESSIAN;
        const std::uint32_t unwanted = request.with_second_derivatives ? 0 : second_derivatives;
        for (const DefaultFile& file : default_files) {
            if (((snippet.capabilities | unwanted) & file.capability) == 0) {
                defaults += std::string("#include \"") + file.path + "\"\n";
            }
        }
        m_default_text = expand_includes(defaults, "(defaults)", resolver(snippet));
        m_default_names = scan_glsl(m_default_text);
    }

    /** Macros that a later instance or the kernel must not find defined by this one's snippet. */
    std::string undef_macros() const { return undef_macros(m_snippet_names) + undef_macros(m_default_names); }

    std::string write() const {
        std::string text = "#line 1 \"(generated)\"\n" + class_macros();
        const std::vector<std::string> renamed = renamed_names();
        for (const std::string& name : renamed) {
            text += define(name, name + m_suffix);
        }
        text += origin_function() + buffer_macros();
        for (const auto& [name, value] : m_instance.constants) {
            text += define(name, integer_literal(name, value));
        }
        text += m_snippet_text + m_default_text + "#line 1 \"(generated)\"\n" + undef_macros(m_snippet_names);
        for (const auto& constant : m_instance.constants) {
            text += undef(constant.first);
        }
        text += restore_buffer_macros();
        for (const std::string& name : renamed) {
            text += undef(name);
        }
        return text;
    }

private:
    static std::string undef_macros(const GlslNames& names) {
        std::string text;
        for (const GlslDefinition& definition : names.definitions) {
            if (definition.kind == GlslDefinition::Kind::macro) {
                text += undef(definition.name);
            }
        }
        return text;
    }

    /** The shape and capabilities, under their own names for the text that follows and with the suffix for the kernel. */
    std::string class_macros() const {
        std::vector<std::pair<std::string, std::string>> macros{
            {"ELVIS_SHAPE", std::to_string(m_instance.shape)},
            {"ELVIS_N_COMPONENTS", std::to_string(m_instance.n_components)},
        };
        for (const auto& [name, capability] : capability_macros) {
            macros.emplace_back(name, (m_instance.snippet.capabilities & capability) != 0 ? "1" : "0");
        }
        std::string text;
        for (const auto& [name, value] : macros) {
            text += undef(name) + define(name, value);
            if (!m_suffix.empty()) {
                text += define(name + m_suffix, value);
            }
        }
        return text;
    }

    /** What instances after the first call otherwise: the interface, the snippet's own names, those of the default functions.
     */
    std::vector<std::string> renamed_names() const {
        std::vector<std::string> names;
        if (m_suffix.empty()) {
            return names;
        }
        std::set<std::string> kept;
        for (const auto& constant : m_instance.constants) {
            kept.insert(constant.first);
        }
        for (const GlslNames* scanned : {&m_snippet_names, &m_default_names}) {
            for (const GlslDefinition& definition : scanned->definitions) {
                if (definition.kind == GlslDefinition::Kind::macro) {
                    kept.insert(definition.name);
                }
            }
        }
        names.emplace_back("elvis_origin");
        for (const SnippetFunction& function : snippet_functions()) {
            names.emplace_back(function.name);
        }
        const std::string prefix = m_instance.snippet.prefix + "_";
        for (const std::string& name : m_snippet_names.identifiers) {
            if (name.compare(0, prefix.size(), prefix) == 0) {
                names.push_back(name);
            }
        }
        // Beyond the prefix, a snippet's text defines what library files it includes define.
        for (const GlslNames* scanned : {&m_snippet_names, &m_default_names}) {
            for (const GlslDefinition& definition : scanned->definitions) {
                names.push_back(definition.name);
            }
        }
        std::sort(names.begin(), names.end());
        names.erase(std::unique(names.begin(), names.end()), names.end());
        names.erase(std::remove_if(names.begin(), names.end(), [&](const std::string& name) { return kept.count(name) != 0; }),
                    names.end());
        return names;
    }

    std::string origin_function() const {
        std::string value = "elvis_vec3(0)";
        if (m_instance.origins != nullptr) {
            value = "elvis_vec3(core_row_" + std::to_string(m_records.number(m_instance.origins)) + "(element, 0u).xyz)";
        }
        return "elvis_vec3 elvis_origin(uint element) { return " + value + "; }\n";
    }

    const FetchBuffer* host_buffer(const std::string& name) const {
        const auto found = std::find_if(m_host_buffers.begin(), m_host_buffers.end(),
                                        [&](const FetchBuffer& buffer) { return buffer.name == name; });
        return found == m_host_buffers.end() ? nullptr : &*found;
    }

    std::string buffer_macros() const {
        std::string text;
        for (const FetchBuffer& buffer : m_instance.buffers) {
            text += fetch_undefs(buffer.name) +
                    fetch_macros(buffer.name, *buffer.records, m_records.number(buffer.records), m_is_debug_build);
        }
        return text;
    }

    /** Takes the instance's buffers away again; a buffer of the host of the same name comes back. */
    std::string restore_buffer_macros() const {
        std::string text;
        for (const FetchBuffer& buffer : m_instance.buffers) {
            text += fetch_undefs(buffer.name);
            if (const FetchBuffer* host = host_buffer(buffer.name)) {
                text += fetch_macros(host->name, *host->records, m_records.number(host->records), m_is_debug_build);
            }
        }
        return text;
    }

    const SnippetInstance& m_instance;
    const std::vector<FetchBuffer>& m_host_buffers;
    std::string m_suffix;
    bool m_is_debug_build;
    const RequestRecords& m_records;
    std::string m_snippet_text;
    GlslNames m_snippet_names;
    std::string m_default_text;
    GlslNames m_default_names;
};

std::string instances_text(const KernelRequest& request, const RequestRecords& records) {
    std::vector<InstanceWriter> writers;
    for (std::size_t index = 0; index < request.instances.size(); ++index) {
        writers.emplace_back(request, index, records);
    }
    // The first instance comes last: what library files define for it, guards included, is what the kernel finds.
    std::string text;
    for (std::size_t index = writers.size(); index-- > 0;) {
        text += writers[index].write();
        if (index > 0) {
            text += writers[index].undef_macros();
        }
    }
    return text;
}

std::string compose(const Device* device, const KernelRequest& request, const RequestRecords& records) {
    assert(device || records.all().empty());
    std::string text = header(request) + define("CORE_READS_TEXELS", device && device->uses_texel_buffers() ? "1" : "0");
    for (const std::string_view file : common_files) {
        text += expand_includes(shader_source(file), std::string(file), shader_source);
    }
    text += "#line 1 \"(generated)\"\n";
    if (std::any_of(records.all().begin(), records.all().end(), [](const RecordBuffer* buffer) {
            return buffer->kind() == RecordKind::real && buffer->precision() == Precision::float64;
        })) {
        text += fetch_helpers();
    }
    auto binding = static_cast<std::uint32_t>(request.bindings.size());
    for (std::uint32_t number = 0; number < records.all().size(); ++number) {
        text += fetch_functions(*device, *records.all()[number], number, binding);
        binding += records.all()[number]->n_parts();
    }
    for (const FetchBuffer& buffer : request.buffers) {
        text += fetch_macros(buffer.name, *buffer.records, records.number(buffer.records), request.is_debug_build);
    }
    if (request.is_debug_build) {
        text += std::string(poison_declarations) + index_declarations;
    }
    text += instances_text(request, records);
    text += expand_includes(request.text, "(" + request.name + ")", shader_source);
    const std::string_view kernel = request.kernel_text.empty() ? shader_source(request.kernel) : request.kernel_text;
    if (!request.watches_loops) {
        return text + expand_includes(kernel, request.kernel, shader_source);
    }
    constexpr const char* watched_main = "arithmetic/watched_main.glsl";
    return text + "#define main core_kernel_main\n" + expand_includes(kernel, request.kernel, shader_source) +
           "\n#undef main\n" + "#define CORE_WATCH_BINDING " + std::to_string(records.watch_binding()) + "\n" +
           expand_includes(shader_source(watched_main), watched_main, shader_source);
}

} // namespace

std::string compose_text(const Device& device, const KernelRequest& request) {
    return compose(&device, request, RequestRecords(request));
}

std::string compose_text(const KernelRequest& request) { return compose(nullptr, request, RequestRecords(request)); }

} // namespace elvis
