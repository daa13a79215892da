#include "communicator_team.hpp"

#include <core/api/call.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace elvis::library {

namespace {

/** Another rank has failed; the text comes later. */
struct OtherFailed {
    std::uint32_t rank;
};

/** The communicator itself: there is no one to tell. */
class CommunicatorError : public Error {
public:
    using Error::Error;
};

std::span<std::byte> bytes_of(std::vector<double>& numbers) { return std::as_writable_bytes(std::span(numbers)); }

} // namespace

CommunicatorTeam::CommunicatorTeam(const elvis_communicator* communicator) {
    m_table = known_part(communicator, "communicator");
    if (m_table.size == 0 || m_table.rank >= m_table.size) {
        throw InvalidArgument("communicator", "rank " + std::to_string(m_table.rank) + " of " + std::to_string(m_table.size) +
                                                  " ranks is none");
    }
    if (m_table.minimum == nullptr || m_table.broadcast == nullptr || m_table.exchange == nullptr) {
        throw InvalidArgument("communicator", "one of its functions is NULL");
    }
}

void CommunicatorTeam::check(std::int32_t result, const char* function) const {
    if (result != 0) {
        throw CommunicatorError("communicator", std::string(function) + " failed on rank " + std::to_string(rank()) + ": " +
                                                    std::to_string(result));
    }
}

std::uint32_t CommunicatorTeam::lowest_failed(bool is_well) {
    double number = is_well ? size() : rank();
    check(m_table.minimum(m_table.user, &number, 1), "minimum");
    return static_cast<std::uint32_t>(number);
}

void CommunicatorTeam::agree() {
    if (const std::uint32_t failed = lowest_failed(true); failed < size()) {
        throw OtherFailed{failed};
    }
}

void CommunicatorTeam::minimum(std::span<double> numbers) {
    agree();
    check(m_table.minimum(m_table.user, numbers.data(), numbers.size()), "minimum");
}

void CommunicatorTeam::broadcast(std::uint32_t root, std::span<std::byte> bytes) {
    agree();
    m_sent_bytes += root == rank() ? bytes.size() * (size() - 1) : 0;
    check(m_table.broadcast(m_table.user, root, bytes.data(), bytes.size()), "broadcast");
}

std::vector<std::uint64_t> CommunicatorTeam::sizes_of_all(std::uint64_t own) {
    std::vector<double> sizes(size(), std::numeric_limits<double>::infinity());
    sizes[rank()] = static_cast<double>(own); // Exact below 2^53.
    minimum(sizes);
    return {sizes.begin(), sizes.end()};
}

std::vector<double> CommunicatorTeam::joined(std::vector<double> numbers) {
    const std::vector<std::uint64_t> sizes = sizes_of_all(numbers.size());
    std::vector<double> all;
    for (std::uint32_t from = 0; from < size(); ++from) {
        std::vector<double> theirs = from == rank() ? numbers : std::vector<double>(sizes[from]);
        broadcast(from, bytes_of(theirs));
        all.insert(all.end(), theirs.begin(), theirs.end());
    }
    return all;
}

std::vector<double> CommunicatorTeam::of_first(std::vector<double> numbers) {
    numbers.resize(sizes_of_all(numbers.size()).front());
    broadcast(0, bytes_of(numbers));
    return numbers;
}

std::vector<std::vector<std::byte>> CommunicatorTeam::gathered(std::vector<std::byte> bytes) {
    std::vector<std::vector<std::byte>> sent(size());
    sent.front() = std::move(bytes);
    std::vector<std::vector<std::byte>> received = exchanged(std::move(sent));
    return is_first() ? std::move(received) : std::vector<std::vector<std::byte>>{};
}

std::vector<std::vector<std::byte>> CommunicatorTeam::exchanged(std::vector<std::vector<std::byte>> sent) {
    std::vector<std::vector<std::byte>> received(size());
    // First how much, then what.
    std::vector<std::uint64_t> sent_sizes(size()), sizes(size());
    std::vector<elvis_message> to, from;
    for (std::uint32_t other = 0; other < size(); ++other) {
        sent_sizes[other] = sent[other].size();
        if (other != rank()) {
            to.push_back({other, 0, sizeof(std::uint64_t), &sent_sizes[other]});
            from.push_back({other, 0, sizeof(std::uint64_t), &sizes[other]});
        }
    }
    const auto exchange = [&] {
        agree();
        check(m_table.exchange(m_table.user, to.data(), static_cast<std::uint32_t>(to.size()), from.data(),
                               static_cast<std::uint32_t>(from.size())),
              "exchange");
    };
    exchange();
    to.clear();
    from.clear();
    for (std::uint32_t other = 0; other < size(); ++other) {
        if (other == rank()) {
            received[other] = std::move(sent[other]);
            continue;
        }
        received[other].resize(sizes[other]);
        m_sent_bytes += sent[other].size();
        if (!sent[other].empty()) {
            to.push_back({other, 0, sent[other].size(), sent[other].data()});
        }
        if (sizes[other] > 0) {
            from.push_back({other, 0, sizes[other], received[other].data()});
        }
    }
    exchange();
    return received;
}

void CommunicatorTeam::together(const std::function<void()>& what) {
    if (m_is_broken) {
        throw Error("in situ", "a call before this one has failed; the handle can only be released");
    }
    std::string text;
    std::uint32_t failed = size();
    try {
        what();
        failed = lowest_failed(true);
    } catch (const CommunicatorError&) {
        m_is_broken = true;
        throw;
    } catch (const OtherFailed& other) {
        failed = other.rank;
    } catch (const std::exception& error) {
        m_is_broken = true;
        text = error.what();
        failed = lowest_failed(false);
    }
    if (failed < size()) {
        m_is_broken = true;
        tell_failure(failed, std::move(text));
    }
}

void CommunicatorTeam::tell_failure(std::uint32_t failed, std::string own_text) {
    constexpr std::size_t most = 2000;
    own_text.resize(most); // With zeros: a text of a size that all know.
    check(m_table.broadcast(m_table.user, failed, own_text.data(), most), "broadcast");
    own_text.resize(own_text.find_last_not_of('\0') + 1);
    throw Error("rank " + std::to_string(failed), own_text);
}

} // namespace elvis::library
