#include <core/shader/fetch.hpp>

namespace elvis {

namespace {

/** What a record buffer's numbers are in GLSL. */
struct Stored {
    const char* number; ///< "float", "double", "uint"
    const char* row;    ///< vector of four
    bool is_double;
};

Stored stored_as(const RecordBuffer& records) {
    if (records.kind() == RecordKind::uint) {
        return {"uint", "uvec4", false};
    }
    return records.precision() == Precision::float64 ? Stored{"double", "dvec4", true} : Stored{"float", "vec4", false};
}

std::string unsigned_literal(std::uint64_t value) { return std::to_string(value) + "u"; }

class FetchWriter {
public:
    FetchWriter(const Device& device, const RecordBuffer& records, std::uint32_t number)
        : m_records(records), m_stored(stored_as(records)), m_texels(device.uses_texel_buffers()), m_number(number) {}

    std::string write(std::uint32_t first_binding) const {
        std::string text;
        for (std::uint32_t part = 0; part < m_records.n_parts(); ++part) {
            text += declaration(part, first_binding + part);
        }
        text += function(m_stored.row, "core_row_", "row", &FetchWriter::row_of_part);
        text += function(m_stored.number, "core_number_", "index", &FetchWriter::number_of_part);
        return text;
    }

private:
    using Access = std::string (FetchWriter::*)(std::uint32_t part, const std::string& record) const;

    std::string part_name(std::uint32_t part) const {
        return "core_part_" + std::to_string(m_number) + "_" + std::to_string(part);
    }

    std::string declaration(std::uint32_t part, std::uint32_t binding) const {
        const std::string place = "set = 0, binding = " + std::to_string(binding) + ") ";
        if (m_texels) {
            const bool is_float = m_records.kind() == RecordKind::real && !m_stored.is_double;
            return "layout(" + place + "uniform " + (is_float ? "samplerBuffer " : "usamplerBuffer ") + part_name(part) + ";\n";
        }
        return "layout(std430, " + place + "readonly restrict buffer core_block_" + std::to_string(binding) + " { " +
               m_stored.row + " " + part_name(part) + "[]; };\n";
    }

    /** Position of a row of four numbers in its part. */
    std::string row_position(const std::string& record, const std::string& row) const {
        return "(" + record + ") * " + unsigned_literal(m_records.padded_record_size() / 4) + " + " + row;
    }

    std::string texel(std::uint32_t part, const std::string& position) const {
        return "texelFetch(" + part_name(part) + ", int(" + position + "))";
    }

    std::string row_of_part(std::uint32_t part, const std::string& record) const {
        const std::string position = row_position(record, "row");
        if (!m_texels) {
            return part_name(part) + "[" + position + "]";
        }
        if (!m_stored.is_double) {
            return texel(part, position);
        }
        const std::string first = "2u * (" + position + ")";
        return "core_doubles(" + texel(part, first) + ", " + texel(part, first + " + 1u") + ")";
    }

    std::string number_of_part(std::uint32_t part, const std::string& record) const {
        if (!m_texels) {
            return part_name(part) + "[" + row_position(record, "(index >> 2u)") + "][index & 3u]";
        }
        if (!m_stored.is_double) {
            return texel(part, row_position(record, "(index >> 2u)")) + "[index & 3u]";
        }
        return "core_double(" +
               texel(part, "(" + record + ") * " + unsigned_literal(m_records.padded_record_size() / 2) + " + (index >> 1u)") +
               ", index)";
    }

    /** The function with a branch for each part. The state is written once on each way: no variable is carried round a loop. */
    std::string function(const char* type, const char* name, const char* parameter, Access access) const {
        std::string text =
            std::string(type) + " " + name + std::to_string(m_number) + "(uint record, uint " + parameter + ") {\n";
        const std::uint32_t n_parts = m_records.n_parts();
        if (n_parts == 1) {
            return text + "    return " + (this->*access)(0, "record") + ";\n}\n";
        }
        text += std::string("    ") + type + " value = " + type + "(0);\n    ";
        for (std::uint32_t part = 0; part < n_parts; ++part) {
            const std::uint64_t first = part * m_records.records_per_part();
            const std::uint64_t end = std::min(first + m_records.records_per_part(), m_records.n_records());
            text += "if (record < " + unsigned_literal(end) + ") {\n        value = " +
                    (this->*access)(part, part == 0 ? "record" : "record - " + unsigned_literal(first)) + ";\n    }" +
                    (part + 1 < n_parts ? " else " : "\n");
        }
        return text + "    return value;\n}\n";
    }

    const RecordBuffer& m_records;
    Stored m_stored;
    bool m_texels;
    std::uint32_t m_number;
};

} // namespace

std::string fetch_helpers() {
    return "dvec4 core_doubles(uvec4 low, uvec4 high) {\n"
           "    return dvec4(packDouble2x32(low.xy), packDouble2x32(low.zw), packDouble2x32(high.xy), "
           "packDouble2x32(high.zw));\n"
           "}\n"
           "double core_double(uvec4 texel, uint index) {\n"
           "    return packDouble2x32((index & 1u) == 0u ? texel.xy : texel.zw);\n"
           "}\n";
}

std::string fetch_functions(const Device& device, const RecordBuffer& records, std::uint32_t number,
                            std::uint32_t first_binding) {
    return FetchWriter(device, records, number).write(first_binding);
}

std::string fetch_macros(const std::string& name, const RecordBuffer& records, std::uint32_t number, bool is_debug_build) {
    const bool is_uint = records.kind() == RecordKind::uint;
    const std::string n = std::to_string(number);
    const auto index = [&](const std::string& parameter, std::uint64_t limit) {
        return is_debug_build ? "core_index(" + parameter + ", " + unsigned_literal(limit) + ", __LINE__)" : parameter;
    };
    const std::string record = index("record", records.n_records());
    return "#define elvis_fetch_" + name + "(record, index) " + (is_uint ? "uint" : "elvis_real") + "(core_number_" + n + "(" +
           record + ", " + index("index", records.record_size()) + "))\n#define elvis_fetch4_" + name + "(record, row) " +
           (is_uint ? "uvec4" : "elvis_vec4") + "(core_row_" + n + "(" + record + ", " +
           index("row", (records.record_size() + 3) / 4) + "))\n";
}

std::string fetch_undefs(const std::string& name) {
    return "#undef elvis_fetch_" + name + "\n#undef elvis_fetch4_" + name + "\n";
}

} // namespace elvis
