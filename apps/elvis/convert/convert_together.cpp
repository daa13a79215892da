#include "convert_together.hpp"

#include <core/convert/request.hpp>

namespace elvis::commands {

std::string convert_together(const Conversion& conversion, Team& team) {
    ConvertRequest request{conversion.inputs, conversion.output, conversion.plugin, conversion.options, {}};
    ConvertOptions& options = request.options;
    options.program_version = ELVIS_VERSION;
    options.fields = conversion.fields;
    if (conversion.order >= 0) {
        options.order = static_cast<std::uint32_t>(conversion.order);
    }
    if (!conversion.continuity.empty()) {
        options.continuity = conversion.continuity == "cg" ? ELVIS_CONTINUITY_CONTINUOUS : ELVIS_CONTINUITY_DISCONTINUOUS;
    }
    return to_json(convert(request, {}, &team));
}

} // namespace elvis::commands
