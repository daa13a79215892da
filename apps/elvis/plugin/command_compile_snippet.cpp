#include <apps/elvis/commands.hpp>

#include <core/base/error.hpp>
#include <core/conformance/reference_points.hpp>
#include <core/conformance/snippet_compile.hpp>

#include <cstdio>
#include <memory>

namespace elvis::commands {

namespace {

struct CompileSnippetArguments {
    std::string file;
    conformance::Subject subject;
    conformance::SnippetSurroundings surroundings;
    std::string shape = "hexahedron";
    std::string prefix;
    std::vector<std::string> defines;
    /** Element, then xi. */
    std::vector<double> at;
    bool in_float32 = false;
};

elvis_shape shape_of(const std::string& name) {
    for (elvis_shape shape = ELVIS_SHAPE_HEXAHEDRON; shape <= ELVIS_SHAPE_TRIANGLE; ++shape) {
        if (name == conformance::shape_name(shape)) {
            return shape;
        }
    }
    throw UsageError(name, "is no shape: hexahedron, prism, pyramid, tetrahedron, quadrilateral or triangle");
}

std::pair<std::string, std::int64_t> definition_of(const std::string& text) {
    const std::size_t equals = text.find('=');
    try {
        std::size_t end = 0;
        const std::string value = equals == std::string::npos ? "1" : text.substr(equals + 1);
        const std::int64_t number = std::stoll(value, &end);
        if (end == value.size()) {
            return {text.substr(0, equals), number};
        }
    } catch (const std::exception&) {
        // Said below.
    }
    throw UsageError("--define " + text, "is not NAME=INTEGER");
}

void run_compile_snippet(CompileSnippetArguments arguments) {
    if (!arguments.at.empty() && arguments.subject.library.empty()) {
        throw UsageError("--at", "wants --plugin LIBRARY --volume FILE: there must be an element to look at");
    }
    conformance::SnippetReport report;
    if (!arguments.subject.library.empty()) {
        if (arguments.subject.files.empty()) {
            throw UsageError("--plugin", "wants --volume FILE too: classes, constants and buffers depend on the volume");
        }
        report = conformance::compile_in_plugin(arguments.file, arguments.subject);
    } else {
        arguments.surroundings.shape = shape_of(arguments.shape);
        if (!arguments.prefix.empty()) {
            arguments.surroundings.prefix = arguments.prefix;
        }
        for (const std::string& define : arguments.defines) {
            arguments.surroundings.constants.insert(definition_of(define));
        }
        report = conformance::compile_alone(arguments.file, arguments.surroundings);
    }
    for (const std::string& note : report.notes) {
        std::printf("note: %s\n", note.c_str());
    }
    std::printf("%s compiles (%zu kernels)\n", arguments.file.c_str(), report.n_kernels);
    if (!arguments.at.empty()) {
        const std::vector<std::string> lines =
            conformance::evaluate_at(arguments.file, arguments.subject, static_cast<std::uint64_t>(arguments.at[0]),
                                     {arguments.at[1], arguments.at[2], arguments.at[3]}, arguments.in_float32);
        for (const std::string& line : lines) {
            std::printf("%s\n", line.c_str());
        }
    }
}

} // namespace

void add_compile_snippet(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("compile-snippet", "Compile a plugin's GLSL from its file, errors with file and line");
    auto a = std::make_shared<CompileSnippetArguments>();
    command->add_option("file", a->file, "The snippet's first source; #include reaches files beside it")->required();
    command->add_option("--plugin", a->subject.library, "Library of the plugin: classes, constants and buffers come from it");
    command->add_option("--volume", a->subject.files, "A file that the plugin opens");
    command->add_option("--options", a->subject.options, "Options of the plugin, a JSON object");
    command->add_option("--device", a->subject.device, "Vulkan device (name or index)");
    command->add_option("--shape", a->shape, "Without a plugin: ELVIS_SHAPE")->capture_default_str();
    command->add_option("--components", a->surroundings.n_components, "Without a plugin: ELVIS_N_COMPONENTS")
        ->capture_default_str();
    command->add_option("--prefix", a->prefix, "Without a plugin: the snippet's prefix (default: what most names begin with)");
    command->add_option("--define", a->defines, "Without a plugin: a constant NAME=INTEGER; repeatable (default: 1)");
    command->add_option("--uint-buffer", a->surroundings.uint_buffers,
                        "Without a plugin: this buffer is of kind UINT; repeatable");
    command
        ->add_option("--at", a->at,
                     "With a plugin: ELEMENT,X,Y,Z, a reference point at which to evaluate; shows what elvis_debug(NUMBER) was "
                     "given there")
        ->delimiter(',')
        ->expected(4);
    command->add_flag("--float32", a->in_float32, "With --at: in single precision");
    command->callback([a] { run_compile_snippet(*a); });
}

} // namespace elvis::commands
