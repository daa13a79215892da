#include <core/base/child_process.hpp>

#include <core/base/error.hpp>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <thread>

namespace elvis {

namespace {

/** Stands for line breaks within a line. */
constexpr char line_break = '\x1f';

/** As exec wants it; the strings must live on. */
std::vector<char*> pointers_to(std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    for (std::string& text : texts) {
        pointers.push_back(text.data());
    }
    pointers.push_back(nullptr);
    return pointers;
}

/** After fork: only what is safe there. */
[[noreturn]] void become(const std::vector<char*>& arguments, const std::vector<char*>& environment,
                         const ChildProcess::Start& start, int answer, pid_t parent) {
    ::setpgid(0, 0); // of its own, so that what it starts ends with it
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    if (start.ends_with_parent) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != parent) {
            ::_exit(127); // It has gone already.
        }
    }
    if (start.is_first_to_go) {
        const int file = ::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
        if (file >= 0 && ::write(file, "1000", 4) < 0) {
            // Then it is one among others.
        }
    }
    ::dup2(start.output, STDOUT_FILENO);
    ::dup2(start.output, STDERR_FILENO);
    if (answer == ChildProcess::answer) {
        ::fcntl(answer, F_SETFD, 0);
    } else {
        ::dup2(answer, ChildProcess::answer);
    }
    ::execve("/proc/self/exe", arguments.data(), environment.data());
    ::_exit(127);
}

} // namespace

ChildProcess::ChildProcess(Start start, const std::string& place) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) {
        throw Error(place, "a process cannot be started: " + std::string(std::strerror(errno)));
    }
    const std::vector<char*> arguments = pointers_to(start.arguments);
    const std::vector<char*> environment = pointers_to(start.environment);
    const pid_t parent = ::getpid();
    m_process = ::fork();
    if (m_process == 0) {
        become(arguments, environment, start, ends[1], parent);
    }
    const int reason = errno;
    ::close(ends[1]);
    m_descriptor = ends[0];
    if (m_process < 0) {
        ::close(m_descriptor);
        throw Error(place, "a process cannot be started: " + std::string(std::strerror(reason)));
    }
    ::setpgid(m_process, m_process); // Here, too: kill() must find the group from the beginning.
}

ChildProcess::~ChildProcess() {
    ::close(m_descriptor);
    if (m_process > 0) {
        kill();
        wait();
    }
}

ChildProcess::Read ChildProcess::read_line(std::string& line, Clock::time_point deadline) {
    for (;;) {
        if (const std::size_t end = m_pending.find('\n'); end != std::string::npos) {
            line = m_pending.substr(0, end);
            std::replace(line.begin(), line.end(), line_break, '\n');
            m_pending.erase(0, end + 1);
            return Read::line;
        }
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
        pollfd waiting{m_descriptor, POLLIN, 0};
        const int n_ready = left <= 0 ? 0 : ::poll(&waiting, 1, static_cast<int>(std::min<long long>(left, 1 << 30)));
        if (n_ready < 0 && errno == EINTR) {
            continue;
        }
        if (n_ready == 0) {
            return Read::time_up;
        }
        std::array<char, 4096> buffer;
        const ssize_t n = ::read(m_descriptor, buffer.data(), buffer.size());
        if (n < 0 && errno == EINTR) {
            continue;
        }
        if (n <= 0) {
            return Read::end;
        }
        m_pending.append(buffer.data(), static_cast<std::size_t>(n));
    }
}

void ChildProcess::signal(int number) const {
    if (m_process > 0) {
        ::kill(m_process, number);
    }
}

void ChildProcess::kill() const {
    if (m_process > 0) {
        ::kill(-m_process, SIGKILL);
    }
}

int ChildProcess::wait() {
    while (m_process > 0 && ::waitpid(m_process, &m_status, 0) < 0 && errno == EINTR) {
    }
    m_process = -1;
    return m_status;
}

int ChildProcess::wait_until(Clock::time_point deadline) {
    while (m_process > 0 && Clock::now() < deadline) {
        if (::waitpid(m_process, &m_status, WNOHANG) == m_process) {
            m_process = -1;
            return m_status;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    kill();
    return wait();
}

std::uint64_t ChildProcess::resident_bytes() const {
    std::ifstream file("/proc/" + std::to_string(m_process) + "/statm");
    std::uint64_t all = 0, resident = 0;
    return file >> all >> resident ? resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

std::vector<std::string> environment_without(const std::vector<std::string>& names) {
    std::vector<std::string> variables;
    for (char** variable = environ; *variable != nullptr; ++variable) {
        const std::string text = *variable;
        if (std::find(names.begin(), names.end(), text.substr(0, text.find('='))) == names.end()) {
            variables.push_back(text);
        }
    }
    return variables;
}

void write_answer(int descriptor, char mark, std::string text) {
    std::replace(text.begin(), text.end(), '\n', line_break);
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

std::string ending_text(int status) {
    if (WIFSIGNALED(status)) {
        return std::string("was ended by signal ") + std::to_string(WTERMSIG(status)) + " (" + ::strsignal(WTERMSIG(status)) +
               ")";
    }
    return "ended with status " + std::to_string(WEXITSTATUS(status));
}

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

} // namespace elvis
