#include <core/convert/convert.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

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

double number_of(const nlohmann::json& value) {
    return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

elvis_continuity continuity_named(const std::string& name) {
    for (const elvis_continuity continuity : {ELVIS_CONTINUITY_CONTINUOUS, ELVIS_CONTINUITY_DISCONTINUOUS}) {
        if (name == continuity_name(continuity)) {
            return continuity;
        }
    }
    return ELVIS_CONTINUITY_UNKNOWN;
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

ConvertReport report_from_json(const std::string& text) {
    const nlohmann::json root = nlohmann::json::parse(text);
    ConvertReport report;
    for (const nlohmann::json& item : root.at("fields")) {
        FieldReport field;
        field.name = item.at("name");
        field.exact = item.at("exact");
        field.residual = number_of(item.at("residual"));
        field.mantissa_bits = item.at("mantissa_bits");
        field.max_jump = number_of(item.at("max_jump"));
        field.continuity = continuity_named(item.at("continuity"));
        field.lower = number_of(item.at("range").at(0));
        field.upper = number_of(item.at("range").at(1));
        field.n_not_finite = item.at("elements_not_finite");
        report.fields.push_back(std::move(field));
    }
    report.geometry_exact = root.at("geometry").at("exact");
    report.geometry_residual = number_of(root.at("geometry").at("residual"));
    report.elements = root.at("elements");
    const nlohmann::json& faces = root.at("faces");
    report.n_faces = faces.at("total");
    report.n_boundary_faces = faces.at("boundary");
    report.n_unknown_faces = faces.at("unknown_neighbour");
    report.n_coefficients = root.at("coefficients");
    report.seconds = root.at("seconds");
    return report;
}

} // namespace elvis
