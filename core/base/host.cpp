#include <core/base/host.hpp>

#include <cstdlib>
#include <utility>

namespace elvis {

namespace {

thread_local const Host* of_this_thread = nullptr;

} // namespace

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
