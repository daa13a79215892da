#include "conversion_process.hpp"

#include <core/convert/request.hpp>

namespace elvis::commands {

std::string convert_apart(const std::vector<std::string>& inputs, const std::string& output_file, const TaskControl& control,
                          int output) {
    ConvertProcess process;
    process.output = output;
    return to_json(convert_separately({inputs, output_file, {}, {}, {}}, control, process));
}

} // namespace elvis::commands
