#include <core/streamline/dormand_prince.hpp>

#include <array>

namespace elvis {

namespace {

constexpr std::size_t n_stages = 7;
/** Row i: weights of the stages before i. The last row is the step's result, too. */
constexpr double weights[n_stages][n_stages] = {
    {},
    {1.0 / 5},
    {3.0 / 40, 9.0 / 40},
    {44.0 / 45, -56.0 / 15, 32.0 / 9},
    {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
    {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
    {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84},
};
/** Of a step, at which stages are: the sums of the rows. */
constexpr double nodes[n_stages] = {0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1, 1};
/** Result of order 5 less that of order 4. */
constexpr double error_weights[n_stages] = {71.0 / 57600,      0,          -71.0 / 16695, 71.0 / 1920,
                                            -17253.0 / 339200, 22.0 / 525, -1.0 / 40};

Vector3 to_world(const std::array<double, 9>& jacobian, const Vector3& change) {
    return {jacobian[0] * change[0] + jacobian[1] * change[1] + jacobian[2] * change[2],
            jacobian[3] * change[0] + jacobian[4] * change[1] + jacobian[5] * change[2],
            jacobian[6] * change[0] + jacobian[7] * change[1] + jacobian[8] * change[2]};
}

} // namespace

FlowStep dormand_prince(const Flow& flow, const FlowState& start, double step) {
    std::array<Vector3, n_stages> slopes{start.sample.slope};
    std::array<double, n_stages> speeds{length(start.sample.velocity)};
    std::array<double, n_stages> spins{start.sample.spin};
    FlowStep result{start, 0, 0};
    for (std::size_t stage = 1; stage < n_stages; ++stage) {
        Vector3 xi = start.at.xi;
        double arc_length = start.arc_length, turn = start.turn;
        for (std::size_t before = 0; before < stage; ++before) {
            xi = plus(xi, scaled(slopes[before], step * weights[stage][before]));
            arc_length += step * weights[stage][before] * speeds[before];
            turn += step * weights[stage][before] * spins[before];
        }
        result.end.at.xi = xi;
        result.end.arc_length = arc_length;
        result.end.turn = turn;
        result.end.sample = flow.at(result.end.at, start.time + step * nodes[stage]);
        slopes[stage] = result.end.sample.slope;
        speeds[stage] = length(result.end.sample.velocity);
        spins[stage] = result.end.sample.spin;
    }
    result.end.time = start.time + step;
    Vector3 error{};
    for (std::size_t stage = 0; stage < n_stages; ++stage) {
        error = plus(error, scaled(slopes[stage], step * error_weights[stage]));
        result.turn_error += step * error_weights[stage] * spins[stage];
    }
    result.error = length(to_world(result.end.sample.jacobian, error));
    return result;
}

} // namespace elvis
