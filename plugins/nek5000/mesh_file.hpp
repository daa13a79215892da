/**
 * @file mesh_file.hpp
 * Meshes, NAME.re2: the conditions on faces. The mapping of elements is that of the fields' file.
 */
#pragma once

#include "byte_file.hpp"
#include "numbers.hpp"

#include <functional>

namespace elvis_nek5000 {

struct FaceCondition {
    /** From 1. */
    std::uint64_t element = 0;
    /** From 1, as the mesh numbers them. */
    std::uint32_t face = 0;
    /** Up to three letters: W, v, O, SYM, ... */
    std::string kind;
    /** Number of the surface, 0 if there is none. */
    std::int64_t tag = 0;
};

class MeshFile {
public:
    explicit MeshFile(const std::string& path);

    std::uint64_t n_elements() const { return m_n_elements; }
    std::uint32_t dimension() const { return m_dimension; }
    /** All conditions: first those of velocity, then of temperature, then of scalars. */
    void for_each_condition(const std::function<void(const FaceCondition&)>& visit) const;

private:
    void read_header();
    /** A count, and the place moved behind it. */
    std::uint64_t take_count(std::uint64_t& place, std::uint64_t record_size) const;
    FaceCondition parse_condition(const char* bytes) const;

    ByteFile m_file;
    ByteFormat m_format;
    std::uint64_t m_n_elements = 0;
    std::uint32_t m_dimension = 3;
    /** Of conditions; as many as there are until the file ends if it does not say. */
    std::uint64_t m_n_fields = ~std::uint64_t{0};
};

} // namespace elvis_nek5000
