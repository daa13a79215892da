#include <core/conformance/runner.hpp>

#include <core/base/child_process.hpp>
#include <core/base/error.hpp>
#include <core/base/temporary_folder.hpp>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <mutex>

namespace elvis::conformance {

namespace {

using Clock = std::chrono::steady_clock;

/** First letter of a line of the answer. */
constexpr char failure_mark = 'F';
constexpr char note_mark = 'N';
constexpr char progress_mark = 'P';
constexpr char skipped_mark = 'S';
constexpr char not_applicable_mark = 'A';
constexpr char done_mark = 'D';

std::vector<std::string> arguments_of(const Check& check, const Subject& subject) {
    std::vector<std::string> arguments{"elvis",        "--quiet",
                                       "check-plugin", subject.library,
                                       "--in-process", check.name,
                                       "--answer",     std::to_string(ChildProcess::answer),
                                       "--seed",       std::to_string(subject.seed)};
    for (const std::string& file : subject.files) {
        arguments.insert(arguments.end(), {"--volume", file});
    }
    if (!subject.options.empty()) {
        arguments.insert(arguments.end(), {"--options", subject.options});
    }
    if (!subject.device.empty()) {
        arguments.insert(arguments.end(), {"--device", subject.device});
    }
    return arguments;
}

/**
 * This process's variables, with a temporary folder that the parent removes, and without the allocator's caches of free memory:
 * they would hide what leaks.
 */
std::vector<std::string> environment_of(const std::string& temporary_folder) {
    std::vector<std::string> variables = environment_without({"TMPDIR", "GLIBC_TUNABLES"});
    variables.push_back("TMPDIR=" + temporary_folder);
    variables.push_back("GLIBC_TUNABLES=glibc.malloc.tcache_count=0:glibc.malloc.mxfast=0");
    return variables;
}

void take_line(CheckResult& result, bool& is_done, const std::string& line) {
    const std::string text = line.substr(std::min<std::size_t>(1, line.size()));
    switch (line.empty() ? '\0' : line[0]) {
    case failure_mark:
        result.outcome = Outcome::failed;
        result.findings.push_back(text);
        break;
    case note_mark:
        result.notes.push_back(text);
        break;
    case progress_mark:
        result.progress = text;
        break;
    case skipped_mark:
        result.outcome = Outcome::skipped;
        result.findings.push_back(text);
        break;
    case not_applicable_mark:
        result.outcome = Outcome::not_applicable;
        result.findings.push_back(text);
        break;
    case done_mark:
        is_done = true;
        break;
    default:
        break;
    }
}

} // namespace

const char* outcome_name(Outcome outcome) {
    constexpr std::array<const char*, 6> names{"passed", "failed", "crashed", "timed-out", "skipped", "not-applicable"};
    return names[static_cast<std::size_t>(outcome)];
}

const Check* find_check(const std::string& name) {
    const auto& checks = all_checks();
    const auto found = std::find_if(checks.begin(), checks.end(), [&](const Check& check) { return name == check.name; });
    return found == checks.end() ? nullptr : &*found;
}

CheckResult run_in_process(const Check& check, const Subject& subject, double timeout_seconds) {
    CheckResult result;
    result.check = &check;
    const auto begin = Clock::now();
    // What a killed process leaves in the temporary folder goes with this one.
    const TemporaryFolder scratch;
    const std::string log = scratch.write("output.txt", "");
    const int output = ::open(log.c_str(), O_RDWR | O_CLOEXEC);
    if (output < 0) {
        throw Error(log, "cannot be opened: " + std::string(std::strerror(errno)));
    }
    ChildProcess process({arguments_of(check, subject), environment_of(scratch.path("")), output}, "a process for the check");
    bool is_done = false;
    const auto deadline = begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout_seconds));
    std::string line;
    ChildProcess::Read read = process.read_line(line, deadline);
    for (; read == ChildProcess::Read::line; read = process.read_line(line, deadline)) {
        take_line(result, is_done, line);
    }
    const bool in_time = read == ChildProcess::Read::end;
    if (!in_time) {
        process.kill();
    }
    const int status = process.wait();
    result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (!in_time) {
        result.outcome = Outcome::timed_out;
        result.findings.push_back("no end after " + std::to_string(static_cast<int>(timeout_seconds)) +
                                  " s; last: " + result.progress);
    } else if (!is_done) {
        const char* in_the_middle = WIFSIGNALED(status) ? "" : " in the middle of the check";
        result.outcome = Outcome::crashed;
        result.findings.push_back("the process " + ending_text(status) + in_the_middle + "; last: " + result.progress);
        if (const std::string said = last_output(output); !said.empty()) {
            result.findings.push_back("it wrote: " + said);
        }
    } else if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        result.outcome = Outcome::crashed;
        result.findings.push_back("the process " + ending_text(status) + ", after the check");
    }
    ::close(output);
    return result;
}

void run_here(const Check& check, const Subject& subject, int answer_descriptor) {
    ::fcntl(answer_descriptor, F_SETFD, FD_CLOEXEC); // not for what the plugin starts
    std::mutex mutex;
    const Reporter reporter{[&](Reporter::Kind kind, const std::string& text) {
        const std::lock_guard lock(mutex);
        write_answer(answer_descriptor,
                     kind == Reporter::Kind::failure ? failure_mark
                     : kind == Reporter::Kind::note  ? note_mark
                                                     : progress_mark,
                     text);
    }};
    Context context(subject, reporter);
    try {
        check.run(context);
    } catch (const NotApplicable& reason) {
        write_answer(answer_descriptor, not_applicable_mark, reason.what());
    } catch (const Skipped& skipped) {
        write_answer(answer_descriptor, skipped_mark, skipped.what());
    } catch (const std::exception& error) {
        context.fail(error.what());
    }
    write_answer(answer_descriptor, done_mark, "");
}

} // namespace elvis::conformance
