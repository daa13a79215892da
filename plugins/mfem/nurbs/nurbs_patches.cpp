#include "nurbs_patches.hpp"

#include <algorithm>

namespace elvis_mfem {

template <class Visit> void NurbsPatches::for_control_points(std::size_t element, Visit&& visit) const {
    const NurbsElement& own = elements[element];
    const NurbsPatch& patch = patches[own.patch];
    const auto order = [&](std::size_t axis) {
        return axis < static_cast<std::size_t>(dimension) ? patch.knots[axis].order : 0;
    };
    const int n0 = patch.knots[0].n_control_points(), n1 = patch.knots[1].n_control_points();
    const auto first = [&](std::size_t axis) { return own.spans[axis] - order(axis); };
    for (int k = 0; k <= order(2); ++k) {
        for (int j = 0; j <= order(1); ++j) {
            for (int i = 0; i <= order(0); ++i) {
                const int place = first(0) + i + n0 * (first(1) + j + n1 * (first(2) + k));
                visit(patch.control_points[static_cast<std::size_t>(place)], i, j, k);
            }
        }
    }
}

int NurbsPatches::order(std::size_t element) const {
    const NurbsPatch& patch = patches[elements[element].patch];
    int result = 1;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis) {
        result = std::max(result, patch.knots[axis].order);
    }
    return result;
}

bool NurbsPatches::is_polynomial(std::size_t element) const {
    double least = 0, most = 0;
    bool is_first = true;
    for_control_points(element, [&](std::int32_t number, int, int, int) {
        const double weight = weights[static_cast<std::size_t>(number)];
        least = is_first ? weight : std::min(least, weight);
        most = is_first ? weight : std::max(most, weight);
        is_first = false;
    });
    return least == most;
}

std::vector<NurbsPatches::Share> NurbsPatches::shares(std::size_t element, const Point& t) const {
    const NurbsElement& own = elements[element];
    std::array<std::array<double, max_spline_order + 1>, 3> splines{};
    splines[2][0] = 1;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis) {
        splines[axis] = patches[own.patch].knots[axis].evaluate(own.spans[axis], t[axis]);
    }
    std::vector<Share> result;
    double sum = 0;
    for_control_points(element, [&](std::int32_t number, int i, int j, int k) {
        const auto at = [](int n) { return static_cast<std::size_t>(n); };
        const double weight = weights[at(number)] * splines[0][at(i)] * splines[1][at(j)] * splines[2][at(k)];
        result.push_back({number, weight});
        sum += weight;
    });
    for (Share& share : result) {
        share.weight /= sum;
    }
    return result;
}

} // namespace elvis_mfem
