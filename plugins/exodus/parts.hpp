/**
 * @file parts.hpp
 * The parts of a data set, each in a file with nodes, elements and variables of its own; elements count through all.
 */
#pragma once

#include "mesh.hpp"
#include "netcdf/netcdf.hpp"
#include "variables.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace elvis_exodus {

struct Part {
    Part(const std::string& path, const elvis::api::Host& host)
        : file(open_netcdf(path)), mesh(*file, host), variables(*file, mesh) {}

    std::unique_ptr<const NetCdf> file;
    Mesh mesh;
    Variables variables;
};

/** At least one part; all have the dimension, the fields and the time steps of the first. Any thread may ask. */
class Parts {
public:
    Parts(const std::vector<std::string>& paths, const elvis::api::Host& host);

    const Part& first() const { return *m_parts.front(); }
    const std::vector<std::unique_ptr<const Part>>& all() const { return m_parts; }
    std::uint64_t n_elements() const { return m_first_elements.back(); }
    std::uint32_t mantissa_bits() const { return m_mantissa_bits; }
    /** Names of groups of all parts. */
    const std::vector<std::string>& groups() const { return m_groups; }

    struct Place {
        const Part& part;
        std::uint64_t element;
        /** Of each of the part's groups, its number among all. */
        const std::vector<std::int32_t>& groups;
    };
    Place place(std::uint64_t element) const;

private:
    void add(std::unique_ptr<const Part> part);

    std::vector<std::unique_ptr<const Part>> m_parts;
    /** Of each part its first element, and the number of all. */
    std::vector<std::uint64_t> m_first_elements{0};
    std::vector<std::string> m_groups;
    std::vector<std::vector<std::int32_t>> m_part_groups;
    std::uint32_t m_mantissa_bits = 53;
};

} // namespace elvis_exodus
