#include "conversion_task.hpp"

#include <apps/elvis/convert/conversion.hpp>

#include <core/base/child_process.hpp>
#include <core/base/error.hpp>

#include <unistd.h>

#include <cstdio>
#include <memory>
#include <utility>

namespace elvis::view {

ConversionTask::~ConversionTask() { cancel(); }

void ConversionTask::start(std::vector<std::string> inputs, std::string output) {
    if (m_thread.joinable()) {
        m_thread.join();
    }
    m_control.cancelled = false;
    m_fraction = -1;
    m_activity.clear();
    m_is_running = true;
    m_control.on_progress = [this](double fraction, std::string_view activity) {
        const std::lock_guard lock(m_mutex);
        m_fraction = fraction;
        m_activity = activity;
    };
    m_thread = std::jthread([this, inputs = std::move(inputs), output = std::move(output)] {
        ConversionResult result;
        result.output = output;
        try {
            // Plugins print to a file, whose end is shown if they crash.
            const std::unique_ptr<std::FILE, int (*)(std::FILE*)> said(std::tmpfile(), std::fclose);
            commands::ConvertProcess process;
            process.output = said ? ::fileno(said.get()) : STDERR_FILENO;
            result.report = nlohmann::json::parse(commands::convert_separately({inputs, output}, m_control, process));
            result.said = said ? last_output(process.output) : std::string();
        } catch (const Cancelled&) {
            result.was_cancelled = true;
        } catch (const std::exception& error) {
            result.error = error.what();
        }
        {
            const std::lock_guard lock(m_mutex);
            m_result = std::move(result);
        }
        m_is_running = false;
    });
}

std::pair<double, std::string> ConversionTask::progress() const {
    const std::lock_guard lock(m_mutex);
    return {m_fraction, m_activity};
}

std::optional<ConversionResult> ConversionTask::collect() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_result, std::nullopt);
}

} // namespace elvis::view
