/**
 * @file error.hpp
 * The exception of this plugin, turned into a result code and error text at the C boundary.
 */
#pragma once

#include <elvis/abi.h>

#include <stdexcept>
#include <string>

namespace elvis::native_plugin {

class PluginError : public std::runtime_error {
public:
    PluginError(elvis_result code, const std::string& what) : std::runtime_error(what), m_code(code) {}
    elvis_result code() const { return m_code; }

private:
    elvis_result m_code;
};

/** Throws for a mistake of the caller. */
inline void require(bool condition, const char* what) {
    if (!condition)
        throw PluginError(ELVIS_ERROR_INVALID_ARGUMENT, what);
}

} // namespace elvis::native_plugin
