#include <core/shader/fetch.hpp>

namespace elvis {

namespace {

struct RowType {
    const char* scalar;
    const char* row;
    const char* sampler;
};

/** How one row of four numbers is read from a part. */
std::string read_row(const RecordBuffer& records, bool texel, const std::string& part) {
    if (!texel) {
        return part + ".rows[row]";
    }
    if (records.kind() == RecordKind::real && records.precision() == Precision::float64) {
        // A row is two texels of two doubles.
        return "dvec4(core_unpack(texelFetch(" + part + ", int(2u * row))), core_unpack(texelFetch(" + part +
               ", int(2u * row + 1u))))";
    }
    return "texelFetch(" + part + ", int(row))";
}

RowType row_type(const RecordBuffer& records) {
    if (records.kind() == RecordKind::uint) {
        return {"uint", "uvec4", "usamplerBuffer"};
    }
    return records.precision() == Precision::float64 ? RowType{"double", "dvec4", "usamplerBuffer"}
                                                     : RowType{"float", "vec4", "samplerBuffer"};
}

} // namespace

FetchCode fetch_code(const Device& device, const RecordBuffer& records, const std::string& name, std::uint32_t first_binding) {
    const bool texel = device.uses_texel_buffers();
    const RowType type = row_type(records);
    const std::string rows_a_record = std::to_string(records.padded_record_size() / 4) + "u";
    const std::string records_a_part = std::to_string(records.records_per_part()) + "u";

    FetchCode code;
    std::string choice;
    for (std::uint32_t part = 0; part < records.n_parts(); ++part) {
        const std::uint32_t binding = first_binding + part;
        const std::string part_name = name + "_part" + std::to_string(part);
        const std::string layout = "layout(set = 0, binding = " + std::to_string(binding);
        if (texel) {
            code.text += layout + ") uniform " + type.sampler + " " + part_name + ";\n";
        } else {
            code.text += layout + ", std430) readonly restrict buffer " + part_name + "_block { " + type.row + " rows[]; } " +
                         part_name + ";\n";
        }
        code.layout.push_back({binding, texel ? BindingType::texel_buffer : BindingType::storage_buffer});
        code.bound.push_back({binding, nullptr, &records, part});
        const std::string read = read_row(records, texel, part_name);
        choice += part + 1 < records.n_parts() ? "part == " + std::to_string(part) + "u ? " + read + " : " : read;
    }
    code.text += std::string(type.row) + " " + name + "_row(uint record, uint row_of_record) {\n";
    if (records.n_parts() > 1) {
        code.text += "    uint part = record / " + records_a_part + ";\n";
        code.text += "    uint row = (record - part * " + records_a_part + ") * " + rows_a_record + " + row_of_record;\n";
    } else {
        code.text += "    uint row = record * " + rows_a_record + " + row_of_record;\n";
    }
    code.text += "    return " + choice + ";\n}\n";
    code.text += std::string(type.scalar) + " " + name + "(uint record, uint index) {\n    return " + name +
                 "_row(record, index >> 2)[index & 3u];\n}\n";
    return code;
}

} // namespace elvis
