#include <core/conformance/runner.hpp>

#include <core/base/error.hpp>
#include <core/conformance/scratch.hpp>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
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
constexpr char done_mark = 'D';

void write_line(int descriptor, char mark, std::string text) {
    std::replace(text.begin(), text.end(), '\n', '\x1f'); // one line a message; read_line turns it back
    text.insert(text.begin(), mark);
    text += '\n';
    for (std::size_t written = 0; written < text.size();) {
        const ssize_t n = ::write(descriptor, text.data() + written, text.size() - written);
        if (n <= 0) {
            return; // The reader is gone: nobody is there to be told.
        }
        written += static_cast<std::size_t>(n);
    }
}

std::vector<std::string> arguments_of(const Check& check, const Subject& subject, int descriptor) {
    std::vector<std::string> arguments{"elvis",        "--quiet",
                                       "check-plugin", subject.library,
                                       "--in-process", check.name,
                                       "--answer",     std::to_string(descriptor),
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
    std::vector<std::string> variables{"TMPDIR=" + temporary_folder,
                                       "GLIBC_TUNABLES=glibc.malloc.tcache_count=0:glibc.malloc.mxfast=0"};
    for (char** variable = environ; *variable; ++variable) {
        const std::string text = *variable;
        if (text.rfind("TMPDIR=", 0) != 0 && text.rfind("GLIBC_TUNABLES=", 0) != 0) {
            variables.push_back(text);
        }
    }
    return variables;
}

/** As exec wants it; the strings must live on. */
std::vector<char*> pointers_to(std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    for (std::string& text : texts) {
        pointers.push_back(text.data());
    }
    pointers.push_back(nullptr);
    return pointers;
}

/** After fork: only what is safe there. `output`: where stdout and stderr go. */
[[noreturn]] void become(const std::vector<char*>& arguments, const std::vector<char*>& environment, int output) {
    ::setpgid(0, 0); // of its own, so that what the plugin starts ends with it
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    ::dup2(output, STDOUT_FILENO);
    ::dup2(output, STDERR_FILENO);
    ::execve("/proc/self/exe", arguments.data(), environment.data());
    ::_exit(127);
}

void take_line(CheckResult& result, bool& is_done, std::string line) {
    std::replace(line.begin(), line.end(), '\x1f', '\n');
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
    case done_mark:
        is_done = true;
        break;
    default:
        break;
    }
}

/** The last lines that the process wrote, for crashes: assertions and sanitizers speak there. */
std::string last_output(int descriptor) {
    std::array<char, 600> tail{};
    const off_t size = ::lseek(descriptor, 0, SEEK_END);
    const off_t from = std::max<off_t>(0, size - static_cast<off_t>(tail.size()));
    const ssize_t n = ::pread(descriptor, tail.data(), tail.size(), from);
    std::string text(tail.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
    while (!text.empty() && text.back() == '\n') {
        text.pop_back();
    }
    return text;
}

std::string how_it_ended(int status) {
    if (WIFSIGNALED(status)) {
        return std::string("the process was ended by signal ") + std::to_string(WTERMSIG(status)) + " (" +
               ::strsignal(WTERMSIG(status)) + ")";
    }
    return "the process ended with status " + std::to_string(WEXITSTATUS(status)) + " in the middle of the check";
}

/** Reads until the process closes its end or time is up; false in that case. */
bool read_answer(int descriptor, Clock::time_point deadline, CheckResult& result, bool& is_done) {
    std::string pending;
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
        pollfd waiting{descriptor, POLLIN, 0};
        if (left <= 0 || ::poll(&waiting, 1, static_cast<int>(left)) == 0) {
            return false;
        }
        std::array<char, 4096> buffer;
        const ssize_t n = ::read(descriptor, buffer.data(), buffer.size());
        if (n <= 0) {
            return true;
        }
        pending.append(buffer.data(), static_cast<std::size_t>(n));
        for (std::size_t end = pending.find('\n'); end != std::string::npos; end = pending.find('\n')) {
            take_line(result, is_done, pending.substr(0, end));
            pending.erase(0, end + 1);
        }
    }
}

} // namespace

const char* outcome_name(Outcome outcome) {
    constexpr std::array<const char*, 5> names{"passed", "failed", "crashed", "timed-out", "skipped"};
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
    const ScratchFolder scratch;
    const std::string log = scratch.write("output.txt", "");
    int ends[2];
    const int output = ::open(log.c_str(), O_RDWR | O_CLOEXEC);
    if (output < 0 || ::pipe(ends) != 0) {
        throw Error("a process for the check", "cannot be started: " + std::string(std::strerror(errno)));
    }
    ::fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    std::vector<std::string> arguments = arguments_of(check, subject, ends[1]);
    std::vector<std::string> environment = environment_of(scratch.path(""));
    const std::vector<char*> argument_pointers = pointers_to(arguments);
    const std::vector<char*> environment_pointers = pointers_to(environment);
    const pid_t process = ::fork();
    if (process == 0) {
        become(argument_pointers, environment_pointers, output);
    }
    ::close(ends[1]);
    bool is_done = false;
    const auto deadline = begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout_seconds));
    const bool in_time = process > 0 && read_answer(ends[0], deadline, result, is_done);
    ::close(ends[0]);
    int status = 0;
    if (process > 0) {
        if (!in_time) {
            ::kill(-process, SIGKILL);
        }
        ::waitpid(process, &status, 0);
    }
    result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (!in_time) {
        result.outcome = Outcome::timed_out;
        result.findings.push_back("no end after " + std::to_string(static_cast<int>(timeout_seconds)) +
                                  " s; last: " + result.progress);
    } else if (!is_done) {
        result.outcome = Outcome::crashed;
        result.findings.push_back(how_it_ended(status) + "; last: " + result.progress);
        if (const std::string said = last_output(output); !said.empty()) {
            result.findings.push_back("it wrote: " + said);
        }
    } else if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        result.outcome = Outcome::crashed;
        result.findings.push_back(how_it_ended(status) + ", after the check");
    }
    ::close(output);
    return result;
}

void run_here(const Check& check, const Subject& subject, int answer_descriptor) {
    ::fcntl(answer_descriptor, F_SETFD, FD_CLOEXEC); // not for what the plugin starts
    std::mutex mutex;
    const Reporter reporter{[&](Reporter::Kind kind, const std::string& text) {
        const std::lock_guard lock(mutex);
        write_line(answer_descriptor,
                   kind == Reporter::Kind::failure ? failure_mark
                   : kind == Reporter::Kind::note  ? note_mark
                                                   : progress_mark,
                   text);
    }};
    Context context(subject, reporter);
    try {
        check.run(context);
    } catch (const Skipped& skipped) {
        write_line(answer_descriptor, skipped_mark, skipped.what());
    } catch (const std::exception& error) {
        context.fail(error.what());
    }
    write_line(answer_descriptor, done_mark, "");
}

} // namespace elvis::conformance
