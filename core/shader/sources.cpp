#include <core/base/error.hpp>
#include <core/shader/compiler.hpp>

#include <shader_texts.hpp>

namespace elvis {

std::string_view shader_source(std::string_view path) {
    for (const auto& file : shader_texts::files) {
        if (path == file.name) {
            return file.text;
        }
    }
    throw Error("there is no shader file '" + std::string(path) + "'");
}

} // namespace elvis
