#include <core/conformance/snippet_compile.hpp>

#include <core/base/error.hpp>
#include <core/base/vector3.hpp>
#include <core/base/whole_file.hpp>
#include <core/conformance/device_sampler.hpp>
#include <core/conformance/differences.hpp>
#include <core/shader/compiler.hpp>
#include <core/shader/composer.hpp>
#include <core/shader/glsl_scan.hpp>
#include <core/shader/snippet_check.hpp>
#include <core/volume/device_volume.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <sstream>

namespace elvis::conformance {

namespace fs = std::filesystem;

namespace {

/** Names in `#include "name"` lines. Those in comments come along and do no harm. */
std::vector<std::string> included_names(const std::string& text) {
    std::vector<std::string> names;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t hash = line.find_first_not_of(" \t");
        const std::size_t open = line.find('"');
        const std::size_t close = open == std::string::npos ? open : line.find('"', open + 1);
        if (hash != std::string::npos && line[hash] == '#' && line.find("include") != std::string::npos &&
            close != std::string::npos) {
            names.push_back(line.substr(open + 1, close - open - 1));
        }
    }
    return names;
}

/** What all sources use and define. */
struct AllNames {
    std::set<std::string> identifiers;
    std::vector<GlslDefinition> definitions;
};

AllNames scan_all(const std::vector<SnippetText>& sources) {
    AllNames all;
    for (const SnippetText& source : sources) {
        const GlslNames names = scan_glsl(source.text);
        all.identifiers.insert(names.identifiers.begin(), names.identifiers.end());
        all.definitions.insert(all.definitions.end(), names.definitions.begin(), names.definitions.end());
    }
    return all;
}

std::uint32_t capabilities_of(const AllNames& names) {
    std::uint32_t capabilities = 0;
    for (const GlslDefinition& definition : names.definitions) {
        for (const SnippetFunction& function : snippet_functions()) {
            capabilities |= definition.name == function.name ? function.capability : 0;
        }
    }
    return capabilities;
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/** The words that most of the snippet's own names begin with; the longest if several do. */
std::string guess_prefix(const AllNames& names) {
    std::map<std::string, std::size_t> counts;
    for (const GlslDefinition& definition : names.definitions) {
        const std::string name = lower(definition.name);
        for (std::size_t at = name.find('_'); at != std::string::npos && name.rfind("elvis_", 0) != 0;
             at = name.find('_', at + 1)) {
            ++counts[name.substr(0, at)];
        }
    }
    std::string best = "snippet";
    std::size_t best_count = 0;
    for (const auto& [prefix, count] : counts) {
        if (count > best_count || (count == best_count && prefix.size() > best.size())) {
            best = prefix;
            best_count = count;
        }
    }
    return best;
}

/** Macros that stand for the buffers which the snippet fetches from. */
std::vector<std::pair<std::string, std::string>> stand_ins(const AllNames& names, const SnippetSurroundings& surroundings) {
    std::vector<std::pair<std::string, std::string>> macros;
    for (const char* function : {"elvis_fetch_", "elvis_fetch4_"}) {
        const std::string start = function;
        for (const std::string& name : names.identifiers) {
            if (name.rfind(start, 0) != 0) {
                continue;
            }
            const auto& uints = surroundings.uint_buffers;
            const bool is_uint = std::find(uints.begin(), uints.end(), name.substr(start.size())) != uints.end();
            const std::string type =
                start == "elvis_fetch_" ? (is_uint ? "uint" : "elvis_real") : (is_uint ? "uvec4" : "elvis_vec4");
            macros.emplace_back(name + "(record, index)", type + "(uint(record) + uint(index))");
        }
    }
    return macros;
}

void compile(KernelRequest request, Precision precision) {
    request.precision = precision;
    request.kernel = "conformance/conformance.comp";
    request.with_second_derivatives = true;
    compile_shader(compose_text(request), request.name);
}

} // namespace

std::vector<SnippetText> read_snippet(const std::string& path) {
    const fs::path folder = fs::path(path).parent_path();
    std::vector<SnippetText> sources{{path, read_whole_file(path)}};
    for (std::size_t i = 0; i < sources.size(); ++i) {
        for (const std::string& name : included_names(sources[i].text)) {
            const bool is_known =
                std::any_of(sources.begin(), sources.end(), [&](const SnippetText& source) { return source.name == name; });
            if (const std::string file = (folder / name).string(); !is_known && fs::is_regular_file(file)) {
                sources.push_back({name, read_whole_file(file)});
            }
        }
    }
    return sources;
}

SnippetReport compile_alone(const std::string& path, const SnippetSurroundings& surroundings) {
    SnippetInstance instance;
    instance.snippet.sources = read_snippet(path);
    const AllNames names = scan_all(instance.snippet.sources);
    SnippetReport report;
    instance.snippet.capabilities = capabilities_of(names);
    instance.snippet.prefix = surroundings.prefix.value_or(guess_prefix(names));
    if (!surroundings.prefix) {
        report.notes.push_back("prefix taken to be '" + instance.snippet.prefix + "' (--prefix)");
    }
    instance.shape = surroundings.shape;
    instance.n_components = surroundings.n_components;
    instance.constants.assign(surroundings.constants.begin(), surroundings.constants.end());
    const std::string macros = macro_prefix(instance.snippet) + "_";
    for (const std::string& name : names.identifiers) {
        const bool is_defined = surroundings.constants.count(name) != 0 ||
                                std::any_of(names.definitions.begin(), names.definitions.end(),
                                            [&](const GlslDefinition& definition) { return definition.name == name; });
        if (name.rfind(macros, 0) == 0 && !is_defined) {
            instance.constants.emplace_back(name, 1);
            report.notes.push_back("constant " + name + " taken to be 1 (--define " + name + "=VALUE)");
        }
    }
    KernelRequest request;
    request.name = fs::path(path).filename().string();
    request.defines = stand_ins(names, surroundings);
    for (const auto& macro : request.defines) {
        report.notes.push_back("stand-in for a buffer: " + macro.first + " is " + macro.second);
    }
    request.instances = {instance};
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        compile(request, precision);
        ++report.n_kernels;
    }
    return report;
}

SnippetReport compile_in_plugin(const std::string& path, Subject subject) {
    Context context(std::move(subject), {[](Reporter::Kind, const std::string&) {}});
    const std::shared_ptr<const Plugin> plugin = Plugin::load(fs::absolute(context.subject().library));
    const RuntimeVolume volume(plugin, context.subject().files.front(), context.subject().options);
    const Device device(context.subject().device);
    const std::vector<SnippetText> files = read_snippet(path);
    const std::string name = fs::path(path).filename().string();
    SnippetReport report;
    std::set<std::string> known;
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        if (precision == Precision::float64 && !device.summary().has_float64) {
            report.notes.push_back("the device has no double precision: float64 was not compiled");
            continue;
        }
        DeviceVolume on_device(device, volume, precision, nullptr);
        for (std::uint32_t field = 0; field < volume.fields().size(); ++field) {
            on_device.select(field, 0, std::vector<double>(volume.fields()[field].n_components, 0.0));
            for (std::uint32_t c = 0; c < volume.classes().size(); ++c) {
                KernelRequest request;
                request.name = name;
                on_device.add_field(request, c);
                bool is_replaced = false;
                for (SnippetInstance& instance : request.instances) {
                    for (SnippetText& source : instance.snippet.sources) {
                        known.insert(source.name);
                        // Included files are replaced too, under the names by which they are included.
                        for (const SnippetText& file : files) {
                            if (source.name == (&file == &files.front() ? name : file.name)) {
                                source.text = file.text;
                                is_replaced = is_replaced || &file == &files.front();
                            }
                        }
                    }
                }
                if (!is_replaced) {
                    continue;
                }
                request.kernel = "conformance/conformance.comp";
                request.precision = precision;
                request.with_second_derivatives = true;
                compile_shader(compose_text(device, request), request.name);
                ++report.n_kernels;
            }
        }
    }
    if (report.n_kernels == 0) {
        std::string list;
        for (const std::string& source : known) {
            list += (list.empty() ? "" : ", ") + source;
        }
        throw Error(path,
                    "has not the name of a source of the plugin's snippets, by which files are matched; those are: " + list);
    }
    return report;
}

std::vector<std::string> evaluate_at(const std::string& path, const Subject& subject, std::uint64_t element, const Vector3& xi,
                                     bool in_float32) {
    const std::shared_ptr<const Plugin> plugin = Plugin::load(fs::absolute(subject.library));
    const RuntimeVolume volume(plugin, subject.files.front(), subject.options);
    if (element >= volume.n_elements()) {
        throw Error(subject.files.front(), "has " + std::to_string(volume.n_elements()) + " elements, counted from 0");
    }
    DeviceSampler sampler(volume, subject.device, in_float32 ? Precision::float32 : Precision::float64);
    std::vector<SnippetText> files = read_snippet(path);
    files.front().name = fs::path(path).filename().string();
    sampler.replace_sources(std::move(files));
    SampleOptions options;
    options.is_debug_build = true;
    std::vector<std::string> lines;
    for (std::uint32_t field = 0; field < volume.fields().size(); ++field) {
        sampler.select(field, 0);
        const FieldInfo& info = volume.fields()[field];
        for (std::uint32_t component = 0; component < info.n_components; ++component) {
            const Sample sample = sampler.sample({{element, xi, component}}, options).front();
            if (field == 0 && component == 0) {
                lines.push_back("elvis_mapping = " + text_of(sample.position) + ", relative to " +
                                text_of(sampler.origin(element)));
                for (std::size_t j = 0; j < 3; ++j) {
                    const Point column{sample.jacobian[3 * j], sample.jacobian[3 * j + 1], sample.jacobian[3 * j + 2]};
                    lines.push_back("elvis_jacobian[" + std::to_string(j) + "] = " + text_of(column));
                }
                if (volume.is_cut(class_of(volume, element))) {
                    lines.push_back("elvis_inside = " + text_of(sample.inside) + ", gradient " +
                                    text_of(sample.inside_gradient) + ", bounds (" + text_of(sample.inside_bounds[0]) + ", " +
                                    text_of(sample.inside_bounds[1]) + ")");
                }
            }
            const std::string name = info.name + (info.n_components > 1 ? "[" + std::to_string(component) + "]" : "");
            lines.push_back("elvis_field_value of " + name + " = " + text_of(sample.value));
            lines.push_back("elvis_field_gradient of " + name + " = " + text_of(sample.gradient));
            if (sample.is_endless != 0) {
                lines.push_back("    a loop takes more than 50000 iterations");
            }
            if (sample.bad_index_line != 0) {
                lines.push_back("    " + text_of_bad_index(sample));
            }
            const auto n_said = static_cast<std::size_t>(sample.n_debug);
            for (std::size_t i = 0; i < std::min(n_said, sample.debug.size()); ++i) {
                lines.push_back("    elvis_debug " + std::to_string(i) + ": " + text_of(sample.debug[i]));
            }
            if (n_said > sample.debug.size()) {
                lines.push_back("    and " + std::to_string(n_said - sample.debug.size()) + " more");
            }
        }
    }
    return lines;
}

} // namespace elvis::conformance
