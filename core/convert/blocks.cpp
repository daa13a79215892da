#include <core/convert/blocks.hpp>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace elvis {

namespace {

/** Runs work(worker) on as many threads as are useful; throws what the first that failed threw, after `stop` has been called.
 */
template <class Work, class Stop> void run_workers(std::uint64_t n_tasks, Work&& work, Stop&& stop) {
    std::mutex mutex;
    std::exception_ptr failure;
    const auto run = [&](unsigned worker) {
        try {
            work(worker);
        } catch (...) {
            const std::lock_guard lock(mutex);
            if (!failure) {
                failure = std::current_exception();
                stop();
            }
        }
    };
    {
        std::vector<std::jthread> threads;
        for (unsigned worker = 1; worker < n_workers() && worker < n_tasks; ++worker) {
            threads.emplace_back(run, worker);
        }
        run(0);
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
}

} // namespace

unsigned n_workers() { return std::max(1u, std::thread::hardware_concurrency()); }

void for_each_part(std::uint64_t count, std::uint64_t part_size,
                   const std::function<void(std::uint64_t first, std::uint64_t last)>& work) {
    std::atomic<std::uint64_t> next{0};
    run_workers((count + part_size - 1) / part_size,
                [&](unsigned) {
                    for (std::uint64_t first = next.fetch_add(part_size); first < count; first = next.fetch_add(part_size)) {
                        work(first, std::min(first + part_size, count));
                    }
                },
                [&] { next = count; });
}

void for_each_block(std::uint64_t n_blocks, const std::function<void(std::uint64_t block, unsigned worker)>& compute,
                    const std::function<void(std::uint64_t block, unsigned worker)>& commit) {
    std::atomic<std::uint64_t> next{0};
    std::mutex mutex;
    std::condition_variable turn;
    std::uint64_t n_committed = 0;
    bool is_stopped = false;
    run_workers(
        n_blocks,
        [&](unsigned worker) {
            for (std::uint64_t block = next++; block < n_blocks; block = next++) {
                compute(block, worker);
                std::unique_lock lock(mutex);
                turn.wait(lock, [&] { return is_stopped || n_committed == block; });
                if (is_stopped) {
                    return;
                }
                // Only this worker can have its turn now: others go on computing.
                lock.unlock();
                commit(block, worker);
                lock.lock();
                ++n_committed;
                turn.notify_all();
            }
        },
        [&] {
            next = n_blocks;
            const std::lock_guard lock(mutex);
            is_stopped = true;
            turn.notify_all();
        });
}

} // namespace elvis
