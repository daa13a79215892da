#include "crash_report.hpp"

#include <core/plugin_host/current_call.hpp>

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>

namespace elvis {

namespace {

constexpr std::array<int, 5> signals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

/** Safe in a signal handler. */
void write_text(const char* text) {
    if ([[maybe_unused]] const ssize_t n = ::write(STDERR_FILENO, text, std::strlen(text)); n < 0) {
        return; // Nobody is left to be told.
    }
}

void on_crash(int signal) {
    if (const char* plugin = current_call::plugin()) {
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
