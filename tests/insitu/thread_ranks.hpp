/**
 * @file thread_ranks.hpp
 * Threads of one process as ranks that talk to each other.
 */
#pragma once

#include <elvis/insitu.h>

#include <barrier>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace elvis::test {

/** Runs a function as several ranks at the same time. */
class ThreadRanks {
public:
    explicit ThreadRanks(std::uint32_t size) : m_size(size), m_all(size), m_numbers(size), m_bytes(size) {}
    ThreadRanks(const ThreadRanks&) = delete;
    ThreadRanks& operator=(const ThreadRanks&) = delete;

    void run(const std::function<void(const elvis_communicator&)>& what);

private:
    /** What a table's `user` is. */
    struct Rank {
        ThreadRanks* ranks;
        std::uint32_t rank;
    };

    void minimum(std::uint32_t rank, std::span<double> numbers);
    void broadcast(std::uint32_t root, std::uint32_t rank, void* bytes, std::uint64_t n_bytes);
    void exchange(std::uint32_t rank, std::span<const elvis_message> sent, std::span<const elvis_message> received);

    std::uint32_t m_size;
    std::barrier<> m_all;
    std::vector<std::vector<double>> m_numbers;
    std::vector<const void*> m_bytes;
    /** By sender and receiver. */
    std::map<std::pair<std::uint32_t, std::uint32_t>, elvis_message> m_messages;
};

} // namespace elvis::test
