#include "thread_ranks.hpp"

#include <algorithm>
#include <cstring>
#include <mutex>
#include <thread>

namespace elvis::test {

namespace {

std::mutex messages_mutex;

} // namespace

void ThreadRanks::run(const std::function<void(const elvis_communicator&)>& what) {
    std::vector<Rank> ranks;
    for (std::uint32_t rank = 0; rank < m_size; ++rank) {
        ranks.push_back({this, rank});
    }
    std::vector<std::jthread> threads;
    for (Rank& own : ranks) {
        elvis_communicator table{};
        table.struct_size = sizeof table;
        table.rank = own.rank;
        table.size = m_size;
        table.user = &own;
        table.minimum = [](void* user, double* numbers, std::uint64_t count) -> std::int32_t {
            const auto* self = static_cast<const Rank*>(user);
            self->ranks->minimum(self->rank, {numbers, count});
            return 0;
        };
        table.broadcast = [](void* user, std::uint32_t root, void* bytes, std::uint64_t n_bytes) -> std::int32_t {
            const auto* self = static_cast<const Rank*>(user);
            self->ranks->broadcast(root, self->rank, bytes, n_bytes);
            return 0;
        };
        table.exchange = [](void* user, const elvis_message* sent, std::uint32_t n_sent, const elvis_message* received,
                            std::uint32_t n_received) -> std::int32_t {
            const auto* self = static_cast<const Rank*>(user);
            self->ranks->exchange(self->rank, {sent, n_sent}, {received, n_received});
            return 0;
        };
        threads.emplace_back([table, &what] { what(table); });
    }
}

void ThreadRanks::minimum(std::uint32_t rank, std::span<double> numbers) {
    m_numbers[rank].assign(numbers.begin(), numbers.end());
    m_all.arrive_and_wait();
    for (const std::vector<double>& theirs : m_numbers) {
        std::ranges::transform(numbers, theirs, numbers.begin(), [](double a, double b) { return std::min(a, b); });
    }
    m_all.arrive_and_wait();
}

void ThreadRanks::broadcast(std::uint32_t root, std::uint32_t rank, void* bytes, std::uint64_t n_bytes) {
    m_bytes[rank] = bytes;
    m_all.arrive_and_wait();
    if (rank != root && n_bytes > 0) {
        std::memcpy(bytes, m_bytes[root], n_bytes);
    }
    m_all.arrive_and_wait();
}

void ThreadRanks::exchange(std::uint32_t rank, std::span<const elvis_message> sent, std::span<const elvis_message> received) {
    {
        const std::lock_guard lock(messages_mutex);
        for (const elvis_message& message : sent) {
            m_messages[{rank, message.rank}] = message;
        }
    }
    m_all.arrive_and_wait();
    for (const elvis_message& message : received) {
        const elvis_message& from = m_messages.at({message.rank, rank});
        std::memcpy(message.bytes, from.bytes, message.n_bytes);
    }
    m_all.arrive_and_wait();
}

} // namespace elvis::test
