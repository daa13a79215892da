/**
 * @file test_host.hpp
 * A host that remembers what a plugin tells it and asks of it, and what was opened with it.
 */
#pragma once

#include <core/plugin_host/plugin.hpp>

#include <atomic>
#include <cstdint>
#include <limits>
#include <mutex>
#include <string>
#include <vector>

namespace elvis::conformance {

/** Must not move: the plugin keeps the address of its table. */
class TestHost {
public:
    TestHost();
    TestHost(const TestHost&) = delete;
    TestHost& operator=(const TestHost&) = delete;

    const elvis_host* table() const { return &m_table; }

    /** Questions after this many are answered with "stop". */
    void cancel_after(std::uint64_t n_questions) { m_cancel_after = n_questions; }
    std::uint64_t n_questions() const { return m_n_questions; }

    /** The message of the last set_error; empty if there was none since the last call of this. */
    std::string take_error();

private:
    elvis_host m_table{};
    std::mutex m_mutex;
    std::string m_error;
    std::atomic<std::uint64_t> m_n_questions{0};
    std::uint64_t m_cancel_after = std::numeric_limits<std::uint64_t>::max();
};

enum class Interface { runtime, converter };
const char* interface_name(Interface interface);
const char* result_name(elvis_result result);

/** An attempt to open a volume or source through the plugin's own table; closes what was opened. */
class Opening {
public:
    Opening(const Plugin& plugin, Interface interface, const TestHost& host, const std::vector<std::string>& files,
            const char* options);
    ~Opening();
    Opening(const Opening&) = delete;
    Opening& operator=(const Opening&) = delete;

    elvis_result result() const { return m_result; }
    bool is_open() const { return m_result == ELVIS_OK && (m_volume || m_source); }
    elvis_volume* volume() const { return m_volume; }
    elvis_source_volume* source() const { return m_source; }

private:
    const Plugin& m_plugin;
    elvis_result m_result = ELVIS_OK;
    elvis_volume* m_volume = nullptr;
    elvis_source_volume* m_source = nullptr;
};

} // namespace elvis::conformance
