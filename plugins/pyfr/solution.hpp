/**
 * @file solution.hpp
 * One solution file: values at solution points, read by ranges of elements.
 */
#pragma once

#include "ini.hpp"
#include "mesh.hpp"

#include <limits>
#include <map>
#include <optional>

namespace elvis_pyfr {

/** Any thread may read. */
class Solution {
public:
    virtual ~Solution() = default;
    Solution(const Solution&) = delete;
    Solution& operator=(const Solution&) = delete;

    const std::string& path() const { return m_file.path(); }
    const std::string& uuid() const { return m_uuid; }
    /** Of the variables, in the order of values. */
    const std::vector<std::string>& names() const { return m_names; }
    /** Nothing if the file does not say. */
    std::optional<double> time() const { return m_time; }
    unsigned mantissa_bits() const { return m_mantissa_bits; }

    /** The functions on a kind of elements; none if the file has no values there. */
    std::shared_ptr<const elvis::nodal::NodalSpace> space(const Kind& kind) const;

    /** Ends with an error if the values are not those of a mesh's elements. */
    virtual void check(const Mesh& mesh) const = 0;
    /** Values of elements of a set that has a space: [element][variable][point]; NaN for elements without. */
    virtual std::vector<double> read(const ElementSet& set, std::uint64_t first, std::uint64_t count) const = 0;

protected:
    /** Spaces are taken from `spaces`, which outlives this. */
    Solution(elvis::hdf5::File file, elvis::nodal::NodalSpaces& spaces);

    /** The functions whose values are at these points, in ElVis's coordinates; `place` is the dataset that says so. */
    void set_space(const Kind& kind, std::vector<double> points, const std::string& place);
    void note_mantissa(unsigned bits) { m_mantissa_bits = std::min(m_mantissa_bits, bits); }

    elvis::hdf5::File m_file;
    Ini m_stats;
    /** Of the data: soln, tavg. */
    std::string m_prefix;
    std::vector<std::string> m_names;

private:
    std::string m_uuid;
    std::optional<double> m_time;
    unsigned m_mantissa_bits = 53;
    elvis::nodal::NodalSpaces* m_known_spaces;
    std::map<const Kind*, std::shared_ptr<const elvis::nodal::NodalSpace>> m_spaces;
};

std::unique_ptr<const Solution> open_solution(elvis::hdf5::File file, elvis::nodal::NodalSpaces& spaces);

} // namespace elvis_pyfr
