#include <core/integrate/part_integral.hpp>

#include <core/integrate/level_rule.hpp>

#include <cmath>

namespace elvis {

namespace {

/** Points that the second of two rules has more than the first. */
constexpr unsigned more_points = 2;
constexpr unsigned most_level_depth = 12;
/** Of rules on planes and isosurfaces: orders that reach 1e-9 on smooth surfaces with few divisions. */
constexpr unsigned level_points = 6;

struct GaussBox {
    CollapsedBox box;
    unsigned dimension = 3;
    unsigned depth = 0;

    std::vector<GaussBox> divided() const {
        std::vector<GaussBox> parts;
        for (unsigned index = 0; index < (1u << dimension); ++index) {
            GaussBox part{{box.middle, 0.5 * box.half_side}, dimension, depth + 1};
            for (unsigned axis = 0; axis < dimension; ++axis) {
                part.box.middle[axis] += ((index >> axis) & 1u) != 0 ? part.box.half_side : -part.box.half_side;
            }
            parts.push_back(part);
        }
        return parts;
    }
};

struct LevelBox {
    BlockBox box;
    std::size_t block = 0;
    unsigned depth = 0;

    std::vector<LevelBox> divided() const {
        std::vector<LevelBox> parts;
        for (unsigned index = 0; index < 8; ++index) {
            LevelBox part{box, block, depth + 1};
            for (unsigned axis = 0; axis < 3; ++axis) {
                const double middle = 0.5 * (box.lower[axis] + box.upper[axis]);
                (((index >> axis) & 1u) != 0 ? part.box.lower : part.box.upper)[axis] = middle;
            }
            parts.push_back(part);
        }
        return parts;
    }
};

/** Sums of one rule, and how far those of another are from them. */
BoxSums compared(const Sums& fine, const Sums& coarse) {
    return {fine, std::abs(fine.value - coarse.value), std::abs(fine.measure - coarse.measure), true};
}

void append_faces_through_middle(const ElementBlock& block, const BlockBox& box, ReferencePoints& points) {
    const Vector3 sides = minus(box.upper, box.lower);
    const ElementBlock::Place middle = block.at(scaled(plus(box.lower, box.upper), 0.5));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
        const Vector3 face = scaled(cross(middle.tangents[next], middle.tangents[last]), sides[next] * sides[last]);
        points.xi.insert(points.xi.end(), middle.xi.begin(), middle.xi.end());
        points.vectors.insert(points.vectors.end(), face.begin(), face.end());
    }
}

} // namespace

PartSums integrate_part(const Integrand& integrand, const DomainPart& part, const PartRule& rule, const SumTolerance& tolerance,
                        std::uint64_t& n_evaluations) {
    ReferencePoints points;
    const auto sums_of = [&](const CollapsedBox& box, unsigned n) {
        points.clear();
        append_gauss_points(part.part, box, n, points);
        n_evaluations += points.size();
        return integrand.sum(part.element, part.part.shape, points);
    };
    const std::function<BoxSums(const GaussBox&)> of_box = [&](const GaussBox& box) {
        const Sums coarse = sums_of(box.box, rule.n_points);
        if (rule.is_value_exact && rule.is_measure_exact) {
            return BoxSums{coarse, 0, 0, true};
        }
        BoxSums sums = compared(sums_of(box.box, rule.n_points + more_points), coarse);
        sums.value_error = rule.is_value_exact ? 0 : sums.value_error;
        sums.measure_error = rule.is_measure_exact ? 0 : sums.measure_error;
        return sums;
    };
    return adaptive_sum<GaussBox>({GaussBox{{}, part.part.dimension(), 0}}, of_box, tolerance, rule.most_depth);
}

PartSums integrate_level(const Integrand& integrand, const DomainPart& part, const ElementSampler& level, double isovalue,
                         const SumTolerance& tolerance, std::uint64_t& n_evaluations) {
    const std::vector<ElementBlock> blocks = element_blocks(part.part.shape);
    std::vector<LevelFunction> functions;
    std::vector<LevelBox> boxes;
    for (const ElementBlock& block : blocks) {
        functions.emplace_back(level, part.element, block, isovalue);
        boxes.push_back({{}, boxes.size(), 0});
    }
    ReferencePoints points;
    const auto sums_of = [&](LevelRule& rule, unsigned n) {
        points.clear();
        rule.append_points(n, points);
        n_evaluations += points.size();
        return integrand.sum(part.element, part.part.shape, points);
    };
    // At most about as much as three faces of the box.
    const auto lost_in = [&](const LevelBox& box) {
        points.clear();
        append_faces_through_middle(blocks[box.block], box.box, points);
        const Sums most = integrand.sum(part.element, part.part.shape, points);
        return BoxSums{{}, most.size, most.measure, false};
    };
    const std::function<BoxSums(const LevelBox&)> of_box = [&](const LevelBox& box) {
        LevelRule rule(functions[box.block], box.box);
        if (rule.is_missed()) {
            return BoxSums{};
        }
        if (!rule.is_usable()) {
            return lost_in(box);
        }
        const Sums coarse = sums_of(rule, level_points);
        return compared(sums_of(rule, level_points + more_points), coarse);
    };
    const PartSums sums = adaptive_sum<LevelBox>(boxes, of_box, tolerance, most_level_depth);
    for (const LevelFunction& function : functions) {
        n_evaluations += function.n_evaluations();
    }
    return sums;
}

} // namespace elvis
