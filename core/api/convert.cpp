#include "call.hpp"

#include <core/convert/request.hpp>

namespace elvis::library {

namespace {

ConvertRequest request_of(const elvis_conversion& conversion) {
    need(conversion.output, "output");
    ConvertRequest request{texts(conversion.inputs, conversion.n_inputs, "inputs"),
                           conversion.output,
                           text_or_empty(conversion.plugin),
                           text_or_empty(conversion.options),
                           {}};
    if (request.inputs.empty()) {
        throw InvalidArgument("inputs", "there are none");
    }
    constexpr std::int32_t highest = 30; // See elvis_source_space.
    if (conversion.order > highest) {
        throw InvalidArgument("order", "is above 30");
    }
    if (conversion.continuity > ELVIS_CONTINUITY_DISCONTINUOUS) {
        throw InvalidArgument("continuity", "is not known");
    }
    ConvertOptions& options = request.options;
    options.fields = texts(conversion.fields, conversion.n_fields, "fields");
    options.program_version = ELVIS_VERSION;
    if (conversion.order >= 0) {
        options.order = static_cast<std::uint32_t>(conversion.order);
    }
    if (conversion.continuity != ELVIS_CONTINUITY_UNKNOWN) {
        options.continuity = conversion.continuity;
    }
    return request;
}

} // namespace

} // namespace elvis::library

using namespace elvis;
using namespace elvis::library;

elvis_result elvis_convert(elvis_context* context, const elvis_conversion* conversion, const elvis_task* task, char** report) {
    return call(context, [&] {
        need(report, "report");
        *report = nullptr;
        const ConvertRequest request = request_of(known_part(conversion, "conversion"));
        TaskControl control;
        follow(control, task);
        *report = text_for_caller(to_json(convert(request, control)));
    });
}
