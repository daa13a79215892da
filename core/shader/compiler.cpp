#include <core/shader/compiler.hpp>

#include <core/base/cache.hpp>
#include <core/base/error.hpp>
#include <core/shader/includes.hpp>
#include <core/shader/snippet_check.hpp>

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <spirv-tools/libspirv.hpp>

#include <cstring>
#include <mutex>
#include <span>

namespace elvis {

namespace {

/** Raise when the way of compiling changes, so that old cache entries are not taken. */
constexpr const char* way_of_compiling = "4";

std::string compiler_version() {
    const glslang::Version version = glslang::GetVersion();
    return std::to_string(version.major) + "." + std::to_string(version.minor) + "." + std::to_string(version.patch) +
           version.flavor + "/" + std::to_string(glslang::GetSpirvGeneratorVersion()) + "/" + way_of_compiling;
}

/** glslang's log as one "file:line: message" a line, without its closing remarks. */
std::string readable_log(std::string_view log) {
    std::string text;
    while (!log.empty()) {
        const std::size_t end = log.find('\n');
        std::string_view line = log.substr(0, end);
        log.remove_prefix(end == std::string_view::npos ? log.size() : end + 1);
        constexpr std::string_view error = "ERROR: ";
        if (line.substr(0, error.size()) == error) {
            line.remove_prefix(error.size());
            if (line.find("compilation errors.") != std::string_view::npos ||
                line.find("'' : compilation terminated") != std::string_view::npos) {
                continue;
            }
        }
        while (!line.empty() && line.back() == ' ') {
            line.remove_suffix(1);
        }
        if (!line.empty()) {
            text.append(text.empty() ? "" : "\n").append(line);
        }
    }
    return text;
}

std::vector<std::uint32_t> run_compiler(const std::string& text, const std::string& name, SpirvTarget target) {
    // Once a process; glslang counts its users and the process never ends its own use. Compiling is safe on any thread
    // afterwards.
    static std::once_flag initialized;
    std::call_once(initialized, [] { glslang::InitializeProcess(); });

    glslang::TShader shader(EShLangCompute);
    const char* strings = text.c_str();
    const auto length = static_cast<int>(text.size());
    const char* names = name.c_str();
    shader.setStringsWithLengthsAndNames(&strings, &length, &names, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
    const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    if (!shader.parse(GetDefaultResources(), 460, false, messages)) {
        throw Error("kernel '" + name + "'", "it does not compile\n" + explain_errors(readable_log(shader.getInfoLog())));
    }
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(messages)) {
        throw Error("kernel '" + name + "'", "it does not link\n" + readable_log(program.getInfoLog()));
    }
    std::vector<std::uint32_t> spirv;
    glslang::SpvOptions options;
    options.disableOptimizer = true; // spirv-opt takes a second a kernel, and drivers take as long as without it.
    options.validate = false;
    glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), spirv, &options);
    spirv = evaluate_partially(spirv, target);
#ifndef NDEBUG
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_3);
    std::string complaint;
    tools.SetMessageConsumer(
        [&](spv_message_level_t, const char*, const spv_position_t&, const char* message) { complaint += message; });
    if (!tools.Validate(spirv)) {
        throw Error("kernel '" + name + "'", "invalid SPIR-V was made of it: " + complaint);
    }
#endif
    return spirv;
}

} // namespace

std::vector<std::uint32_t> compile_shader(const std::string& text, const std::string& name, SpirvTarget target) {
    const std::string complete = expand_includes(text, name, shader_source);
    const std::string entry =
        content_hash(compiler_version() + (target == SpirvTarget::processor ? "/processor\n" : "\n") + complete) + ".spirv";
    if (const auto cached = read_cache_entry(entry); cached && cached->size() % sizeof(std::uint32_t) == 0) {
        std::vector<std::uint32_t> spirv(cached->size() / sizeof(std::uint32_t));
        std::memcpy(spirv.data(), cached->data(), cached->size());
        return spirv;
    }
    const auto spirv = run_compiler(complete, name, target);
    write_cache_entry(entry, std::as_bytes(std::span(spirv)));
    return spirv;
}

} // namespace elvis
