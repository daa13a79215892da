#include "memory_limit.hpp"

#include <core/base/error.hpp>
#include <core/base/memory.hpp>

#include <nlohmann/json.hpp>

namespace elvis::serve {

std::uint64_t held_bytes(const Served& served) {
    const auto device = nlohmann::json::parse(served.library.describe_device());
    const bool is_apart = device.value("type", "") != "cpu";
    return resident_bytes() + (is_apart ? device.value("allocated_bytes", std::uint64_t{0}) : 0);
}

bool is_memory_exceeded(const Served& served) { return served.most_bytes > 0 && held_bytes(served) > served.most_bytes; }

void need_memory(const Served& served, std::uint64_t more) {
    if (served.most_bytes == 0) {
        return;
    }
    constexpr unsigned mebi = 20;
    const std::uint64_t held = held_bytes(served);
    if (held + more > served.most_bytes) {
        std::string text = "the server holds " + std::to_string(held >> mebi) + " of the " +
                           std::to_string(served.most_bytes >> mebi) + " MiB that it may (--memory)";
        if (more > 0) {
            text += ", and this would take " + std::to_string(more >> mebi) + " more";
        }
        throw Error(text);
    }
}

} // namespace elvis::serve
