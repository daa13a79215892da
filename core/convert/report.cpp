#include <core/convert/convert.hpp>

#include <nlohmann/json.hpp>

#include <cmath>

namespace elvis {

namespace {

/** JSON has neither NaN nor infinity. */
nlohmann::ordered_json number(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

const char* continuity_name(elvis_continuity continuity) {
    return continuity == ELVIS_CONTINUITY_CONTINUOUS      ? "continuous"
           : continuity == ELVIS_CONTINUITY_DISCONTINUOUS ? "discontinuous"
                                                          : "unknown";
}

} // namespace

std::string to_json(const ConvertReport& report) {
    nlohmann::ordered_json root;
    root["fields"] = nlohmann::ordered_json::array();
    for (const FieldReport& field : report.fields) {
        root["fields"].push_back({{"name", field.name},
                                  {"exact", field.exact},
                                  {"residual", number(field.residual)},
                                  {"mantissa_bits", field.mantissa_bits},
                                  {"max_jump", number(field.max_jump)},
                                  {"continuity", continuity_name(field.continuity)},
                                  {"range", {number(field.lower), number(field.upper)}},
                                  {"elements_not_finite", field.n_not_finite}});
    }
    root["geometry"] = {{"exact", report.geometry_exact}, {"residual", number(report.geometry_residual)}};
    root["elements"] = nlohmann::ordered_json::object();
    for (const auto& [shape, count] : report.elements) {
        root["elements"][shape] = count;
    }
    root["faces"] = {
        {"total", report.n_faces}, {"boundary", report.n_boundary_faces}, {"unknown_neighbour", report.n_unknown_faces}};
    root["coefficients"] = report.n_coefficients;
    root["seconds"] = report.seconds;
    return root.dump(2);
}

} // namespace elvis
