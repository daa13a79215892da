#include <core/shader/snippet_check.hpp>

#include <core/base/error.hpp>
#include <core/base/nearest_word.hpp>
#include <core/shader/glsl_scan.hpp>

#include <algorithm>
#include <cctype>
#include <set>

namespace elvis {

namespace {

bool begins_with(const std::string& text, const std::string& prefix) { return text.compare(0, prefix.size(), prefix) == 0; }

const SnippetFunction* find_function(const std::string& name) {
    const auto& functions = snippet_functions();
    const auto found = std::find_if(functions.begin(), functions.end(),
                                    [&](const SnippetFunction& function) { return name == function.name; });
    return found == functions.end() ? nullptr : &*found;
}

/** Types that mean what they say: others may be macros. */
bool is_plain_type(std::string type) {
    if (const std::size_t blank = type.find(' '); blank != std::string::npos) {
        type.erase(0, blank + 1);
    }
    static const std::set<std::string> types{"elvis_real", "elvis_vec2", "elvis_vec3", "elvis_vec4", "elvis_mat3", "uint",
                                             "int",        "bool",       "float",      "double",     "vec2",       "vec3",
                                             "vec4",       "mat3",       "dvec3",      "dmat3",      "void"};
    return types.count(type) != 0;
}

/** Whether a definition has another signature than the interface wants, as far as that can be told without a compiler. */
bool differs(const GlslDefinition& definition, const SnippetFunction& function) {
    const GlslNames wanted = scan_glsl(std::string(function.signature) + ";");
    const GlslDefinition& expected = wanted.definitions.front();
    if (definition.kind == GlslDefinition::Kind::macro || !is_plain_type(definition.type) ||
        !std::all_of(definition.parameters.begin(), definition.parameters.end(), is_plain_type)) {
        return false;
    }
    return definition.type != expected.type || definition.parameters != expected.parameters;
}

/** What snippets may name besides the functions that they define. */
const std::vector<std::string>& interface_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all{"elvis_real", "elvis_vec2", "elvis_vec3", "elvis_vec4",  "elvis_mat3",
                                     "elvis_sin",  "elvis_cos",  "elvis_exp",  "elvis_log",   "elvis_pow",
                                     "elvis_atan", "elvis_acos", "elvis_asin", "elvis_origin"};
        for (const SnippetFunction& function : snippet_functions()) {
            all.emplace_back(function.name);
        }
        return all;
    }();
    return names;
}

/** The name in quotation marks that a message is about; empty if there is none. */
std::string quoted_name(const std::string& message) {
    const std::size_t begin = message.find('\'');
    const std::size_t end = begin == std::string::npos ? begin : message.find('\'', begin + 1);
    return end == std::string::npos ? std::string() : message.substr(begin + 1, end - begin - 1);
}

std::string hint(const std::string& message) {
    const std::string name = quoted_name(message);
    const bool is_unknown = message.find("undeclared identifier") != std::string::npos ||
                            message.find("no matching overloaded function") != std::string::npos;
    if (const SnippetFunction* function = find_function(name)) {
        return std::string("; the interface has: ") + function->signature;
    }
    if (!is_unknown) {
        return {};
    }
    if (begins_with(name, "elvis_fetch")) {
        return "; no buffer of this class and field has that name (get_buffer)";
    }
    const auto& known = interface_names();
    if (std::find(known.begin(), known.end(), name) != known.end()) {
        return "; it takes other arguments (glsl_interface.md)";
    }
    if (begins_with(name, "elvis_")) {
        return "; the interface has no such name, the nearest is " + nearest_word(name, known);
    }
    if (name == "sin" || name == "cos" || name == "exp" || name == "log" || name == "pow" || name == "atan" || name == "acos" ||
        name == "asin") {
        return "; GLSL has it in single precision only, take elvis_" + name;
    }
    return {};
}

} // namespace

std::string explain_errors(const std::string& messages) {
    std::string text;
    std::size_t begin = 0;
    while (begin <= messages.size()) {
        const std::size_t end = std::min(messages.find('\n', begin), messages.size());
        const std::string line = messages.substr(begin, end - begin);
        text += (begin == 0 ? "" : "\n") + line + hint(line);
        begin = end + 1;
    }
    return text;
}

const std::vector<SnippetFunction>& snippet_functions() {
    static const std::vector<SnippetFunction> functions{
        {"elvis_mapping", "elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi)", 0},
        {"elvis_jacobian", "elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi)", 0},
        {"elvis_field_value", "elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component)", 0},
        {"elvis_field_gradient",
         "void elvis_field_gradient(uint element, elvis_vec3 xi, uint component, out elvis_real value, out elvis_vec3 "
         "gradient)",
         ELVIS_SNIPPET_FIELD_GRADIENT},
        {"elvis_mapping_jacobian",
         "void elvis_mapping_jacobian(uint element, elvis_vec3 xi, out elvis_vec3 x, out elvis_mat3 jacobian)",
         ELVIS_SNIPPET_MAPPING_JACOBIAN},
        {"elvis_inverse_mapping", "bool elvis_inverse_mapping(uint element, elvis_vec3 x, out elvis_vec3 xi)",
         ELVIS_SNIPPET_INVERSE_MAPPING},
        {"elvis_field_hessian",
         "void elvis_field_hessian(uint element, elvis_vec3 xi, uint component, out elvis_real value, out elvis_vec3 gradient, "
         "out elvis_mat3 hessian)",
         ELVIS_SNIPPET_FIELD_HESSIAN},
        {"elvis_mapping_hessian",
         "void elvis_mapping_hessian(uint element, elvis_vec3 xi, out elvis_vec3 x, out elvis_mat3 jacobian, out elvis_mat3 "
         "hessian_x, out elvis_mat3 hessian_y, out elvis_mat3 hessian_z)",
         ELVIS_SNIPPET_MAPPING_HESSIAN},
        {"elvis_inside", "void elvis_inside(uint element, elvis_vec3 xi, out elvis_real g, out elvis_vec3 gradient)",
         ELVIS_SNIPPET_INSIDE},
        {"elvis_inside_bounds", "elvis_vec2 elvis_inside_bounds(uint element)", ELVIS_SNIPPET_INSIDE},
    };
    return functions;
}

std::string macro_prefix(const Snippet& snippet) {
    std::string prefix = snippet.prefix;
    std::transform(prefix.begin(), prefix.end(), prefix.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return prefix;
}

void check_snippet(const Snippet& snippet) {
    if (snippet.sources.empty()) {
        throw Error("snippet '" + snippet.prefix + "'", "it has no source");
    }
    if (snippet.prefix.empty() || snippet.prefix == "elvis" || snippet.prefix == "core" || snippet.prefix == "gl") {
        throw Error(snippet.sources.front().name,
                    "'" + snippet.prefix + "' cannot be a snippet's prefix; take the plugin's name");
    }
    std::set<std::string> functions;
    for (const SnippetText& source : snippet.sources) {
        const GlslNames names = scan_glsl(source.text);
        if (names.forbidden_line != 0) {
            throw Error(source.name + ":" + std::to_string(names.forbidden_line),
                        "a snippet must not contain " + names.forbidden);
        }
        for (const GlslDefinition& definition : names.definitions) {
            const std::string place = source.name + ":" + std::to_string(definition.line);
            const SnippetFunction* function = find_function(definition.name);
            if (function != nullptr) {
                if (function->capability != 0 && (snippet.capabilities & function->capability) == 0) {
                    throw Error(place,
                                "the snippet defines " + definition.name + " but does not announce it in its capabilities");
                }
                if (differs(definition, *function)) {
                    throw Error(place, "this is not the signature that the interface has: " + std::string(function->signature));
                }
                if (definition.kind == GlslDefinition::Kind::function) {
                    functions.insert(definition.name);
                }
                continue;
            }
            // A function may be defined under a macro's name, which stands for the real one.
            if (!begins_with(definition.name, snippet.prefix + "_") &&
                !begins_with(definition.name, macro_prefix(snippet) + "_")) {
                throw Error(place, "the name '" + definition.name + "' does not begin with the snippet's prefix, '" +
                                       snippet.prefix + "_' ('" + macro_prefix(snippet) + "_' for macros)");
            }
        }
    }
    for (const SnippetFunction& function : snippet_functions()) {
        const bool is_wanted = function.capability == 0 || (snippet.capabilities & function.capability) != 0;
        if (is_wanted && functions.count(function.name) == 0) {
            throw Error(snippet.sources.front().name, std::string("the snippet lacks ") +
                                                          (function.capability == 0 ? "the required " : "what it announces: ") +
                                                          function.signature);
        }
    }
}

} // namespace elvis
