#include <core/conformance/pieces.hpp>

#include <core/conformance/random.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <thread>

namespace elvis::conformance {

namespace {

bool is_same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/** Whether items first .. first+count-1 of `whole` are `piece`. */
bool is_piece(const std::vector<double>& whole, const std::vector<double>& piece, std::uint64_t n_items, std::uint64_t first,
              std::uint64_t count) {
    const std::size_t width = whole.size() / n_items;
    return piece.size() == width * count &&
           std::equal(piece.begin(), piece.end(), whole.begin() + static_cast<std::ptrdiff_t>(first * width), is_same);
}

std::string range_text(std::uint64_t first, std::uint64_t count) {
    return "items " + std::to_string(first) + " to " + std::to_string(first + count - 1);
}

/** Width is that of one item only if all items are of the same size. */
bool has_equal_items(const std::vector<double>& whole, const Query& query) {
    return query.n_items > 0 && whole.size() % query.n_items == 0;
}

} // namespace

void check_pieces(Context& context, const std::vector<Query>& queries) {
    Random random(context.subject().seed);
    for (const Query& query : queries) {
        if (query.n_items == 0) {
            continue;
        }
        context.progress(query.name);
        const std::vector<double> whole = query.ask(0, query.n_items);
        for (int i = 0; i < 12 && has_equal_items(whole, query); ++i) {
            const std::uint64_t first = i == 0 ? query.n_items - 1 : random.below(query.n_items);
            const std::uint64_t count = 1 + random.below(std::min<std::uint64_t>(query.n_items - first, 40));
            context.progress(query.name + ", " + range_text(first, count));
            if (!is_piece(whole, query.ask(first, count), query.n_items, first, count)) {
                context.fail(query.name + ": " + range_text(first, count) + " differ from what the whole gave for them");
                break;
            }
        }
    }
}

void check_threads(Context& context, const std::vector<Query>& queries) {
    constexpr std::chrono::seconds time_limit{5};
    std::vector<std::vector<double>> expected;
    for (const Query& query : queries) {
        expected.push_back(query.n_items > 0 ? query.ask(0, query.n_items) : std::vector<double>{});
    }
    context.progress("calls from four threads");
    std::mutex mutex;
    std::string complaint;
    const auto work = [&](std::uint64_t seed) {
        Random random(seed);
        const auto begin = std::chrono::steady_clock::now();
        try {
            for (int round = 0; round < 400 && std::chrono::steady_clock::now() - begin < time_limit; ++round) {
                const std::size_t which = random.below(queries.size());
                const Query& query = queries[which];
                if (query.n_items == 0 || !has_equal_items(expected[which], query)) {
                    continue;
                }
                const std::uint64_t first = random.below(query.n_items);
                const std::uint64_t count = 1 + random.below(std::min<std::uint64_t>(query.n_items - first, 40));
                if (!is_piece(expected[which], query.ask(first, count), query.n_items, first, count)) {
                    const std::lock_guard lock(mutex);
                    complaint =
                        query.name + ": " + range_text(first, count) + " differ when other threads ask at the same time";
                    return;
                }
            }
        } catch (const std::exception& error) {
            const std::lock_guard lock(mutex);
            complaint = error.what();
        }
    };
    std::vector<std::thread> threads;
    for (std::uint64_t i = 0; i < 4; ++i) {
        threads.emplace_back(work, context.subject().seed + i);
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    if (!complaint.empty()) {
        context.fail(complaint);
    }
}

} // namespace elvis::conformance
