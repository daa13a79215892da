#include <core/base/error.hpp>
#include <core/convert/blocks.hpp>
#include <core/convert/classes.hpp>
#include <core/convert/convert.hpp>
#include <core/convert/entities.hpp>
#include <core/convert/face_points.hpp>
#include <core/convert/projector.hpp>
#include <core/convert/topology.hpp>
#include <core/plugin_host/plugin.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <mutex>
#include <optional>
#include <unordered_map>

namespace elvis {

namespace {

/** Numbers of a block in memory, all fields together. */
constexpr std::uint64_t block_numbers = 4u << 20;
constexpr std::uint64_t part_size = 16;
/**
 * Residual of an exact conversion, relative to the largest value: rounding in sums over modes, amplified by the projection's
 * condition; three digits above what orders up to 14 show, eight below a wrong space.
 */
constexpr double round_off = 1e-11;
/** A jump below this part of the field's range is rounding. */
constexpr double continuous_jump = 1e-9;

/** Converted fields and where their components stand among the numbers of a sample. */
struct FieldPlan {
    std::uint32_t source_index = 0;
    Eigen::Index first_column = 0;
    Eigen::Index n_components = 1;
    bool is_continuous_target = false;
    elvis_transform transform = ELVIS_TRANSFORM_NONE;
};

std::vector<FieldPlan> plan_fields(const SourceVolume& source, const ConvertOptions& options) {
    std::vector<FieldPlan> all;
    Eigen::Index column = 0;
    for (std::uint32_t index = 0; index < source.fields().size(); ++index) {
        const SourceField& field = source.fields()[index];
        const elvis_continuity continuity = options.continuity.value_or(field.continuity);
        all.push_back({index, column, field.n_components, continuity == ELVIS_CONTINUITY_CONTINUOUS, field.transform});
        column += field.n_components;
    }
    if (options.fields.empty()) {
        return all;
    }
    std::vector<FieldPlan> chosen;
    for (const std::string& name : options.fields) {
        const auto found = std::find_if(all.begin(), all.end(),
                                        [&](const FieldPlan& plan) { return source.fields()[plan.source_index].name == name; });
        if (found == all.end()) {
            std::string known;
            for (const SourceField& field : source.fields()) {
                known += (known.empty() ? "" : ", ") + field.name;
            }
            throw Error(source.paths().front(),
                        "has no field '" + name + "'; its fields are: " + (known.empty() ? "none" : known));
        }
        chosen.push_back(*found);
    }
    return chosen;
}

/** What the parts of the work find out about one field; merged in any order with the same result. */
struct FieldMeasure {
    double largest_error = 0;
    double lower = std::numeric_limits<double>::infinity();
    double upper = -std::numeric_limits<double>::infinity();
    double largest_jump = 0;
    std::uint64_t n_not_finite = 0;

    void merge(const FieldMeasure& other) {
        largest_error = std::max(largest_error, other.largest_error);
        lower = std::min(lower, other.lower);
        upper = std::max(upper, other.upper);
        largest_jump = std::max(largest_jump, other.largest_jump);
        n_not_finite += other.n_not_finite;
    }
};

struct Measures {
    double largest_distance = 0;
    std::vector<FieldMeasure> fields;
};

/** Everything that is the same for all elements of a class. */
class ClassKernel {
public:
    ClassKernel(const TargetClass& target, const std::vector<FieldPlan>& plans) {
        const native::Shape shape = target.geometry.shape;
        std::array<std::uint32_t, 3> n{2, 2, 2};
        std::uint32_t highest = 1;
        const auto include = [&](const native::Space& space) {
            const std::array<std::uint32_t, 3> order = native::collapsed_order(space);
            for (std::size_t direction = 0; direction < 3; ++direction) {
                n[direction] = std::max(n[direction], order[direction] + 2);
                highest = std::max(highest, order[direction]);
            }
        };
        include(target.geometry);
        for (const native::Space& space : target.fields) {
            include(space);
        }
        const GaussPoints gauss = gauss_points(shape, n);
        const PointList checks = check_points(shape, highest + 2);
        m_points = gauss.xi;
        m_n_gauss = static_cast<Eigen::Index>(gauss.weights.size());
        m_points.insert(m_points.end(), checks.begin(), checks.end());
        m_n_checks = static_cast<Eigen::Index>(checks.size() / 3);
        m_geometry = {projection_matrix(target.geometry, gauss), mode_matrix(target.geometry, checks), std::nullopt, 0};
        for (std::size_t field = 0; field < plans.size(); ++field) {
            const native::Space& space = target.fields[field];
            FieldKernel kernel;
            kernel.to_checks = mode_matrix(space, checks);
            if (plans[field].is_continuous_target && !target.is_contained[field] && space.basis == native::Basis::modified) {
                kernel.entities.emplace(space);
                kernel.first_point = static_cast<Eigen::Index>(m_points.size() / 3);
                m_points.insert(m_points.end(), kernel.entities->points().begin(), kernel.entities->points().end());
            } else {
                kernel.project = projection_matrix(space, gauss);
            }
            m_fields.push_back(std::move(kernel));
        }
    }

    const PointList& points() const { return m_points; }
    Eigen::Index n_points() const { return static_cast<Eigen::Index>(m_points.size() / 3); }

    /** Coefficients (modes x 3) of positions given at points(), and their largest error at the check points. */
    Eigen::MatrixXd project_geometry(const Eigen::MatrixXd& positions, double& largest_distance) const {
        Eigen::MatrixXd coefficients = m_geometry.project * positions.topRows(m_n_gauss);
        const Eigen::MatrixXd error = m_geometry.to_checks * coefficients - positions.middleRows(m_n_gauss, m_n_checks);
        largest_distance = std::max(largest_distance, error.rowwise().norm().maxCoeff());
        return coefficients;
    }

    /** Coefficients (modes x components) of a field given at points(), with its measures. */
    Eigen::MatrixXd project_field(std::size_t field, const Eigen::Ref<const Eigen::MatrixXd>& values,
                                  FieldMeasure& measure) const {
        const FieldKernel& kernel = m_fields[field];
        Eigen::MatrixXd coefficients;
        if (kernel.entities) {
            coefficients = kernel.entities->project(
                values.middleRows(kernel.first_point, static_cast<Eigen::Index>(kernel.entities->points().size() / 3)));
        } else {
            coefficients = kernel.project * values.topRows(m_n_gauss);
        }
        const auto checked = values.middleRows(m_n_gauss, m_n_checks);
        const Eigen::MatrixXd projected = kernel.to_checks * coefficients;
        for (Eigen::Index component = 0; component < checked.cols(); ++component) {
            for (Eigen::Index point = 0; point < checked.rows(); ++point) {
                const double value = checked(point, component);
                if (!std::isfinite(value)) {
                    ++measure.n_not_finite;
                    continue;
                }
                measure.lower = std::min(measure.lower, value);
                measure.upper = std::max(measure.upper, value);
                const double error = std::abs(projected(point, component) - value);
                // Coefficients of an element with values that are not finite are not finite: counted above, no error of
                // projection.
                measure.largest_error = std::isfinite(error) ? std::max(measure.largest_error, error) : measure.largest_error;
            }
        }
        return coefficients;
    }

private:
    struct FieldKernel {
        Eigen::MatrixXd project;
        Eigen::MatrixXd to_checks;
        std::optional<EntityProjector> entities;
        Eigen::Index first_point = 0;
    };
    PointList m_points;
    Eigen::Index m_n_gauss = 0;
    Eigen::Index m_n_checks = 0;
    FieldKernel m_geometry;
    std::vector<FieldKernel> m_fields;
};

/** Compares the two sides of every shared face: the first to come leaves its values for the second. */
class JumpMeter {
public:
    explicit JumpMeter(const Topology& topology) : m_topology(topology) {}

    /** Values (points x components) of one field on faces of one element. */
    void add(const std::vector<std::pair<std::uint32_t, Eigen::MatrixXd>>& of_faces, FieldMeasure& measure) {
        for (const auto& [face, values] : of_faces) {
            if (m_topology.faces[face].neighbour < 0) {
                continue;
            }
            const auto [found, is_first] = m_open.try_emplace(face, values);
            if (!is_first) {
                const double jump = (found->second - values).cwiseAbs().maxCoeff();
                measure.largest_jump = std::isfinite(jump) ? std::max(measure.largest_jump, jump) : measure.largest_jump;
                m_open.erase(found);
            }
        }
    }

private:
    const Topology& m_topology;
    std::unordered_map<std::uint32_t, Eigen::MatrixXd> m_open;
};

/** Mode values at the points of a face, for every way its corners may be numbered; filled as they are met. */
class FaceModes {
public:
    explicit FaceModes(const native::Space& space) : m_space(space) {}

    const Eigen::MatrixXd& at(int local_face, const OrientedFace& face) {
        std::uint32_t code = static_cast<std::uint32_t>(local_face);
        for (const int corner : face.corners) {
            code = code * 9 + static_cast<std::uint32_t>(corner + 1);
        }
        const auto [found, is_new] = m_matrices.try_emplace(code);
        if (is_new) {
            const auto points = face_points(m_space.shape, face);
            found->second = mode_matrix(m_space, PointList(points.front().data(), points.front().data() + 3 * n_face_points));
        }
        return found->second;
    }

private:
    native::Space m_space;
    std::unordered_map<std::uint32_t, Eigen::MatrixXd> m_matrices;
};

class Conversion {
public:
    Conversion(const SourceVolume& source, const ConvertOptions& options, const TaskControl& control)
        : m_source(source), m_options(options), m_control(control), m_plans(plan_fields(source, options)) {
        std::vector<std::uint32_t> indices;
        for (const FieldPlan& plan : m_plans) {
            indices.push_back(plan.source_index);
        }
        m_classes = target_classes(source, indices, options, control);
        std::vector<elvis_shape> shapes(source.info().n_elements);
        for (const TargetClass& target : m_classes) {
            native::check(target.geometry);
            for (const native::Space& space : target.fields) {
                native::check(space);
            }
            for (const std::uint64_t element : target.elements) {
                shapes[element] = static_cast<elvis_shape>(target.geometry.shape);
            }
        }
        m_topology = find_topology(source, shapes, control);
        m_total.fields.resize(m_plans.size());
    }

    ConvertReport run(const std::string& output) {
        native::Writer writer(output, describe());
        for (std::size_t index = 0; index < m_classes.size(); ++index) {
            std::vector<std::int64_t> numbers(m_classes[index].elements.begin(), m_classes[index].elements.end());
            writer.write_numbers(index, 0, numbers.size(), numbers);
        }
        writer.write_faces(0, m_topology.faces.size(), m_topology.faces);
        for (std::uint32_t step = 0; step < m_source.times().size(); ++step) {
            std::vector<JumpMeter> meters(m_plans.size(), JumpMeter(m_topology));
            for (std::size_t index = 0; index < m_classes.size(); ++index) {
                convert_class(writer, index, step, meters);
            }
        }
        ConvertReport report = make_report();
        for (std::size_t field = 0; field < m_plans.size(); ++field) {
            writer.set_max_jump(field, report.fields[field].max_jump);
            writer.set_continuity(field, static_cast<native::Continuity>(report.fields[field].continuity));
        }
        m_control.progress(1, "finishing the file");
        writer.commit();
        return report;
    }

private:
    native::Description describe() const;
    void convert_class(native::Writer& writer, std::size_t index, std::uint32_t step, std::vector<JumpMeter>& meters);
    void measure_jumps(const TargetClass& target, std::uint64_t first, std::uint64_t count, std::size_t field,
                       const std::vector<double>& coefficients, FaceModes& modes, JumpMeter& meter);
    ConvertReport make_report() const;

    const SourceVolume& m_source;
    const ConvertOptions& m_options;
    const TaskControl& m_control;
    std::vector<FieldPlan> m_plans;
    std::vector<TargetClass> m_classes;
    Topology m_topology;
    Measures m_total;
    std::uint64_t m_n_done = 0;
};

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
        field.continuity = static_cast<native::Continuity>(m_options.continuity.value_or(source.continuity));
        field.transform = static_cast<native::Transform>(source.transform);
        description.fields.push_back(field);
    }
    description.times = m_source.times();
    description.boundary_groups = m_source.boundary_groups();
    description.n_faces = m_topology.faces.size();
    std::string files;
    for (const std::string& path : m_source.paths()) {
        files += (files.empty() ? "" : "\n") + path;
    }
    char date[32] = {};
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &utc));
    description.notes = {{"source", files},
                         {"converter", m_source.plugin().id()},
                         {"converter version", m_source.plugin().version()},
                         {"written by", "ElVis " + m_options.program_version},
                         {"date", date}};
    return description;
}

void Conversion::convert_class(native::Writer& writer, std::size_t index, std::uint32_t step, std::vector<JumpMeter>& meters) {
    const TargetClass& target = m_classes[index];
    const ClassKernel kernel(target, m_plans);
    const auto n_values = static_cast<Eigen::Index>(m_source.n_values());
    std::uint64_t numbers_an_element = 3 * native::n_modes(target.geometry);
    std::vector<std::uint64_t> field_size;
    std::vector<FaceModes> face_modes;
    for (std::size_t field = 0; field < m_plans.size(); ++field) {
        field_size.push_back(native::n_modes(target.fields[field]) * static_cast<std::uint64_t>(m_plans[field].n_components));
        numbers_an_element += field_size.back();
        face_modes.emplace_back(target.fields[field]);
    }
    const std::uint64_t geometry_size = 3 * native::n_modes(target.geometry);
    const std::uint64_t block_size = std::max<std::uint64_t>(1, block_numbers / numbers_an_element);
    const double n_all = static_cast<double>(m_source.info().n_elements * m_source.times().size());

    for (std::uint64_t first = 0; first < target.elements.size(); first += block_size) {
        const std::uint64_t count = std::min<std::uint64_t>(block_size, target.elements.size() - first);
        std::vector<double> geometry(step == 0 ? count * geometry_size : 0);
        std::vector<std::vector<double>> fields;
        for (const std::uint64_t size : field_size) {
            fields.emplace_back(count * size);
        }
        std::mutex mutex;
        for_each_part(count, part_size, [&](unsigned, std::uint64_t part_first, std::uint64_t part_last) {
            m_control.check();
            Measures measures;
            measures.fields.resize(m_plans.size());
            Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> positions(kernel.n_points(), 3);
            Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values(kernel.n_points(), n_values);
            for (std::uint64_t at = part_first; at < part_last; ++at) {
                const std::uint64_t element = target.elements[first + at];
                if (step == 0) {
                    m_source.evaluate_mapping(element, kernel.points(),
                                              std::span<double>(positions.data(), static_cast<std::size_t>(positions.size())));
                    const Eigen::MatrixXd coefficients = kernel.project_geometry(positions, measures.largest_distance);
                    std::copy_n(coefficients.data(), geometry_size,
                                geometry.begin() + static_cast<std::ptrdiff_t>(at * geometry_size));
                }
                if (!m_plans.empty()) {
                    m_source.sample(step, element, kernel.points(),
                                    std::span<double>(values.data(), static_cast<std::size_t>(values.size())));
                }
                for (std::size_t field = 0; field < m_plans.size(); ++field) {
                    const Eigen::MatrixXd of_field =
                        values.middleCols(m_plans[field].first_column, m_plans[field].n_components);
                    const Eigen::MatrixXd coefficients = kernel.project_field(field, of_field, measures.fields[field]);
                    std::copy_n(coefficients.data(), field_size[field],
                                fields[field].begin() + static_cast<std::ptrdiff_t>(at * field_size[field]));
                }
            }
            const std::lock_guard lock(mutex);
            m_total.largest_distance = std::max(m_total.largest_distance, measures.largest_distance);
            for (std::size_t field = 0; field < m_plans.size(); ++field) {
                m_total.fields[field].merge(measures.fields[field]);
            }
            m_n_done += part_last - part_first;
            m_control.progress(static_cast<double>(m_n_done) / n_all, "projecting");
        });
        if (step == 0) {
            writer.write_geometry(index, first, count, geometry);
        }
        for (std::size_t field = 0; field < m_plans.size(); ++field) {
            writer.write_field(field, step, index, first, count, fields[field]);
            if (m_plans[field].transform == ELVIS_TRANSFORM_NONE) {
                measure_jumps(target, first, count, field, fields[field], face_modes[field], meters[field]);
            }
        }
    }
}

void Conversion::measure_jumps(const TargetClass& target, std::uint64_t first, std::uint64_t count, std::size_t field,
                               const std::vector<double>& coefficients, FaceModes& modes, JumpMeter& meter) {
    const native::Space& space = target.fields[field];
    const auto n_modes = static_cast<Eigen::Index>(native::n_modes(space));
    for (std::uint64_t at = 0; at < count; ++at) {
        const std::uint64_t element = target.elements[first + at];
        const Eigen::Map<const Eigen::MatrixXd> of_element(
            coefficients.data() + at * static_cast<std::uint64_t>(n_modes * m_plans[field].n_components), n_modes,
            m_plans[field].n_components);
        std::vector<std::pair<std::uint32_t, Eigen::MatrixXd>> of_faces;
        for (int local = 0; local < native::n_faces(space.shape); ++local) {
            const std::uint32_t face = m_topology.of_element[element][static_cast<std::size_t>(local)];
            if (face != Topology::no_face && m_topology.faces[face].neighbour >= 0) {
                const OrientedFace oriented = oriented_face(space.shape, local, m_topology.corners.of_element[element]);
                of_faces.emplace_back(face, modes.at(local, oriented) * of_element);
            }
        }
        meter.add(of_faces, m_total.fields[field]);
    }
}

ConvertReport Conversion::make_report() const {
    ConvertReport report;
    for (std::size_t index = 0; index < m_plans.size(); ++index) {
        const FieldMeasure& measure = m_total.fields[index];
        FieldReport field;
        field.name = m_source.fields()[m_plans[index].source_index].name;
        field.mantissa_bits = m_source.info().mantissa_bits;
        field.lower = measure.lower;
        field.upper = measure.upper;
        field.n_not_finite = measure.n_not_finite;
        const double size = std::max(std::abs(measure.lower), std::abs(measure.upper));
        const double range = measure.upper - measure.lower;
        const double scale = range > 0 ? range : size > 0 ? size : 1;
        field.residual = measure.largest_error / scale;
        field.exact = measure.largest_error <= round_off * size;
        for (const TargetClass& target : m_classes) {
            field.exact = field.exact && target.is_contained[index];
        }
        if (m_plans[index].transform == ELVIS_TRANSFORM_NONE) {
            field.max_jump = measure.largest_jump;
            field.continuity =
                measure.largest_jump <= continuous_jump * scale ? ELVIS_CONTINUITY_CONTINUOUS : ELVIS_CONTINUITY_DISCONTINUOUS;
        } else {
            field.max_jump = std::numeric_limits<double>::quiet_NaN();
            field.continuity = m_source.fields()[m_plans[index].source_index].continuity;
        }
        report.fields.push_back(field);
    }
    report.geometry_residual = m_topology.corners.extent > 0 ? m_total.largest_distance / m_topology.corners.extent : 0;
    for (const TargetClass& target : m_classes) {
        report.elements[std::string(native::name(target.geometry.shape))] += target.elements.size();
    }
    report.n_faces = m_topology.faces.size();
    report.n_unknown_faces = m_topology.n_unknown;
    report.n_boundary_faces = static_cast<std::uint64_t>(
        std::count_if(m_topology.faces.begin(), m_topology.faces.end(),
                      [](const native::Face& face) { return face.neighbour == ELVIS_NEIGHBOUR_NONE; }));
    return report;
}

} // namespace

ConvertReport convert(const SourceVolume& source, const std::string& output, const ConvertOptions& options,
                      const TaskControl& control) {
    const auto start = std::chrono::steady_clock::now();
    try {
        Conversion conversion(source, options, control);
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
