#include "crash_report.hpp"

#include <core/plugin_host/current_call.hpp>

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstring>

namespace elvis {

namespace {

constexpr std::array<int, 5> signals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

/** Where crashes are told, and the mark before them; none: stderr, in words. */
std::atomic<int> answer{-1};
std::atomic<char> answer_mark{' '};

/** Safe in a signal handler. */
void write_text(const char* text, int descriptor = STDERR_FILENO) {
    if ([[maybe_unused]] const ssize_t n = ::write(descriptor, text, std::strlen(text)); n < 0) {
        return; // Nobody is left to be told.
    }
}

void tell(int descriptor, const char* plugin, const char* function) {
    const std::array<char, 2> mark{answer_mark.load(), '\0'};
    write_text(mark.data(), descriptor);
    write_text(plugin, descriptor);
    write_text("\x1f", descriptor);
    write_text(function, descriptor);
    write_text("\n", descriptor);
}

void on_crash(int signal) {
    const char* plugin = current_call::plugin();
    if (const int descriptor = answer.load(); plugin != nullptr && descriptor >= 0) {
        tell(descriptor, plugin, current_call::function());
    } else if (plugin != nullptr) {
        write_text("elvis: the plugin ");
        write_text(plugin);
        write_text(" crashed in its function ");
        write_text(current_call::function());
        write_text("; nothing was saved (elvis check-plugin tells more about it)\n");
    }
    // The handler was taken away when it was entered: the signal now does what it would have done.
    ::raise(signal);
}

} // namespace

void report_crashes_to(int descriptor, char mark) {
    answer_mark = mark;
    answer = descriptor;
}

void report_crashes() {
    // A stack of its own, for stacks that overflow. Recursion without end is the commonest crash of readers.
    alignas(16) static std::array<char, 65536> memory;
    stack_t stack{};
    stack.ss_sp = memory.data();
    stack.ss_size = memory.size();
    ::sigaltstack(&stack, nullptr);
    for (const int signal : signals) {
        struct sigaction current {};
        ::sigaction(signal, nullptr, &current);
        if (current.sa_handler != SIG_DFL) {
            continue; // A sanitizer's, which says more.
        }
        struct sigaction action {};
        action.sa_handler = on_crash;
        action.sa_flags = static_cast<int>(SA_RESETHAND | SA_ONSTACK | SA_NODEFER);
        ::sigemptyset(&action.sa_mask);
        ::sigaction(signal, &action, nullptr);
    }
}

} // namespace elvis
