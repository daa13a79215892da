#include <core/base/in_parts.hpp>

#include <algorithm>
#include <memory>
#include <vector>

namespace elvis {

void in_parts(Background& background, std::uint64_t n, std::uint64_t part,
              const std::function<void(std::uint64_t first, std::uint64_t count)>& work, const std::function<void()>& check) {
    std::vector<std::shared_ptr<Background::Work>> parts;
    parts.reserve(n / part + 1);
    try {
        for (std::uint64_t first = 0; first < n; first += part) {
            parts.push_back(background.hand_over([&work, first, count = std::min(part, n - first)] { work(first, count); }));
        }
        for (const auto& each : parts) {
            if (check) {
                check();
            }
            each->wait();
        }
    } catch (...) {
        for (const auto& each : parts) {
            each->drop();
        }
        throw;
    }
}

} // namespace elvis
