/**
 * @file late_library.hpp
 * A shared library of the machine that is loaded when its first function is called, so that programs start without it.
 */
#pragma once

#include <string>

namespace elvis {

class LateLibrary {
public:
    /** Loads `file`, such as "libvulkan.so.1", from where the system's libraries are. It stays loaded. */
    explicit LateLibrary(const char* file);

    bool is_there() const { return m_library != nullptr; }
    /** Why it is not there, in the dynamic linker's words, which name the file. */
    const std::string& missing_because() const { return m_missing_because; }
    /** Throws an Error where the library, or the function in it, is missing. */
    void* function(const char* name) const;

private:
    std::string m_file;
    void* m_library = nullptr;
    std::string m_missing_because;
};

} // namespace elvis
