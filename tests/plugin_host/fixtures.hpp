/**
 * @file fixtures.hpp
 * What the tests of the plugin host share.
 */
#pragma once

#include <core/base/error.hpp>
#include <core/plugin_host/plugin.hpp>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace elvis::test {

inline std::filesystem::path fixture(const std::string& name) { return std::filesystem::path(ELVIS_FIXTURES) / (name + ".so"); }

/** Text of the Error that a call throws; fails the test if it throws none. */
template <class Call> std::string error_of(Call&& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    FAIL("no error was thrown");
    return {};
}

/** Options for the fixtures troubled and troubled_source. */
inline std::string trouble(const std::string& name) { return "{\"trouble\": \"" + name + "\"}"; }

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

/** An empty folder while it lives. */
class Folder {
public:
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "elvis-host-XXXXXX").string();
        m_path = mkdtemp(name.data());
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(m_path, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    const std::filesystem::path& path() const { return m_path; }

    /** A file with this content; its path. */
    std::string file(const std::string& name, const std::string& content) const {
        const std::filesystem::path path = m_path / name;
        std::ofstream(path) << content;
        return path.string();
    }

private:
    std::filesystem::path m_path;
};

} // namespace elvis::test
