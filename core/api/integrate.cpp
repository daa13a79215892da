#include "call.hpp"

#include <core/integrate/integral.hpp>

#include <elvis/answers.h>

#include <cmath>
#include <span>

namespace elvis::library {

namespace {

constexpr double least_tolerance = 1e-14;
constexpr double default_tolerance = 1e-9;

void need_finite(std::span<const double> numbers, const char* name) {
    for (const double number : numbers) {
        if (!std::isfinite(number)) {
            throw InvalidArgument(name, "is not finite");
        }
    }
}

IntegralRequest request_of(const elvis_integration& wanted) {
    if (wanted.domain > ELVIS_DOMAIN_ISOSURFACE) {
        throw InvalidArgument("domain", "is not known");
    }
    IntegralRequest request;
    request.domain = static_cast<IntegralRequest::Domain>(wanted.domain);
    request.field = text_or_empty(wanted.field);
    request.groups = texts(wanted.groups, wanted.n_groups, "groups");
    request.time_step = wanted.time_step;
    request.is_flux = wanted.is_flux != 0;
    if (request.is_flux) {
        need(wanted.field, "field");
    }
    if (request.domain == IntegralRequest::Domain::plane) {
        std::ranges::copy(wanted.plane, request.plane.begin());
        need_finite(request.plane, "plane");
        if (request.plane[0] == 0 && request.plane[1] == 0 && request.plane[2] == 0) {
            throw InvalidArgument("plane", "has a normal of length zero");
        }
    }
    if (request.domain == IntegralRequest::Domain::isosurface) {
        need(wanted.level_field, "level_field");
        need_finite({&wanted.isovalue, 1}, "isovalue");
        request.level_field = wanted.level_field;
        request.isovalue = wanted.isovalue;
    }
    request.tolerance = wanted.tolerance == 0 ? default_tolerance : wanted.tolerance;
    if (!(request.tolerance >= least_tolerance && request.tolerance < 1)) {
        throw InvalidArgument("tolerance", "is not in [1e-14, 1)");
    }
    return request;
}

elvis_integral answer_of(const Integral& found) {
    elvis_integral answer{};
    answer.is_converged = found.is_converged ? 1 : 0;
    answer.is_exact = found.is_exact ? 1 : 0;
    answer.value = found.value;
    answer.error = found.error;
    answer.measure = found.measure;
    answer.measure_error = found.measure_error;
    answer.n_parts = found.n_parts;
    answer.n_evaluations = found.n_evaluations;
    answer.n_inverted = found.n_inverted;
    answer.n_unresolved = found.n_unresolved;
    return answer;
}

} // namespace

} // namespace elvis::library

using namespace elvis;
using namespace elvis::library;

elvis_result elvis_data_integrate(elvis_data* data, const elvis_integration* integration, const elvis_task* task,
                                  elvis_integral* integral) {
    return call(data, [&] {
        need(integral, "integral");
        const IntegralRequest request = request_of(known_part(integration, "integration"));
        Data& state = *data->state;
        const DataTask running(state, task);
        give(answer_of(integrate(state.volume, request, *state.control)), integral, "integral");
    });
}
