#include "ranks.hpp"

#include <core/api/call.hpp>

#include <algorithm>
#include <utility>

namespace elvis::library {

void need_same_on_all(const std::string& text, CommunicatorTeam& team, const char* argument, const char* what) {
    const std::vector<double> own(text.begin(), text.end());
    if (team.of_first(own) != own) {
        throw InvalidArgument(argument, what);
    }
}

ElementsOfRanks elements_of_ranks(std::span<const std::uint64_t> own, CommunicatorTeam& team, const char* argument) {
    const std::vector<double> counts = team.joined({own.begin(), own.end()});
    std::vector<std::vector<Span>> parts(team.size());
    std::vector<std::uint64_t> n_elements;
    std::uint64_t next = 0;
    for (std::size_t index = 0; index < own.size(); ++index) {
        const std::uint64_t first = next;
        for (std::uint32_t rank = 0; rank < team.size(); ++rank) {
            const auto n = static_cast<std::uint64_t>(counts[rank * own.size() + index]);
            if (n > 0) {
                parts[rank].push_back({next, next + n});
            }
            next += n;
        }
        n_elements.push_back(next - first);
    }
    if (next == 0) {
        throw InvalidArgument(argument, "no rank has an element");
    }
    return {Partition(std::move(parts)), std::move(n_elements)};
}

MappingReader mapping_of_ranks(const RuntimeVolume& whole, const Partition& partition, CommunicatorTeam& team) {
    return [&](std::uint64_t element, std::span<const double> xi, std::span<double> positions) {
        const std::uint32_t owner = partition.part_of(element);
        if (owner == team.rank()) {
            whole.evaluate_mapping(element, xi, positions, {});
        }
        team.broadcast(owner, std::as_writable_bytes(positions));
    };
}

} // namespace elvis::library
