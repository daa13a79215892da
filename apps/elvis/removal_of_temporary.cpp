#include "removal_of_temporary.hpp"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <system_error>

namespace elvis::commands {

namespace {

namespace fs = std::filesystem;

std::atomic<bool> is_to_end{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void on_end(int) { is_to_end = true; }

/** native::Writer's name for a file that is not done, but for the random number at its end. */
std::string beginning_of_name(const fs::path& output, std::int64_t writer) {
    return output.filename().string().append(".part-").append(std::to_string(writer)).append("-");
}

void remove_files(const fs::path& folder, const std::string& beginning) {
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
        if (entry.path().filename().string().starts_with(beginning)) {
            fs::remove(entry.path(), ignored);
        }
    }
}

} // namespace

RemovalOfTemporary::RemovalOfTemporary(const std::string& output, Team& team) : m_previous(std::signal(SIGTERM, on_end)) {
    const fs::path path = fs::absolute(output);
    const auto writer = static_cast<std::int64_t>(team.of_first({static_cast<double>(::getpid())}).front());
    m_watcher = std::jthread([path, beginning = beginning_of_name(path, writer)](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            if (is_to_end) {
                remove_files(path.parent_path(), beginning);
                constexpr int as_a_shell_says_it = 128 + SIGTERM;
                std::_Exit(as_a_shell_says_it);
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    });
}

RemovalOfTemporary::~RemovalOfTemporary() { std::signal(SIGTERM, m_previous); }

} // namespace elvis::commands
