/**
 * @file fixtures.hpp
 * What the tests of the plugin host share.
 */
#pragma once

#include <core/plugin_host/plugin.hpp>
#include <tests/support/error_of.hpp>
#include <tests/support/files.hpp>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace elvis::test {

inline std::filesystem::path fixture(const std::string& name) { return std::filesystem::path(ELVIS_FIXTURES) / (name + ".so"); }

/** Options for the fixtures troubled and troubled_source. */
inline std::string trouble(const std::string& name) { return "{\"trouble\": \"" + name + "\"}"; }

/** What is said, of a file, of something that a plugin returned and that cannot be. */
class BlamesPlugin : public Catch::MatcherBase<std::string> {
public:
    /** `beginning`: "FILE: plugin ID". */
    BlamesPlugin(std::string beginning, std::string function)
        : m_beginning(std::move(beginning)), m_function(std::move(function)) {}
    bool match(const std::string& text) const override {
        return text.find(m_beginning + " is at fault: " + m_function + " returned ") == 0;
    }
    std::string describe() const override { return "blames the plugin for " + m_function; }

private:
    std::string m_beginning, m_function;
};

/** An environment variable with another value while this lives; null removes it. */
class Environment {
public:
    Environment(std::string name, const char* value) : m_name(std::move(name)) {
        if (const char* before = std::getenv(m_name.c_str())) {
            m_had_value = true;
            m_before = before;
        }
        value ? setenv(m_name.c_str(), value, 1) : unsetenv(m_name.c_str());
    }
    ~Environment() { m_had_value ? setenv(m_name.c_str(), m_before.c_str(), 1) : unsetenv(m_name.c_str()); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    std::string m_name;
    std::string m_before;
    bool m_had_value = false;
};

} // namespace elvis::test
