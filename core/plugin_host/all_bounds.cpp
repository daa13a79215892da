#include <core/plugin_host/all_bounds.hpp>

#include <core/base/background.hpp>
#include <core/base/in_parts.hpp>

#include <algorithm>
#include <mutex>
#include <span>
#include <thread>

namespace elvis {

namespace {

constexpr std::uint64_t elements_a_part = 4096;

} // namespace

std::vector<double> all_bounds(const RuntimeVolume& volume, elvis_certainty& certainty) {
    std::vector<double> boxes(6 * volume.n_elements());
    std::mutex mutex;
    certainty = ELVIS_CERTIFIED;
    Background background(std::max(1u, std::thread::hardware_concurrency()));
    in_parts(background, volume.n_elements(), elements_a_part, [&](std::uint64_t first, std::uint64_t count) {
        const elvis_certainty of_part = volume.bounds(first, count, std::span(boxes).subspan(6 * first, 6 * count));
        const std::lock_guard lock(mutex);
        certainty = std::max(certainty, of_part); // The less sure, the larger.
    });
    return boxes;
}

std::vector<double> all_bounds(const RuntimeVolume& volume) {
    elvis_certainty certainty = ELVIS_ESTIMATED;
    return all_bounds(volume, certainty);
}

} // namespace elvis
