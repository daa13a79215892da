/**
 * @file rank_volume.hpp
 * A solver's volume: each rank's own elements, with those around them that lie on other ranks.
 */
#pragma once

#include "communicator_team.hpp"
#include "insitu_volume.hpp"
#include "shared_volume.hpp"

#include <core/api/arrays.hpp>
#include <core/base/cancel.hpp>
#include <core/parts/parted_volume.hpp>
#include <core/parts/partition.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace elvis::library {

/** One part a rank. */
class RankVolume final : public InsituVolume {
public:
    /** Collective. `name` stands for the volume in messages. Team and control must outlive it. */
    RankVolume(const elvis_arrays& arrays, std::string name, CommunicatorTeam& team, const TaskControl& control);

    const PartedVolume* parted() const override { return m_parted.get(); }
    const Partition* partition() const override { return &*m_partition; }
    const RuntimeVolume& whole() const override { return *m_whole; }
    const RuntimeVolume* own() const override { return m_own ? &m_own->volume : nullptr; }

    void set_values(std::uint32_t field, std::uint32_t element_class, const double* values) override;
    std::uint64_t read_values() override;
    std::vector<std::uint32_t> share_values() override;

private:
    void count_elements();
    void find_surroundings();
    void share_mesh();
    void find_faces();
    void serve_own();
    /** Sends what `give` appends of own elements that others hold; `take` gets the same of others' elements held here. */
    template <class Give, class Take> void share(Give give, Take take);

    std::string m_name;
    CommunicatorTeam& m_team;
    const TaskControl& m_control;
    ArrayContents m_contents;
    /** The solver's, by field and class. */
    std::vector<std::vector<const double*>> m_values;
    std::shared_ptr<SharedVolume> m_source;
    std::optional<Partition> m_partition;
    std::optional<RuntimeVolume> m_whole;
    std::unique_ptr<PartedVolume> m_parted;
    std::optional<OpenedElements> m_own;
    /** Own elements, and those that are held, ascending. */
    std::vector<std::uint64_t> m_own_elements, m_held;
    /** By rank: own elements that it holds, and elements of it that this rank holds. */
    std::vector<std::vector<std::uint64_t>> m_given, m_taken;
    /** By class, of elements that are held: corner ids and groups of faces, as elvis_array_class has them. */
    std::vector<std::vector<std::int64_t>> m_corners;
    std::vector<std::vector<std::int32_t>> m_face_groups;
    /** Fields whose values were read and have not been shared. */
    std::vector<bool> m_is_changed;
};

} // namespace elvis::library
