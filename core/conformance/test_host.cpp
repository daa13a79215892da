#include <core/conformance/test_host.hpp>

#include <utility>

namespace elvis::conformance {

namespace {

TestHost& self(const elvis_host* host) { return *static_cast<TestHost*>(host->context); }

} // namespace

TestHost::TestHost() {
    m_table.struct_size = sizeof m_table;
    m_table.abi_version = ELVIS_ABI_VERSION;
    m_table.context = this;
    m_table.log = [](const elvis_host*, elvis_log_level, const char*) {};
    m_table.report_progress = [](const elvis_host*, double, const char*) {};
    m_table.is_cancelled = [](const elvis_host* host) -> std::int32_t {
        TestHost& me = self(host);
        return me.m_n_questions.fetch_add(1) >= me.m_cancel_after ? 1 : 0;
    };
    m_table.set_error = [](const elvis_host* host, const char*, const char* message) {
        TestHost& me = self(host);
        const std::lock_guard lock(me.m_mutex);
        me.m_error = message ? message : "";
    };
}

std::string TestHost::take_error() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_error, {});
}

const char* interface_name(Interface interface) { return interface == Interface::runtime ? "runtime" : "converter"; }

const char* result_name(elvis_result result) {
    switch (result) {
    case ELVIS_OK:
        return "ELVIS_OK";
    case ELVIS_ERROR_FAILED:
        return "ELVIS_ERROR_FAILED";
    case ELVIS_ERROR_INVALID_ARGUMENT:
        return "ELVIS_ERROR_INVALID_ARGUMENT";
    case ELVIS_ERROR_FILE:
        return "ELVIS_ERROR_FILE";
    case ELVIS_ERROR_FORMAT:
        return "ELVIS_ERROR_FORMAT";
    case ELVIS_ERROR_UNSUPPORTED:
        return "ELVIS_ERROR_UNSUPPORTED";
    case ELVIS_ERROR_CANCELLED:
        return "ELVIS_ERROR_CANCELLED";
    case ELVIS_ERROR_OUT_OF_MEMORY:
        return "ELVIS_ERROR_OUT_OF_MEMORY";
    default:
        return "an unknown result code";
    }
}

Opening::Opening(const Plugin& plugin, Interface interface, const TestHost& host, const std::vector<std::string>& files,
                 const char* options)
    : m_plugin(plugin) {
    if (interface == Interface::runtime) {
        m_result = plugin.runtime()->open(host.table(), files.front().c_str(), options, &m_volume);
        return;
    }
    std::vector<const char*> names;
    for (const std::string& file : files) {
        names.push_back(file.c_str());
    }
    m_result =
        plugin.converter()->open(host.table(), names.data(), static_cast<std::uint32_t>(names.size()), options, &m_source);
}

Opening::~Opening() {
    if (m_result != ELVIS_OK) {
        return; // Nothing was handed over.
    }
    if (m_volume) {
        m_plugin.runtime()->close(m_volume);
    }
    if (m_source) {
        m_plugin.converter()->close(m_source);
    }
}

} // namespace elvis::conformance
