#include <core/convert/projection/class_kernel.hpp>
#include <core/convert/topology/entities.hpp>

#include <algorithm>

namespace elvis {

namespace {

Eigen::Index n_points(const PointList& points) { return static_cast<Eigen::Index>(points.size() / 3); }

/** `extra` points more than the smallest number that determines the space's functions. */
PointProjection whole_element(const native::Space& space, std::uint32_t extra) {
    std::array<std::uint32_t, 3> n = native::collapsed_order(space);
    for (std::uint32_t& direction : n) {
        direction += 1 + extra;
    }
    return element_projection(space, n);
}

/** Enough that an error of any mode shows: a quarter of their number, more for small spaces. */
std::size_t n_scattered(std::size_t n_modes) { return std::max<std::size_t>(24, n_modes / 4); }

} // namespace

ClassKernel::ClassKernel(const TargetClass& target, const std::vector<bool>& is_continuous, const FacePoints& face_points) {
    const native::Shape shape = target.geometry.shape;
    PointProjection of_geometry = whole_element(target.geometry, 0);
    const PointList geometry_checks = check_points(shape, n_scattered(native::n_modes(target.geometry)));
    geometry.project = std::move(of_geometry.matrix);
    geometry.to_checks = mode_matrix(target.geometry, geometry_checks);
    geometry_points = std::move(of_geometry.xi);
    geometry_points.insert(geometry_points.end(), geometry_checks.begin(), geometry_checks.end());
    n_geometry_checks = n_points(geometry_checks);

    std::size_t n_modes = 0;
    for (const native::Space& space : target.fields) {
        n_modes = std::max(n_modes, native::n_modes(space));
    }
    const PointList checks = check_points(shape, n_scattered(n_modes));
    n_field_checks = n_points(checks);
    for (std::size_t index = 0; index < target.fields.size(); ++index) {
        const native::Space& space = target.fields[index];
        const bool by_entities =
            is_continuous[index] && !target.is_contained[index] && space.basis == native::Basis::modified && space.order[0] > 0;
        PointProjection projection =
            by_entities ? entity_projection(space) : whole_element(space, target.is_contained[index] ? 0 : 1);
        ProjectionKernel kernel;
        kernel.project = std::move(projection.matrix);
        kernel.to_checks = mode_matrix(space, checks);
        kernel.to_faces = mode_matrix(space, face_points.xi());
        // Fields of the same space share their points.
        kernel.first_point = n_points(field_points);
        for (const ProjectionKernel& other : fields) {
            const auto first = field_points.begin() + 3 * other.first_point;
            if (other.project.cols() == kernel.project.cols() &&
                std::equal(projection.xi.begin(), projection.xi.end(), first)) {
                kernel.first_point = other.first_point;
            }
        }
        if (kernel.first_point == n_points(field_points)) {
            field_points.insert(field_points.end(), projection.xi.begin(), projection.xi.end());
        }
        fields.push_back(std::move(kernel));
    }
    field_points.insert(field_points.end(), checks.begin(), checks.end());
}

} // namespace elvis
