/**
 * @file integrals.hpp
 * Integrals and extrema, as `elvis integrate` and `elvis extrema` find them.
 */
#pragma once

#include <apps/serve/served.hpp>

#include <nlohmann/json.hpp>

#include <array>
#include <string>
#include <vector>

namespace elvis::serve {

/** See elvis_integration. */
struct IntegralWishes {
    elvis_domain domain = ELVIS_DOMAIN_VOLUME;
    /** Empty: the number 1. */
    std::string field;
    std::vector<std::string> groups;
    std::array<double, 4> plane{};
    std::string level_field;
    double isovalue = 0;
    bool is_flux = false;
    /** 0: the usual one. */
    double tolerance = 0;
};

/** `integral`, what `elvis integrate` prints, and `doubts`, a list of sentences. */
nlohmann::json integral_of(const Served& served, const Scene& scene, const IntegralWishes& wishes, const task& watch);
/** What `elvis extrema` prints. */
nlohmann::json extrema_of(const Served& served, const Scene& scene, const std::string& field, const task& watch);

} // namespace elvis::serve
