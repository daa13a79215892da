#include <core/base/error.hpp>
#include <core/shader/compiler.hpp>
#include <core/shader/composer.hpp>
#include <core/shader/fetch.hpp>
#include <core/shader/include.hpp>
#include <core/shader/tokens.hpp>

#include <cassert>
#include <set>

namespace elvis {

namespace {

/** Functions of the GLSL interface (plugin_api/glsl_interface.md) with their signatures. */
struct InterfaceFunction {
    const char* name;
    const char* signature;
};

constexpr InterfaceFunction required_functions[] = {
    {"elvis_mapping", "elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi)"},
    {"elvis_jacobian", "elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi)"},
    {"elvis_field_value", "elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component)"},
};

constexpr const char* optional_functions[] = {"elvis_mapping_jacobian", "elvis_field_gradient", "elvis_inverse_mapping",
                                              "elvis_origin"};

constexpr const char* mapping_jacobian_default = R"(
void elvis_mapping_jacobian(uint element, elvis_vec3 xi, out elvis_vec3 x, out elvis_mat3 jacobian) {
    x = elvis_mapping(element, xi);
    jacobian = elvis_jacobian(element, xi);
}
)";

std::string define(const std::string& name, const std::string& value) { return "#define " + name + " " + value + "\n"; }

/** Builds the text of one request, and knows what is bound where. */
class Composition {
public:
    Composition(const Device& device, const KernelRequest& request) : m_device(device), m_request(request) {
        m_layout = request.bindings;
        m_next_binding = static_cast<std::uint32_t>(request.bindings.size());
        write_header();
        for (const FetchBuffer& buffer : request.buffers) {
            write_buffer(buffer);
        }
        // The first instance comes last and stays visible under plain names to the kernel, with its constants.
        for (std::size_t index = request.instances.size(); index-- > 0;) {
            write_instance(request.instances[index], index);
        }
        m_text += "#include \"" + request.kernel + "\"\n";
    }

    const std::string& text() const { return m_text; }
    const std::vector<BindingLayout>& layout() const { return m_layout; }
    const std::vector<BoundBuffer>& records() const { return m_records; }

private:
    void write_header();
    std::string declare(const RecordBuffer& records);
    void write_buffer(const FetchBuffer& buffer);
    void write_instance(const SnippetInstance& instance, std::size_t index);

    const Device& m_device;
    const KernelRequest& m_request;
    std::string m_text;
    std::vector<BindingLayout> m_layout;
    std::vector<BoundBuffer> m_records;
    std::uint32_t m_next_binding = 0;
    std::uint32_t m_next_name = 0;
};

void Composition::write_header() {
    m_text = "#version 460\n"
             "#extension GL_GOOGLE_cpp_style_line_directive : require\n"
             "#extension GL_KHR_shader_subgroup_basic : require\n"
             "#extension GL_KHR_shader_subgroup_arithmetic : require\n";
    m_text += define("ELVIS_REAL_IS_DOUBLE", m_request.precision == Precision::float64 ? "1" : "0");
    for (const auto& [name, value] : m_request.defines) {
        m_text += define(name, value);
    }
    m_text += "#include \"library/types.glsl\"\n#include \"library/math.glsl\"\n";
    m_text += "#line 1 \"composition of " + m_request.name + "\"\n";
    m_text += "dvec2 core_unpack(uvec4 words) { return dvec2(packDouble2x32(words.xy), packDouble2x32(words.zw)); }\n";
}

/** Declares a record buffer under a name of its own, which is returned. */
std::string Composition::declare(const RecordBuffer& records) {
    const std::string name = "core_records" + std::to_string(m_next_name++);
    FetchCode code = fetch_code(m_device, records, name, m_next_binding);
    m_next_binding += records.n_parts();
    m_text += code.text;
    m_layout.insert(m_layout.end(), code.layout.begin(), code.layout.end());
    m_records.insert(m_records.end(), code.bound.begin(), code.bound.end());
    return name;
}

void Composition::write_buffer(const FetchBuffer& buffer) {
    assert(buffer.records);
    const std::string name = declare(*buffer.records);
    m_text += define("elvis_fetch_" + buffer.name, name);
    m_text += define("elvis_fetch4_" + buffer.name, name + "_row");
}

/** The snippet's sources as one text, its own includes expanded. */
std::string snippet_text(const Snippet& snippet) {
    const auto resolve = [&](std::string_view name) -> std::string_view {
        for (const SnippetText& source : snippet.sources) {
            if (source.name == name) {
                return source.text;
            }
        }
        throw Error("the snippet has no source '" + std::string(name) + "'");
    };
    const SnippetText& main = snippet.sources.front();
    return "#line 1 \"" + main.name + "\"\n" + expand_includes(main.text, main.name, resolve);
}

void require_functions(const Snippet& snippet, const std::set<std::string>& names) {
    for (const InterfaceFunction& function : required_functions) {
        if (!names.contains(function.name)) {
            throw Error(snippet.sources.front().name,
                        std::string("the snippet lacks the required function `") + function.signature + "`");
        }
    }
}

void Composition::write_instance(const SnippetInstance& instance, std::size_t index) {
    const bool is_first = index == 0;
    const auto has = [&](std::uint32_t capability) { return (instance.snippet.capabilities & capability) != 0; };
    const std::string snippet = snippet_text(instance.snippet);
    require_functions(instance.snippet, identifiers(snippet));

    std::string origin = "elvis_vec3 elvis_origin(uint element) { return elvis_vec3(0); }\n";
    if (instance.origins) {
        const std::string name = declare(*instance.origins);
        origin = "elvis_vec3 elvis_origin(uint element) { return " + name + "_row(element, 0u).xyz; }\n";
    }
    std::set<std::string> macros{"ELVIS_SHAPE", "ELVIS_N_COMPONENTS", "ELVIS_HAS_INVERSE_MAPPING"};
    std::string defines = define("ELVIS_SHAPE", std::to_string(instance.shape)) +
                          define("ELVIS_N_COMPONENTS", std::to_string(instance.n_components) + "u") +
                          define("ELVIS_HAS_INVERSE_MAPPING", has(ELVIS_SNIPPET_INVERSE_MAPPING) ? "1" : "0");
    for (const auto& [name, value] : instance.constants) {
        defines += define(name, std::to_string(value));
        macros.insert(name);
    }
    for (const FetchBuffer& buffer : instance.buffers) {
        const std::string name = declare(*buffer.records);
        defines += define("elvis_fetch_" + buffer.name, name) + define("elvis_fetch4_" + buffer.name, name + "_row");
        macros.insert("elvis_fetch_" + buffer.name);
        macros.insert("elvis_fetch4_" + buffer.name);
    }

    // Host code that belongs to each instance, because it depends on the shape or calls the snippet.
    std::string host = expand_includes("#include \"library/reference_shape.glsl\"\n", "composition", shader_source);
    std::string after = has(ELVIS_SNIPPET_MAPPING_JACOBIAN) ? "" : mapping_jacobian_default;
    if (!has(ELVIS_SNIPPET_FIELD_GRADIENT)) {
        after += expand_includes("#include \"library/gradient_default.glsl\"\n", "composition", shader_source);
    }
    const std::string body = host + origin + snippet + "#line 1 \"composition of " + m_request.name + "\"\n" + after;

    const std::set<std::string> body_macros = defined_macros(body);
    std::string renames;
    std::set<std::string> renamed;
    if (!is_first) {
        const std::string suffix = "_" + std::to_string(index);
        const std::string prefix = instance.snippet.prefix + "_";
        const std::set<std::string> interface = [] {
            std::set<std::string> names(std::begin(optional_functions), std::end(optional_functions));
            for (const InterfaceFunction& function : required_functions) {
                names.insert(function.name);
            }
            return names;
        }();
        for (const std::string& name : identifiers(body)) {
            const bool belongs = interface.contains(name) || name.starts_with(prefix) ||
                                 (name.starts_with("core_") && !name.starts_with("core_records"));
            if (belongs && !body_macros.contains(name)) {
                renames += define(name, name + suffix);
                renamed.insert(name);
            }
        }
    }
    m_text += defines + renames + body;
    if (!is_first) {
        macros.insert(body_macros.begin(), body_macros.end());
        macros.insert(renamed.begin(), renamed.end());
        for (const std::string& name : macros) {
            m_text += "#undef " + name + "\n";
        }
    }
}

} // namespace

std::string compose_text(const Device& device, const KernelRequest& request) { return Composition(device, request).text(); }

ComposedKernel::ComposedKernel(const Device& device, const KernelRequest& request)
    : ComposedKernel(device, request, [&] {
          if (request.precision == Precision::float64 && !device.summary().has_float64) {
              throw Error(device.summary().name, "cannot compute in float64; use --precision float32");
          }
          const Composition composition(device, request);
          return Parts{compile_shader(composition.text(), request.name), composition.layout(), composition.records()};
      }()) {}

ComposedKernel::ComposedKernel(const Device& device, const KernelRequest& request, Parts parts)
    : m_kernel(device, parts.spirv, std::move(parts.layout), request.push_constant_bytes, request.name),
      m_records(std::move(parts.records)), m_n_own(request.bindings.size()) {}

void ComposedKernel::dispatch(std::span<const Buffer* const> bindings, std::span<const std::byte> push_constants,
                              std::uint32_t groups_x, std::uint32_t groups_y, std::uint32_t groups_z) const {
    assert(bindings.size() == m_n_own);
    std::vector<BoundBuffer> bound = m_records;
    for (std::uint32_t binding = 0; binding < bindings.size(); ++binding) {
        bound.push_back({binding, bindings[binding], nullptr, 0});
    }
    m_kernel.dispatch(bound, push_constants, groups_x, groups_y, groups_z);
}

} // namespace elvis
