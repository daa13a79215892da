#include <core/base/error.hpp>
#include <core/base/host.hpp>
#include <core/convert/blocks.hpp>
#include <core/convert/classes.hpp>
#include <core/convert/convert.hpp>
#include <core/convert/projection/block_projection.hpp>
#include <core/convert/projection/class_kernel.hpp>
#include <core/convert/projection/field_plan.hpp>
#include <core/convert/projection/packed_blocks.hpp>
#include <core/convert/topology/face_list.hpp>
#include <core/convert/topology/jumps.hpp>
#include <core/convert/topology/topology.hpp>
#include <core/plugin_host/plugin.hpp>

#include <elvis/native/volume_file.hpp>

#include <Eigen/QR>

#include <charconv>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <limits>

namespace elvis {

namespace {

/** Numbers of a block in memory, all fields together (8 MiB); each processor has one block in work. */
constexpr std::uint64_t block_numbers = 1u << 20;
/** Of a class, unless it has fewer elements. */
constexpr std::uint64_t fewest_blocks = 256;

/**
 * Residual of an exact conversion, relative to the largest value: rounding in sums over modes, amplified by the projection's
 * condition; three digits above what orders up to 14 show, eight below a wrong space.
 */
constexpr double round_off = 1e-11;

/** A jump below this part of the field's range, or this part of its largest value, is rounding. */
constexpr double continuous_part_of_range = 1e-9;
constexpr double continuous_part_of_size = 1e-12;

/** $SOURCE_DATE_EPOCH, seconds since 1970, stands for now: then files that are made alike are alike. */
std::string utc_now() {
    char date[32] = {};
    std::time_t now = std::time(nullptr);
    if (const auto said = environment_variable("SOURCE_DATE_EPOCH")) {
        std::from_chars(said->data(), said->data() + said->size(), now);
    }
    std::tm utc{};
    std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &utc));
    return date;
}

/** Part of a class that is converted at once. */
struct Block {
    std::size_t element_class = 0;
    std::uint64_t first = 0;
    std::uint64_t count = 0;
};

class Conversion {
public:
    Conversion(const SourceVolume& source, const ConvertOptions& options, const TaskControl& control, Team& team)
        : m_source(source), m_options(options), m_control(control), m_team(team), m_plans(plan_fields(source, options)),
          m_points(all_face_points()) {
        std::vector<std::uint32_t> indices;
        for (const FieldPlan& plan : m_plans) {
            indices.push_back(plan.source_index);
        }
        m_classes = target_classes(source, indices, options, control);
        std::vector<elvis_shape> shapes(source.info().n_elements);
        for (const TargetClass& target : m_classes) {
            for (const std::uint64_t element : target.elements) {
                shapes[element] = static_cast<elvis_shape>(target.geometry.shape);
            }
        }
        m_topology = find_topology(source, std::move(shapes), control);
        m_measures.resize(m_plans.size());
        prepare();
    }

    /** What a member other than the first does. */
    void help() {
        for (std::uint32_t step = 0; step < m_source.times().size(); ++step) {
            convert_step_together(step, {});
        }
    }

    ConvertReport run(const std::string& output) {
        native::Writer writer(output, describe());
        for (std::size_t index = 0; index < m_classes.size(); ++index) {
            const std::vector<std::int64_t> numbers(m_classes[index].elements.begin(), m_classes[index].elements.end());
            writer.write_numbers(index, 0, numbers.size(), numbers);
        }
        write_faces(writer);
        write_parts(writer);
        for (std::uint32_t step = 0; step < m_source.times().size(); ++step) {
            if (m_team.size() == 1) {
                convert_step(writer, step);
                continue;
            }
            convert_step_together(step,
                                  [&](const Block& block, const BlockResult& result) { commit(writer, block, step, result); });
        }
        const ConvertReport report = make_report();
        for (std::size_t field = 0; field < m_plans.size(); ++field) {
            writer.set_max_jump(field, report.fields[field].max_jump);
            writer.set_continuity(field, static_cast<native::Continuity>(report.fields[field].continuity));
        }
        m_control.progress(1, "finishing the file");
        m_control.check();
        writer.commit();
        return report;
    }

private:
    void prepare();
    native::Description describe() const;
    void write_faces(native::Writer& writer) const;
    void write_parts(native::Writer& writer) const;
    void project(const Block& block, std::uint32_t step, BlockResult& result) const;
    void pack(const native::Writer& writer, const Block& block, std::uint32_t step, BlockResult& result) const;
    void convert_step(native::Writer& writer, std::uint32_t step);
    void convert_step_together(std::uint32_t step, const std::function<void(const Block&, const BlockResult&)>& take);
    void commit(native::Writer& writer, const Block& block, std::uint32_t step, const BlockResult& result);
    void measure_jumps(const Block& block, std::size_t field, const BlockResult& result);
    std::vector<double> face_gradients(const Block& block, std::size_t field, std::uint64_t at,
                                       const BlockResult& result) const;
    ConvertReport make_report() const;
    FieldReport make_field_report(std::size_t index, bool geometry_exact) const;

    const SourceVolume& m_source;
    const ConvertOptions& m_options;
    const TaskControl& m_control;
    Team& m_team;
    std::vector<FieldPlan> m_plans;
    std::array<FacePoints, native::n_shapes> m_points;
    std::vector<TargetClass> m_classes;
    Topology m_topology;
    /** Of the member that has fewest. */
    std::uint64_t m_n_workers = 1;
    std::vector<ClassKernel> m_kernels;
    std::vector<Block> m_blocks;
    std::vector<FieldMeasure> m_measures;
    std::vector<JumpMeter> m_meters;
    double m_largest_distance = 0;
    std::uint64_t m_n_coefficients = 0;
    std::uint64_t m_n_done = 0;
};

void Conversion::prepare() {
    double fewest = n_workers();
    m_team.minimum(std::span(&fewest, 1));
    m_n_workers = static_cast<std::uint64_t>(fewest);
    m_control.progress(-1, "preparing projections");
    std::vector<bool> is_continuous;
    for (const FieldPlan& plan : m_plans) {
        is_continuous.push_back(plan.continuity == ELVIS_CONTINUITY_CONTINUOUS && plan.transform == ELVIS_TRANSFORM_NONE);
        m_meters.emplace_back(m_topology);
    }
    for (std::size_t index = 0; index < m_classes.size(); ++index) {
        m_control.check();
        const TargetClass& target = m_classes[index];
        m_kernels.emplace_back(target, is_continuous, m_points[static_cast<std::size_t>(target.geometry.shape)]);
        const ClassKernel& kernel = m_kernels.back();
        std::uint64_t numbers = 3 * static_cast<std::uint64_t>(kernel.geometry.project.rows());
        for (std::size_t field = 0; field < m_plans.size(); ++field) {
            const ProjectionKernel& of_field = kernel.fields[field];
            numbers +=
                m_plans[field].n_components * static_cast<std::uint64_t>(of_field.project.rows() + of_field.to_faces.rows());
        }
        // Small volumes are cut finer than memory asks for, to keep all processors at work. Not by how many there are: the last
        // bits of a product of matrices depend on its size.
        const std::uint64_t n_elements = target.elements.size();
        const std::uint64_t share = (n_elements + fewest_blocks - 1) / fewest_blocks;
        const std::uint64_t size = std::max<std::uint64_t>(1, std::min(share, block_numbers / numbers));
        for (std::uint64_t first = 0; first < n_elements; first += size) {
            m_blocks.push_back({index, first, std::min(size, n_elements - first)});
        }
    }
}

native::Description Conversion::describe() const {
    native::Description description;
    description.dimension = static_cast<int>(m_source.info().dimension);
    for (const TargetClass& target : m_classes) {
        description.classes.push_back({target.geometry, target.fields, target.elements.size()});
    }
    for (const FieldPlan& plan : m_plans) {
        const SourceField& source = m_source.fields()[plan.source_index];
        native::Field field;
        field.name = source.name;
        field.unit = source.unit;
        field.n_components = source.n_components;
        field.continuity = static_cast<native::Continuity>(plan.continuity);
        field.transform = static_cast<native::Transform>(source.transform);
        description.fields.push_back(field);
    }
    description.times = m_source.times();
    description.boundary_groups = m_source.boundary_groups();
    description.n_faces = m_topology.n_faces;
    description.n_parts = m_source.n_parts();
    for (const std::string& path : m_source.paths()) {
        description.notes.emplace_back(
            m_source.paths().size() == 1 ? "source file" : "source file " + std::to_string(description.notes.size() + 1), path);
    }
    if (m_source.n_parts() > 0) {
        description.notes.emplace_back("parts", std::to_string(m_source.n_parts()) + ", those of the solver's processes");
    }
    description.notes.emplace_back("converter", m_source.plugin().id());
    description.notes.emplace_back("converter version", m_source.plugin().version());
    description.notes.emplace_back("written by", "ElVis " + m_options.program_version);
    description.notes.emplace_back("created", utc_now());
    return description;
}

void Conversion::write_faces(native::Writer& writer) const {
    std::uint64_t n_written = 0;
    list_faces(m_source, m_topology, m_control, [&](std::span<const native::Face> faces) {
        writer.write_faces(n_written, faces.size(), faces);
        n_written += faces.size();
    });
}

void Conversion::write_parts(native::Writer& writer) const {
    if (m_source.n_parts() > 0) {
        std::vector<std::uint32_t> parts(m_source.info().n_elements);
        m_source.parts(0, parts);
        writer.write_parts(parts);
    }
}

void Conversion::project(const Block& block, std::uint32_t step, BlockResult& result) const {
    const BlockProjection projection(m_source, m_plans, m_classes[block.element_class], m_kernels[block.element_class]);
    projection.run(block.first, block.count, step, step == 0, m_control, result);
}

void Conversion::pack(const native::Writer& writer, const Block& block, std::uint32_t step, BlockResult& result) const {
    if (step == 0) {
        result.packed_geometry = writer.pack_geometry(block.element_class, block.first, block.count, result.geometry);
    }
    result.packed_fields.resize(m_plans.size());
    for (std::size_t field = 0; field < m_plans.size(); ++field) {
        result.packed_fields[field] =
            writer.pack_field(field, step, block.element_class, block.first, block.count, result.fields[field]);
    }
}

void Conversion::convert_step(native::Writer& writer, std::uint32_t step) {
    std::vector<BlockResult> results(n_workers());
    for_each_block(
        m_blocks.size(),
        [&](std::uint64_t index, unsigned worker) {
            project(m_blocks[index], step, results[worker]);
            pack(writer, m_blocks[index], step, results[worker]);
        },
        [&](std::uint64_t index, unsigned worker) { commit(writer, m_blocks[index], step, results[worker]); });
}

/** In rounds: each member projects a block for each of its processors, then the first takes all in order. */
void Conversion::convert_step_together(std::uint32_t step, const std::function<void(const Block&, const BlockResult&)>& take) {
    const std::uint64_t a_member = m_n_workers;
    for (std::uint64_t round = 0; round < m_blocks.size(); round += a_member * m_team.size()) {
        const std::uint64_t n = m_blocks.size(), first = std::min(n, round + a_member * m_team.rank());
        std::vector<BlockResult> own(std::min(n, first + a_member) - first);
        for_each_block(
            own.size(), [&](std::uint64_t index, unsigned) { project(m_blocks[first + index], step, own[index]); },
            [](std::uint64_t, unsigned) {});
        std::uint64_t next = round;
        for (const std::vector<std::byte>& bytes : m_team.gathered(packed(own))) {
            for (const BlockResult& result : unpacked_blocks(bytes)) {
                take(m_blocks[next++], result);
            }
        }
    }
}

void Conversion::commit(native::Writer& writer, const Block& block, std::uint32_t step, const BlockResult& result) {
    m_control.check();
    if (step == 0) {
        writer.write_geometry(block.element_class, block.first, block.count, result.geometry, result.packed_geometry);
        m_n_coefficients += result.geometry.size();
        m_largest_distance = std::max(m_largest_distance, result.largest_distance);
    }
    for (std::size_t field = 0; field < m_plans.size(); ++field) {
        writer.write_field(field, step, block.element_class, block.first, block.count, result.fields[field],
                           result.packed_fields.empty() ? native::PackedRows{} : result.packed_fields[field]);
        m_n_coefficients += result.fields[field].size();
        m_measures[field].merge(result.measures[field]);
        if (m_plans[field].transform == ELVIS_TRANSFORM_NONE) {
            measure_jumps(block, field, result);
        }
    }
    m_n_done += block.count;
    const auto n_all = static_cast<double>(m_source.info().n_elements * m_source.times().size());
    m_control.progress(static_cast<double>(m_n_done) / n_all, "projecting");
}

void Conversion::measure_jumps(const Block& block, std::size_t field, const BlockResult& result) {
    const std::size_t numbers = result.at_faces[field].size() / block.count;
    for (std::uint64_t at = 0; at < block.count; ++at) {
        const std::uint64_t element = m_classes[block.element_class].elements[block.first + at];
        const std::span<const double> values(result.at_faces[field].data() + at * numbers, numbers);
        const bool with_gradients = m_meters[field].needs_gradients(element);
        m_meters[field].add(element, m_plans[field].n_components, values,
                            with_gradients ? face_gradients(block, field, at, result) : std::vector<double>());
    }
}

/** World gradients at the points of all faces of one element of a block, laid out as JumpMeter::add asks for. */
std::vector<double> Conversion::face_gradients(const Block& block, std::size_t field, std::uint64_t at,
                                               const BlockResult& result) const {
    const TargetClass& target = m_classes[block.element_class];
    const std::uint64_t element = target.elements[block.first + at];
    const FacePoints& points = m_points[static_cast<std::size_t>(target.geometry.shape)];
    const std::size_t n_components = m_plans[field].n_components;
    const std::size_t n_modes = native::n_modes(target.fields[field]);
    std::vector<double> gradients(3 * n_components * points.n_points());
    for (std::size_t point = 0; point < points.n_points(); ++point) {
        const double* xi = points.xi().data() + 3 * point;
        // Rows of J^T by central differences: the product with a step within the tolerance needs few digits.
        constexpr double h = 1e-5;
        const std::size_t dimension = m_source.info().dimension;
        std::array<double, 18> around;
        std::array<double, 18> x;
        for (std::size_t direction = 0; direction < 3; ++direction) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double step = axis == direction && axis < dimension ? h : 0;
                around[6 * direction + axis] = xi[axis] - step;
                around[6 * direction + 3 + axis] = xi[axis] + step;
            }
        }
        m_source.evaluate_mapping(element, around, x);
        Eigen::Matrix3d transposed;
        for (Eigen::Index direction = 0; direction < 3; ++direction) {
            for (Eigen::Index axis = 0; axis < 3; ++axis) {
                const auto low = static_cast<std::size_t>(6 * direction + axis);
                transposed(direction, axis) = (x[low + 3] - x[low]) / (2 * h);
            }
        }
        // On a surface the gradient in its tangent plane, the shortest of the solutions.
        const Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix3d> solver(transposed);
        for (std::size_t component = 0; component < n_components; ++component) {
            native::Point in_xi{};
            const double* coefficients = result.fields[field].data() + (at * n_components + component) * n_modes;
            native::evaluate(target.fields[field], {coefficients, n_modes}, {xi[0], xi[1], xi[2]}, in_xi);
            const Eigen::Vector3d in_x = solver.solve(Eigen::Vector3d(in_xi[0], in_xi[1], in_xi[2]));
            std::copy_n(in_x.data(), 3, gradients.data() + 3 * (component * points.n_points() + point));
        }
    }
    return gradients;
}

FieldReport Conversion::make_field_report(std::size_t index, bool geometry_exact) const {
    const FieldMeasure& measure = m_measures[index];
    const SourceField& source = m_source.fields()[m_plans[index].source_index];
    FieldReport field;
    field.name = source.name;
    field.mantissa_bits = m_source.info().mantissa_bits;
    field.lower = measure.lower;
    field.upper = measure.upper;
    field.n_not_finite = measure.n_not_finite;
    const double size = std::max(std::abs(measure.lower), std::abs(measure.upper));
    const double range = measure.upper - measure.lower;
    field.residual = measure.largest_error / (range > 0 ? range : size > 0 ? size : 1);
    field.exact = geometry_exact && measure.n_not_finite == 0 && measure.largest_error <= round_off * size &&
                  std::ranges::all_of(m_classes, [&](const TargetClass& target) { return target.is_contained[index]; });
    if (m_plans[index].transform == ELVIS_TRANSFORM_NONE) {
        field.max_jump = m_meters[index].largest();
        const double rounding = std::max(continuous_part_of_range * range, continuous_part_of_size * size);
        const bool may_be_continuous = m_plans[index].continuity != ELVIS_CONTINUITY_DISCONTINUOUS;
        field.continuity =
            may_be_continuous && field.max_jump <= rounding ? ELVIS_CONTINUITY_CONTINUOUS : ELVIS_CONTINUITY_DISCONTINUOUS;
    } else {
        field.max_jump = std::numeric_limits<double>::quiet_NaN();
        field.continuity = source.continuity;
    }
    return field;
}

ConvertReport Conversion::make_report() const {
    ConvertReport report;
    report.geometry_residual = m_topology.corners.extent > 0 ? m_largest_distance / m_topology.corners.extent : 0;
    report.geometry_exact = m_largest_distance <= round_off * m_topology.corners.largest_coordinate;
    for (std::size_t index = 0; index < m_plans.size(); ++index) {
        report.fields.push_back(make_field_report(index, report.geometry_exact));
    }
    for (const TargetClass& target : m_classes) {
        report.elements[std::string(native::name(target.geometry.shape))] += target.elements.size();
    }
    report.n_faces = m_topology.n_faces;
    report.n_boundary_faces = m_topology.n_boundary;
    report.n_unknown_faces = m_topology.n_unknown;
    report.n_coefficients = m_n_coefficients;
    return report;
}

} // namespace

ConvertReport convert(const SourceVolume& source, const std::string& output, const ConvertOptions& options,
                      const TaskControl& control) {
    OneProcess alone;
    return convert(source, output, options, control, alone);
}

ConvertReport convert(const SourceVolume& source, const std::string& output, const ConvertOptions& options,
                      const TaskControl& control, Team& team) {
    const auto start = std::chrono::steady_clock::now();
    try {
        Conversion conversion(source, options, control, team);
        if (!team.is_first()) {
            conversion.help();
            return {};
        }
        ConvertReport report = conversion.run(output);
        report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return report;
    } catch (const native::FileError& error) {
        throw Error(error.what());
    } catch (const std::invalid_argument& error) {
        throw Error(source.paths().front(), error.what());
    }
}

} // namespace elvis
