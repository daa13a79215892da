#include <core/base/cache.hpp>
#include <core/base/error.hpp>
#include <core/shader/compiler.hpp>
#include <core/shader/include.hpp>

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <algorithm>
#include <cstring>
#include <span>

namespace elvis {

namespace {

/** glslang's process-wide state, set up once. */
class GlslangProcess {
public:
    static void ensure() { static const GlslangProcess process; }
    ~GlslangProcess() { glslang::FinalizeProcess(); }

private:
    GlslangProcess() { glslang::InitializeProcess(); }
};

/** Lines "ERROR: file:line: message" of glslang's log as "file:line: message". */
std::string error_lines(const std::string& log) {
    constexpr std::string_view mark = "ERROR: ";
    std::string lines;
    for (std::size_t begin = 0; begin < log.size();) {
        const std::size_t end = std::min(log.find('\n', begin), log.size());
        const std::string line = log.substr(begin, end - begin);
        // The last line only counts the errors.
        if (line.starts_with(mark) && line.find("compilation errors") == std::string::npos) {
            lines += "\n  " + line.substr(mark.size());
        }
        begin = end + 1;
    }
    return lines.empty() ? "\n  " + log : lines;
}

std::vector<std::uint32_t> translate(const std::string& text, const std::string& name) {
    GlslangProcess::ensure();
    glslang::TShader shader(EShLangCompute);
    const char* const strings[] = {text.c_str()};
    shader.setStrings(strings, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
    const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    if (!shader.parse(GetDefaultResources(), 460, false, messages)) {
        throw Error("shader " + name, "does not compile:" + error_lines(shader.getInfoLog()));
    }
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(messages)) {
        throw Error("shader " + name, "does not link:" + error_lines(program.getInfoLog()));
    }
    std::vector<std::uint32_t> words;
    glslang::SpvOptions options;
    options.disableOptimizer = true;
    glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), words, &options);
    return words;
}

std::string cache_name(const std::string& text) {
    const glslang::Version version = glslang::GetVersion();
    return "spirv-" + content_hash(std::to_string(version.major) + "." + std::to_string(version.minor) + "." +
                                   std::to_string(version.patch) + "\n" + text);
}

} // namespace

std::vector<std::uint32_t> compile_shader(const std::string& text, const std::string& name) {
    const std::string expanded = expand_includes(text, name, shader_source);
    const std::string entry = cache_name(expanded);
    if (const auto bytes = read_cache_entry(entry); bytes && bytes->size() % sizeof(std::uint32_t) == 0) {
        std::vector<std::uint32_t> words(bytes->size() / sizeof(std::uint32_t));
        std::memcpy(words.data(), bytes->data(), bytes->size());
        return words;
    }
    std::vector<std::uint32_t> words = translate(expanded, name);
    write_cache_entry(entry, std::as_bytes(std::span(words)));
    return words;
}

} // namespace elvis
