/**
 * @file entities.hpp
 * Projection onto a continuous space: corners, then edges, faces and interior, each from data on that entity alone.
 *
 * Neighbours see the same data on what they share, and so find the same coefficients without talking (Demkowicz's
 * projection-based interpolation, with the L2 norm on each entity). Needs the modified basis, whose modes vanish on the
 * entities before their own.
 */
#pragma once

#include <core/convert/projector.hpp>

namespace elvis {

class EntityProjector {
public:
    explicit EntityProjector(const native::Space& space);

    /** Where the function is to be given. */
    const PointList& points() const { return m_points; }

    /** Coefficients (modes x functions) from values at points() (points x functions). */
    Eigen::MatrixXd project(const Eigen::Ref<const Eigen::MatrixXd>& values) const;

private:
    struct Entity {
        Eigen::Index first_point = 0;
        Eigen::Index n_points = 0;
        std::vector<Eigen::Index> modes;
        /** All modes at the entity's points. */
        Eigen::MatrixXd at_points;
        /** From what is left at the points to the entity's modes. */
        Eigen::MatrixXd to_modes;
    };
    void add_entity(const native::Space& space, const GaussPoints& points, std::vector<bool>& is_taken, bool takes_all);

    Eigen::Index m_n_modes = 0;
    PointList m_points;
    std::vector<Entity> m_entities;
};

} // namespace elvis
