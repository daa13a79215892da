/**
 * @file ranks.hpp
 * What ranks agree on about a volume of which each has some elements.
 */
#pragma once

#include "communicator_team.hpp"

#include <core/parts/partition.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/volume/outline.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace elvis::library {

/** Collective. Throws InvalidArgument, which says `what`, on ranks whose text is not that of rank 0. */
void need_same_on_all(const std::string& text, CommunicatorTeam& team, const char* argument, const char* what);

/** One part a rank. */
struct ElementsOfRanks {
    Partition partition;
    /** By class, on all ranks together. */
    std::vector<std::uint64_t> n_elements;
};

/** Collective. In each class elements are counted rank by rank. `own`: how many this rank has, by class. */
ElementsOfRanks elements_of_ranks(std::span<const std::uint64_t> own, CommunicatorTeam& team, const char* argument);

/** What is asked by all ranks together: the element's rank tells all. All must outlive it. */
MappingReader mapping_of_ranks(const RuntimeVolume& whole, const Partition& partition, CommunicatorTeam& team);

} // namespace elvis::library
