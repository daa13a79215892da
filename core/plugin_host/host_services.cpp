#include <core/base/error.hpp>
#include <core/base/log.hpp>
#include <core/plugin_host/current_call.hpp>
#include <core/plugin_host/host_services.hpp>

#include <utility>

namespace elvis {

namespace {

struct PluginError {
    std::string file;
    std::string message;
};

/** What the plugin said last on this thread: calls may run at the same time on several. */
thread_local PluginError last_error;

const HostServices& services(const elvis_host* host) { return *static_cast<const HostServices*>(host->context); }

LogLevel log_level(elvis_log_level level) {
    switch (level) {
    case ELVIS_LOG_DEBUG:
        return LogLevel::debug;
    case ELVIS_LOG_INFO:
        return LogLevel::info;
    case ELVIS_LOG_WARNING:
        return LogLevel::warning;
    default:
        return LogLevel::error;
    }
}

const char* result_name(elvis_result result) {
    switch (result) {
    case ELVIS_ERROR_INVALID_ARGUMENT:
        return "invalid argument";
    case ELVIS_ERROR_FILE:
        return "file cannot be read";
    case ELVIS_ERROR_FORMAT:
        return "file is not what its format demands";
    case ELVIS_ERROR_UNSUPPORTED:
        return "not supported";
    case ELVIS_ERROR_OUT_OF_MEMORY:
        return "out of memory";
    default:
        return "failed";
    }
}

} // namespace

HostServices::HostServices(std::string plugin_id, const TaskControl* control)
    : m_plugin_id(std::move(plugin_id)), m_control(control), m_host(host()) {
    m_table.struct_size = sizeof m_table;
    m_table.abi_version = ELVIS_ABI_VERSION;
    m_table.context = this;
    m_table.log = [](const elvis_host* host, elvis_log_level level, const char* message) {
        current_call::give_sign();
        // A plugin's own threads know of no host.
        const HostServices& own = services(host);
        const HostScope scope(own.m_host);
        log_line(log_level(level), "{}: {}", own.m_plugin_id, message ? message : "");
    };
    m_table.report_progress = [](const elvis_host* host, double fraction, const char* activity) {
        current_call::give_sign();
        if (const TaskControl* task = services(host).m_control) {
            task->progress(fraction, activity ? activity : "");
        }
    };
    m_table.is_cancelled = [](const elvis_host* host) -> std::int32_t {
        const TaskControl* task = services(host).m_control;
        return task && task->is_cancelled() ? 1 : 0;
    };
    m_table.set_error = [](const elvis_host*, const char* file, const char* message) {
        last_error = {file ? file : "", message ? message : ""};
    };
}

void HostServices::begin(const char* function) const {
    last_error = {};
    current_call::begin(m_plugin_id.c_str(), function);
}

void HostServices::check(elvis_result result, const char* function, const std::string& place) const {
    const PluginError said = std::exchange(last_error, {});
    current_call::end();
    if (result == ELVIS_OK) {
        return;
    }
    if (result == ELVIS_ERROR_CANCELLED) {
        throw Cancelled();
    }
    const std::string& where = said.file.empty() ? place : said.file;
    const std::string what = said.message.empty() ? std::string(result_name(result)) + " (code " + std::to_string(result) +
                                                        "; the plugin gives no reason)"
                                                  : said.message;
    throw Error(where, what + " [plugin " + m_plugin_id + ", " + function + "]");
}

void HostServices::refuse(const char* function, const std::string& place, const std::string& what) const {
    throw PluginFault(place, "plugin " + m_plugin_id + " is at fault: " + function + " returned " + what);
}

} // namespace elvis
