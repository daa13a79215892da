/**
 * @file child_process.hpp
 * This program once more, as a process of its own, for what may crash or hang.
 */
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace elvis {

/**
 * Runs `/proc/self/exe` in a process group of its own, without core files. The process writes lines to its descriptor `answer`,
 * a pipe that is read here.
 */
class ChildProcess {
public:
    using Clock = std::chrono::steady_clock;
    /** The descriptor to which the other side writes its lines. */
    static constexpr int answer = 3;

    struct Start {
        /** The first is the program's name. */
        std::vector<std::string> arguments;
        /** "NAME=value", all of them. */
        std::vector<std::string> environment;
        /** Where its stdout and stderr go. */
        int output = 2;
        /** It ends when the thread that started it does. */
        bool ends_with_parent = false;
        /** Where memory runs out, the system ends this process first. */
        bool is_first_to_go = false;
    };
    /** Throws Error, with `place` what it is for, if it cannot be started. */
    ChildProcess(Start start, const std::string& place);
    /** Ends it, if it still runs, together with what it started. */
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    enum class Read { line, end, time_up };
    /** The next line of the answer, if it comes before the deadline. `end`: the process has closed its side. */
    Read read_line(std::string& line, Clock::time_point deadline);

    void signal(int number) const;
    /** To the process and all that it started; none can refuse. */
    void kill() const;
    /** Until it has ended; returns the status that waitpid gives. */
    int wait();
    /** The same, but what has not ended at the deadline is killed. */
    int wait_until(Clock::time_point deadline);
    std::uint64_t resident_bytes() const;

private:
    pid_t m_process = -1;
    int m_descriptor = -1;
    int m_status = 0;
    std::string m_pending;
};

/** The variables of this process but for those named; "NAME=value". */
std::vector<std::string> environment_without(const std::vector<std::string>& names);

/** The other side's: one line with a letter in front of the text, whose own line breaks read_line gives back. */
void write_answer(int descriptor, char mark, std::string text);

/** "was ended by signal 11 (Segmentation fault)" or "ended with status 3". */
std::string ending_text(int status);

/** The last lines of a file that a process wrote to, without the break at the end. */
std::string last_output(int descriptor);

} // namespace elvis
