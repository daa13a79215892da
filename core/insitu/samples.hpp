/**
 * @file samples.hpp
 * Values of a volume on several ranks at points.
 */
#pragma once

#include "plan.hpp"
#include "table_file.hpp"

#include <core/api/columns.hpp>
#include <core/probe/probe.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace elvis::library {

/** A table that the first rank writes: a row for each step and point. */
class Samples {
public:
    /** `path` of the table. All must outlive it. Throws Error for values that the volume does not have. */
    Samples(const PlannedSamples& planned, const std::string& path, const InsituVolume& volume, CommunicatorTeam& team);

    /** Collective. `prober`: of own elements, or null. */
    void write(Prober* prober, std::uint64_t step, double time);

private:
    struct Row;
    std::vector<std::byte> own_rows(Prober* prober) const;

    const PlannedSamples& m_planned;
    CommunicatorTeam& m_team;
    Columns m_columns;
    std::optional<TableFile> m_file;
};

} // namespace elvis::library
