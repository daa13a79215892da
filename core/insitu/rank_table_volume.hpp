/**
 * @file rank_table_volume.hpp
 * A solver's volume that the functions of each of its ranks serve.
 */
#pragma once

#include "communicator_team.hpp"
#include "insitu_volume.hpp"
#include "rank_table.hpp"
#include "table_volume.hpp"

#include <elvis/runtime.h>

#include <memory>
#include <optional>
#include <string>

namespace elvis::library {

/** Elements around a rank's own are there if its own functions serve them, too: what they mean only those know. */
class RankTableVolume final : public InsituVolume {
public:
    /**
     * Collective. `is_own`: of each element that the table serves whether it is the rank's own; null if all are. `name` stands
     * for the volume in messages. The team must outlive it. Throws Error.
     */
    RankTableVolume(const elvis_runtime& table, elvis_volume* volume, const std::uint8_t* is_own, const std::string& name,
                    CommunicatorTeam& team);

    const RuntimeVolume& whole() const override { return *m_whole; }
    const RuntimeVolume* own() const override { return m_own ? &m_own->volume : nullptr; }
    const PartedVolume* parted() const override { return m_parted.get(); }
    const Partition* partition() const override { return &*m_partition; }

    void set_values(std::uint32_t field, std::uint32_t element_class, const double* values) override {
        m_served.set_values(field, element_class, values);
    }
    std::uint64_t read_values() override { return 0; }
    std::vector<std::uint32_t> share_values() override { return m_served.share_values(); }

private:
    /** Of this rank. */
    TableVolume m_served;
    std::optional<Partition> m_partition;
    std::optional<RuntimeVolume> m_whole;
    std::unique_ptr<PartedVolume> m_parted;
    std::optional<OpenedElements> m_own;
};

} // namespace elvis::library
