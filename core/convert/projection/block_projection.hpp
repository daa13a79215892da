/**
 * @file block_projection.hpp
 * One block of elements of a class: sampled, projected and compared with the source.
 */
#pragma once

#include <core/convert/projection/class_kernel.hpp>
#include <core/convert/projection/field_plan.hpp>
#include <core/convert/topology/topology.hpp>

#include <elvis/native/volume_file.hpp>

#include <cstdint>
#include <vector>

namespace elvis {

/** What converting a block makes. Reused from block to block. */
struct BlockResult {
    std::uint64_t first = 0;
    std::uint64_t count = 0;
    /** As native::Writer takes them: geometry if it was asked for, and each field. */
    std::vector<double> geometry;
    std::vector<std::vector<double>> fields;
    /** Of each field: values at the points of all faces, [(element * n_components + component) * n_points + point]. */
    std::vector<std::vector<double>> at_faces;
    /** Geometry and fields as they will lie in the file, or nothing. */
    native::PackedRows packed_geometry;
    std::vector<native::PackedRows> packed_fields;

    double largest_distance = 0;
    std::vector<FieldMeasure> measures;
};

/** Reads source and matrices only: several threads may use one object, each with its own result. */
class BlockProjection {
public:
    BlockProjection(const SourceVolume& source, const std::vector<FieldPlan>& plans, const TargetClass& target,
                    const ClassKernel& kernel)
        : m_source(source), m_plans(plans), m_target(target), m_kernel(kernel) {}

    /** Elements first .. first+count-1 of the class. */
    void run(std::uint64_t first, std::uint64_t count, std::uint32_t time_step, bool with_geometry, const TaskControl& control,
             BlockResult& result) const;

private:
    void project_geometry(std::uint64_t begin, std::uint64_t end, BlockResult& result) const;
    void project_fields(std::uint64_t begin, std::uint64_t end, std::uint32_t time_step, BlockResult& result) const;

    const SourceVolume& m_source;
    const std::vector<FieldPlan>& m_plans;
    const TargetClass& m_target;
    const ClassKernel& m_kernel;
};

} // namespace elvis
