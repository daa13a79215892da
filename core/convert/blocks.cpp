#include <core/convert/blocks.hpp>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace elvis {

unsigned n_workers() { return std::max(1u, std::thread::hardware_concurrency()); }

void for_each_part(std::uint64_t count, std::uint64_t part_size,
                   const std::function<void(unsigned worker, std::uint64_t first, std::uint64_t last)>& work) {
    std::atomic<std::uint64_t> next{0};
    std::mutex mutex;
    std::exception_ptr failure;
    const auto run = [&](unsigned worker) {
        try {
            for (std::uint64_t first = next.fetch_add(part_size); first < count; first = next.fetch_add(part_size)) {
                work(worker, first, std::min(first + part_size, count));
            }
        } catch (...) {
            const std::lock_guard lock(mutex);
            if (!failure) {
                failure = std::current_exception();
            }
            next = count;
        }
    };
    {
        std::vector<std::jthread> threads;
        for (unsigned worker = 1; worker < n_workers() && worker * part_size < count; ++worker) {
            threads.emplace_back(run, worker);
        }
        run(0);
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
}

} // namespace elvis
