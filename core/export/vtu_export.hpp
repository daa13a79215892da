/**
 * @file vtu_export.hpp
 * From a volume to VTK's XML unstructured grid (.vtu), for ParaView and others.
 *
 * Every element becomes one Lagrange cell with points of its own, because fields may jump between elements. Geometry and
 * fields are sampled at the cell's nodes; where the cell's order contains theirs, the file holds the same functions but for
 * round-off. Fields of order 0 become cell data.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace elvis {

struct ExportOptions {
    std::uint32_t time_step = 0;
    /** Order of all cells; none: in each element the largest of geometry and fields. */
    std::optional<std::uint32_t> order;
};

struct ExportReport {
    std::uint64_t n_cells = 0;
    std::uint64_t n_points = 0;
    std::uint32_t largest_order = 0;
};

/**
 * Writes `output`, which appears only when everything is done. An Error tells what cannot be exported: volumes whose plugin
 * does not evaluate on the CPU, curved or high-order pyramids (VTK has no Lagrange pyramid), and
 * without ExportOptions::order fields that are not polynomial. Elements are in the order of their numbers. Memory does not grow
 * with the fields: it is about 16 bytes an element.
 */
ExportReport export_vtu(const RuntimeVolume& volume, const std::string& output, const ExportOptions& options,
                        const TaskControl& control);

} // namespace elvis
