#include "conversion.hpp"

#include <apps/elvis/library_context.hpp>

namespace elvis::commands {

std::string convert_here(const Conversion& wanted, const TaskControl& control) {
    const std::vector<elvis_string> inputs = detail::c_strings(wanted.inputs), fields = detail::c_strings(wanted.fields);
    auto conversion = detail::sized<elvis_conversion>();
    conversion.n_inputs = static_cast<std::uint32_t>(inputs.size());
    conversion.inputs = inputs.data();
    conversion.output = wanted.output.c_str();
    conversion.plugin = detail::or_null(wanted.plugin);
    conversion.options = detail::or_null(wanted.options);
    conversion.n_fields = static_cast<std::uint32_t>(fields.size());
    conversion.fields = fields.data();
    conversion.order = wanted.order;
    conversion.continuity = wanted.continuity.empty()   ? ELVIS_CONTINUITY_UNKNOWN
                            : wanted.continuity == "cg" ? ELVIS_CONTINUITY_CONTINUOUS
                                                        : ELVIS_CONTINUITY_DISCONTINUOUS;
    const task watch{[&](double fraction, const char* activity) { control.progress(fraction, activity); },
                     [&] { return control.is_cancelled(); }};
    return library_context().convert(conversion, watch);
}

} // namespace elvis::commands
