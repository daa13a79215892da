#include <core/convert/projection/block_projection.hpp>

#include <cmath>

namespace elvis {

namespace {

using Eigen::Index;
using Matrix = Eigen::MatrixXd;

/** Samples of the elements that are multiplied at once: the matrices of samples stay in the second-level cache. */
constexpr std::uint64_t samples_at_once = 65536;

Eigen::Map<Matrix> columns(std::vector<double>& numbers, std::uint64_t first_column, Index n_rows, Index n_columns) {
    return {numbers.data() + first_column * static_cast<std::uint64_t>(n_rows), n_rows, n_columns};
}

/** Extremes of the samples, and whether each element's are finite. */
void measure_samples(const Matrix& values, std::size_t n_components, FieldMeasure& measure) {
    for (Index first = 0; first < values.cols(); first += static_cast<Index>(n_components)) {
        bool is_finite = true;
        for (Index column = first; column < first + static_cast<Index>(n_components); ++column) {
            for (Index point = 0; point < values.rows(); ++point) {
                const double value = values(point, column);
                if (!std::isfinite(value)) {
                    is_finite = false;
                    continue;
                }
                measure.lower = std::min(measure.lower, value);
                measure.upper = std::max(measure.upper, value);
            }
        }
        measure.n_not_finite += is_finite ? 0 : 1;
    }
}

/** Largest finite entry: elements whose samples are not finite are counted, they have no error of projection. */
double largest_finite(const Matrix& errors) {
    double largest = 0;
    for (Index at = 0; at < errors.size(); ++at) {
        const double error = std::abs(errors.data()[at]);
        largest = std::isfinite(error) && error > largest ? error : largest;
    }
    return largest;
}

} // namespace

void BlockProjection::run(std::uint64_t first, std::uint64_t count, std::uint32_t time_step, bool with_geometry,
                          const TaskControl& control, BlockResult& result) const {
    result.first = first;
    result.count = count;
    result.largest_distance = 0;
    result.measures.assign(m_plans.size(), {});
    result.geometry.resize(with_geometry ? count * 3 * static_cast<std::uint64_t>(m_kernel.geometry.project.rows()) : 0);
    result.fields.resize(m_plans.size());
    result.at_faces.resize(m_plans.size());
    for (std::size_t field = 0; field < m_plans.size(); ++field) {
        const std::uint64_t n_columns = count * m_plans[field].n_components;
        result.fields[field].resize(n_columns * static_cast<std::uint64_t>(m_kernel.fields[field].project.rows()));
        result.at_faces[field].resize(n_columns * static_cast<std::uint64_t>(m_kernel.fields[field].to_faces.rows()));
    }
    const std::uint64_t n_points = std::max(m_kernel.geometry_points.size(), m_kernel.field_points.size()) / 3;
    const std::uint64_t at_once = std::clamp<std::uint64_t>(samples_at_once / n_points, 4, 512);
    for (std::uint64_t begin = 0; begin < count; begin += at_once) {
        control.check();
        const std::uint64_t end = std::min(begin + at_once, count);
        if (with_geometry) {
            project_geometry(begin, end, result);
        }
        if (!m_plans.empty()) {
            project_fields(begin, end, time_step, result);
        }
    }
}

void BlockProjection::project_geometry(std::uint64_t begin, std::uint64_t end, BlockResult& result) const {
    const auto n_points = static_cast<Index>(m_kernel.geometry_points.size() / 3);
    const auto n_columns = static_cast<Index>(3 * (end - begin));
    Matrix samples(n_points, n_columns);
    Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> positions(n_points, 3);
    for (std::uint64_t at = begin; at < end; ++at) {
        m_source.evaluate_mapping(m_target.elements[result.first + at], m_kernel.geometry_points,
                                  std::span<double>(positions.data(), static_cast<std::size_t>(positions.size())));
        samples.middleCols(static_cast<Index>(3 * (at - begin)), 3) = positions;
    }
    const ProjectionKernel& kernel = m_kernel.geometry;
    auto coefficients = columns(result.geometry, 3 * begin, kernel.project.rows(), n_columns);
    coefficients.noalias() = kernel.project * samples.topRows(kernel.project.cols());
    const Matrix errors = kernel.to_checks * coefficients - samples.bottomRows(m_kernel.n_geometry_checks);
    for (Index column = 0; column < n_columns; column += 3) {
        result.largest_distance = std::max(result.largest_distance, errors.middleCols(column, 3).rowwise().norm().maxCoeff());
    }
}

void BlockProjection::project_fields(std::uint64_t begin, std::uint64_t end, std::uint32_t time_step,
                                     BlockResult& result) const {
    const auto n_points = static_cast<Index>(m_kernel.field_points.size() / 3);
    const auto n_values = static_cast<Index>(m_source.n_values());
    // Samples of all fields of these elements, one column for each number of a sample.
    Matrix samples(n_points, static_cast<Index>(end - begin) * n_values);
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> of_element(n_points, n_values);
    for (std::uint64_t at = begin; at < end; ++at) {
        m_source.sample(time_step, m_target.elements[result.first + at], m_kernel.field_points,
                        std::span<double>(of_element.data(), static_cast<std::size_t>(of_element.size())));
        samples.middleCols(static_cast<Index>(at - begin) * n_values, n_values) = of_element;
    }
    Matrix values;
    for (std::size_t field = 0; field < m_plans.size(); ++field) {
        const auto n_components = static_cast<Index>(m_plans[field].n_components);
        const Index n_columns = static_cast<Index>(end - begin) * n_components;
        values.resize(n_points, n_columns);
        for (Index element = 0; element < static_cast<Index>(end - begin); ++element) {
            values.middleCols(element * n_components, n_components) =
                samples.middleCols(element * n_values + static_cast<Index>(m_plans[field].first_value), n_components);
        }
        FieldMeasure& measure = result.measures[field];
        measure_samples(values, m_plans[field].n_components, measure);
        const ProjectionKernel& kernel = m_kernel.fields[field];
        const std::uint64_t first_column = begin * m_plans[field].n_components;
        auto coefficients = columns(result.fields[field], first_column, kernel.project.rows(), n_columns);
        coefficients.noalias() = kernel.project * values.middleRows(kernel.first_point, kernel.project.cols());
        const Matrix errors = kernel.to_checks * coefficients - values.bottomRows(m_kernel.n_field_checks);
        measure.largest_error = std::max(measure.largest_error, largest_finite(errors));
        auto at_faces = columns(result.at_faces[field], first_column, kernel.to_faces.rows(), n_columns);
        at_faces.noalias() = kernel.to_faces * coefficients;
    }
}

} // namespace elvis
