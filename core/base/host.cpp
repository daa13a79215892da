#include <core/base/host.hpp>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace elvis {

namespace {

thread_local const Host* of_this_thread = nullptr;

} // namespace

std::vector<std::filesystem::path> split_folders(std::string_view list) {
    std::vector<std::filesystem::path> folders;
    while (!list.empty()) {
        const std::size_t end = std::min(list.find(':'), list.size());
        if (end > 0) {
            folders.emplace_back(list.substr(0, end));
        }
        list.remove_prefix(std::min(end + 1, list.size()));
    }
    return folders;
}

Host& program_host() {
    static Host host;
    return host;
}

const Host& host() { return of_this_thread != nullptr ? *of_this_thread : program_host(); }

HostScope::HostScope(const Host& host) : m_before(std::exchange(of_this_thread, &host)) {}

HostScope::~HostScope() { of_this_thread = m_before; }

std::optional<std::string> environment_variable(const char* name) {
    const char* value = host().reads_environment ? std::getenv(name) : nullptr;
    return value != nullptr && *value != '\0' ? std::optional<std::string>(value) : std::nullopt;
}

} // namespace elvis
