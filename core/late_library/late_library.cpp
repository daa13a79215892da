#include <core/late_library/late_library.hpp>

#include <core/base/error.hpp>

#include <dlfcn.h>

namespace elvis {

LateLibrary::LateLibrary(const char* file) : m_file(file), m_library(dlopen(file, RTLD_NOW | RTLD_LOCAL)) {
    if (m_library == nullptr) {
        const char* cause = dlerror();
        m_missing_because = cause != nullptr ? cause : m_file + " cannot be loaded";
    }
}

void* LateLibrary::function(const char* name) const {
    if (!is_there()) {
        throw Error(m_file, "is not on this machine: " + m_missing_because);
    }
    void* function = dlsym(m_library, name);
    if (function == nullptr) {
        throw Error(m_file, std::string("has no function ") + name);
    }
    return function;
}

} // namespace elvis
