#include "conversion.hpp"

#include <apps/elvis/library_context.hpp>

#include <core/base/child_process.hpp>
#include <core/base/error.hpp>
#include <core/base/memory.hpp>
#include <core/base/temporary_folder.hpp>

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <optional>

namespace elvis::commands {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/** First letter of a line of the answer; besides them crash_mark. */
constexpr char plugin_mark = 'U';
constexpr char progress_mark = 'P';
constexpr char report_mark = 'D';
constexpr char error_mark = 'E';
constexpr char cancelled_mark = 'X';

/** Between two looks at memory and at the wish to stop. */
constexpr std::chrono::milliseconds look{50};
/** Between two lines of progress. */
constexpr std::chrono::milliseconds least_between_lines{50};

/** Beside the output, on the same file system. What a killed process leaves there goes with it. */
TemporaryFolder folder_beside(const std::string& output) {
    const fs::path parent = fs::path(output).parent_path();
    try {
        return TemporaryFolder((parent.empty() ? fs::path(".") : parent) / ".elvis-convert-");
    } catch (const Error& error) {
        throw Error(output, error.cause());
    }
}

std::vector<std::string> arguments_of(const Conversion& request, const std::string& output, const ConvertProcess& process) {
    std::vector<std::string> arguments{"elvis"};
    arguments.insert(arguments.end(), process.first_arguments.begin(), process.first_arguments.end());
    arguments.insert(arguments.end(), {"convert", "--answer", std::to_string(ChildProcess::answer), "-o", output});
    if (!request.plugin.empty()) {
        arguments.insert(arguments.end(), {"--plugin", request.plugin});
    }
    if (!request.options.empty()) {
        arguments.insert(arguments.end(), {"--options", request.options});
    }
    if (request.order >= 0) {
        arguments.insert(arguments.end(), {"--order", std::to_string(request.order)});
    }
    if (!request.continuity.empty()) {
        arguments.insert(arguments.end(), {"--continuity", request.continuity});
    }
    for (const std::string& field : request.fields) {
        arguments.insert(arguments.end(), {"--fields", field});
    }
    arguments.emplace_back("--");
    arguments.insert(arguments.end(), request.inputs.begin(), request.inputs.end());
    return arguments;
}

std::string mebibytes(std::uint64_t bytes) { return std::to_string(bytes >> 20u) + " MiB"; }

/** What the process has said so far. */
struct Answer {
    std::string plugin, activity;
    /** In which it crashed. */
    std::string function;
    std::optional<std::string> report;
    std::optional<std::string> error;
    bool was_cancelled = false;

    void take(const std::string& line, const TaskControl& control) {
        const std::string text = line.substr(std::min<std::size_t>(1, line.size()));
        switch (line.empty() ? '\0' : line[0]) {
        case plugin_mark:
            plugin = text;
            break;
        case progress_mark: {
            char* rest = nullptr;
            const double fraction = std::strtod(text.c_str(), &rest);
            activity = *rest == ' ' ? rest + 1 : rest;
            control.progress(fraction, activity);
            break;
        }
        case report_mark:
            report = text;
            break;
        case error_mark:
            error = text;
            break;
        case cancelled_mark:
            was_cancelled = true;
            break;
        case crash_mark:
            plugin = text.substr(0, text.find('\n'));
            function = text.substr(std::min(text.size(), plugin.size() + 1));
            break;
        default:
            break;
        }
    }

    /** "plugin 'x', while opening the files": for messages. */
    std::string place() const {
        return (plugin.empty() ? std::string("the conversion") : "plugin " + plugin) +
               (activity.empty() ? std::string() : ", while " + activity);
    }
};

/** Of messages; empty where nobody reads the file, of which the conversion says more. */
std::string plugin_of(const Conversion& request) {
    try {
        return request.plugin.empty() ? nlohmann::json::parse(library_context().describe_file(request.inputs.front()))["plugin"]
                                      : nlohmann::json(request.plugin);
    } catch (const error&) {
        return {};
    }
}

Error crash(const Conversion& request, const Answer& answer, int status, int output) {
    std::string what = (answer.plugin.empty() ? std::string("the conversion") : "plugin " + answer.plugin) + " crashed" +
                       (answer.function.empty() ? std::string() : " in its function " + answer.function) +
                       (answer.activity.empty() ? std::string() : ", while " + answer.activity) + ": its process " +
                       ending_text(status);
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) {
        what += ", as the system does where memory runs out";
    }
    what += "; nothing was written";
    if (const std::string said = output == STDERR_FILENO ? std::string() : last_output(output); !said.empty()) {
        what += "; it said: " + said;
    }
    return Error(request.inputs.front(), what);
}

/** Until the process ends, which is asked to stop or ended where it has to be. */
Answer listen(ChildProcess& process, const Conversion& request, const TaskControl& control, const ConvertProcess& options) {
    const std::uint64_t most_bytes = options.most_bytes != 0 ? options.most_bytes : available_bytes() / 16 * 15;
    Answer answer;
    std::optional<Clock::time_point> stop_since;
    Clock::time_point next_look = Clock::now() + look;
    for (;;) {
        std::string line;
        const ChildProcess::Read read = process.read_line(line, next_look);
        if (read == ChildProcess::Read::end) {
            return answer;
        }
        if (read == ChildProcess::Read::line) {
            answer.take(line, control);
        }
        const Clock::time_point now = Clock::now();
        if (now < next_look) {
            continue;
        }
        next_look = now + look;
        if (control.is_cancelled() && !stop_since) {
            stop_since = now;
            process.signal(SIGTERM);
        }
        if (stop_since && (now - *stop_since >= options.patience || (options.is_urgent && options.is_urgent()))) {
            process.kill();
            spdlog::warn("{} did not stop: its process was ended", answer.place());
            throw Cancelled();
        }
        if (const std::uint64_t bytes = process.resident_bytes(); bytes > most_bytes) {
            process.kill();
            throw Error(request.inputs.front(), answer.place() + ", took " + mebibytes(bytes) + " of memory, more than the " +
                                                    mebibytes(most_bytes) +
                                                    " that it may; its process was ended, nothing was written");
        }
    }
}

} // namespace

std::string convert_separately(const Conversion& request, const TaskControl& control, const ConvertProcess& options) {
    control.check();
    const TemporaryFolder folder = folder_beside(request.output);
    const std::string output = folder.path("volume.h5");
    ChildProcess process({arguments_of(request, output, options), environment_without({}), options.output, true, true},
                         request.inputs.front());
    const Answer answer = listen(process, request, control, options);
    // What plugins do when the process ends must not take for ever, either.
    const int status = process.wait_until(Clock::now() + options.patience);
    if (answer.was_cancelled) {
        throw Cancelled();
    }
    if (answer.error) {
        throw Error(*answer.error);
    }
    if (!answer.report) {
        if (control.is_cancelled()) {
            throw Cancelled();
        }
        throw crash(request, answer, status, options.output);
    }
    if (status != 0) {
        spdlog::warn("{}: the process {} after the conversion was done", answer.place(), ending_text(status));
    }
    control.check();
    std::error_code error;
    fs::rename(output, request.output, error);
    if (error) {
        throw Error(request.output, "cannot be written: " + error.message());
    }
    return *answer.report;
}

void answer_conversion(const Conversion& request, TaskControl& control, int descriptor) {
    ::fcntl(descriptor, F_SETFD, FD_CLOEXEC); // not for what the plugin starts
    std::mutex mutex;
    Clock::time_point last{};
    std::string last_activity;
    const auto write = [&](char mark, const std::string& text) {
        const std::lock_guard lock(mutex);
        write_answer(descriptor, mark, text);
    };
    control.on_progress = [&](double fraction, std::string_view activity) {
        {
            const std::lock_guard lock(mutex);
            const Clock::time_point now = Clock::now();
            if (activity == last_activity && now - last < least_between_lines) {
                return;
            }
            last = now;
            last_activity = activity;
        }
        char text[32];
        std::snprintf(text, sizeof text, "%.6f ", fraction);
        write(progress_mark, text + std::string(activity));
    };
    try {
        write(plugin_mark, plugin_of(request));
        write(report_mark, convert_here(request, control));
    } catch (const cancelled&) {
        write(cancelled_mark, {});
    } catch (const std::exception& wrong) {
        write(error_mark, wrong.what());
    }
}

} // namespace elvis::commands
