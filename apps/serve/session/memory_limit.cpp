#include "memory_limit.hpp"

#include <core/base/error.hpp>
#include <core/base/memory.hpp>

#include <nlohmann/json.hpp>

namespace elvis::serve {

namespace {

using Clock = std::chrono::steady_clock;

constexpr unsigned mebi = 20;
/** What work may take between two looks; kernels are the library's matter (elvis_context_limit_memory). */
constexpr std::uint64_t margin_bytes = std::uint64_t{16} << mebi;
constexpr std::chrono::milliseconds between_looks{5};

bool is_room(const Served& served, std::uint64_t more) { return held_bytes(served) + more + margin_bytes <= served.most_bytes; }

} // namespace

std::string limit_text(const Served& served) {
    return std::to_string(served.most_bytes >> mebi) + " MiB that it may (--memory)";
}

std::uint64_t held_bytes(const Served& served) {
    if (!served.has_device_memory) {
        return resident_bytes();
    }
    const auto device = nlohmann::json::parse(served.library.describe_device());
    return resident_bytes() + device.value("allocated_bytes", std::uint64_t{0});
}

bool is_memory_exceeded(const Served& served) { return served.most_bytes > 0 && !is_room(served, 0); }

void need_memory(const Served& served, std::uint64_t more) {
    if (served.most_bytes == 0 || is_room(served, more)) {
        return;
    }
    served.library.free_memory();
    if (is_room(served, more)) {
        return;
    }
    std::string text = "the server holds " + std::to_string(held_bytes(served) >> mebi) + " of the " + limit_text(served);
    if (more > 0) {
        text += ", and this would take some " + std::to_string(more >> mebi) + " more";
    }
    throw Error(text + "; the last " + std::to_string(margin_bytes >> mebi) + " are kept free");
}

bool MemoryWatch::is_exceeded() {
    if (m_served.most_bytes == 0) {
        return false;
    }
    const Clock::rep now = Clock::now().time_since_epoch().count();
    if (now >= m_next) {
        m_next = now + Clock::duration(between_looks).count();
        m_is_exceeded = m_is_exceeded || is_memory_exceeded(m_served);
    }
    return m_is_exceeded;
}

} // namespace elvis::serve
