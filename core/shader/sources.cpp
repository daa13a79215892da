#include <core/base/error.hpp>
#include <core/shader/compiler.hpp>

#include <shader_files.hpp>

namespace elvis {

std::string_view shader_source(std::string_view path) {
    for (const shader_files::Text& file : shader_files::files) {
        if (path == file.name) {
            return file.text;
        }
    }
    throw Error("the program has no shader source '" + std::string(path) + "'");
}

} // namespace elvis
