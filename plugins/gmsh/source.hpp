/**
 * @file source.hpp
 * The data set of one or several MSH files: one mesh and views on it.
 */
#pragma once

#include "views.hpp"

#include <elvis/plugin.hpp>

#include <memory>
#include <string>
#include <vector>

namespace gmsh {

class Source : public elvis::api::ConverterSource {
public:
    static std::uint32_t probe(const char* path);

    Source(const elvis::api::Host& host, const std::vector<std::string>& paths, const std::string& options);

    void get_info(elvis_source_info& info) override;
    void get_field(std::uint32_t field, elvis_source_field& out) override;
    void get_elements(std::uint64_t first, elvis::api::StructArray<elvis_source_element> out) override;
    void get_spaces(std::uint32_t field, std::uint64_t first, elvis::api::StructArray<elvis_source_space> out) override;
    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) override;
    void sample(std::uint32_t time_step, std::uint64_t element, std::span<const double> xi, double* values) override;
    double get_time(std::uint32_t time_step);
    elvis_string get_boundary_group(std::uint32_t group);

private:
    std::unique_ptr<const Mesh> m_mesh;
    std::unique_ptr<const BasisSet> m_bases;
    std::vector<View> m_views;
    std::vector<TimeStep> m_steps;
    /** Numbers a point in `sample`. */
    Eigen::Index m_n_values = 0;
};

} // namespace gmsh
