/**
 * @file snapshot.hpp
 * Nodal values at one time.
 */
#pragma once

#include "byte_file.hpp"
#include "field_code.hpp"
#include "nodal_basis.hpp"

#include <span>

namespace elvis_nek5000 {

struct Precision {
    /** Significant bits. */
    std::uint32_t mantissa_bits = 53;
    /** Largest distance of neighbouring numbers, relative to their size. */
    double spacing = 0;
};

inline constexpr Precision double_precision{53, 0x1p-52};
inline constexpr Precision single_precision{24, 0x1p-23};

/** Reads an element at a time; nothing is held but a table of where elements are. Any thread may ask. */
class Snapshot {
public:
    virtual ~Snapshot() = default;
    Snapshot(const Snapshot&) = delete;
    Snapshot& operator=(const Snapshot&) = delete;

    /** Of the first part. */
    const std::string& path() const { return m_path; }
    const Content& content() const { return m_content; }
    std::uint32_t n_parts() const { return m_n_parts; }
    /** Where the values of a block stand. */
    NodeSet nodes(std::size_t block) const;

    /** Values of all nodes of an element, component by component, the first direction fastest. Room for all of them. */
    virtual void read(std::size_t block, std::uint64_t element, std::span<double> values) const = 0;
    /** In which part an element is; 0 if there is one. */
    virtual std::uint32_t part(std::uint64_t) const { return 0; }
    /** Frees the table of elements until it is needed again. */
    virtual void forget() const {}
    /** Of the numbers in the file. */
    virtual Precision precision() const = 0;

protected:
    Snapshot(std::string path, Content content, std::uint32_t n_parts);

private:
    std::string m_path;
    Content m_content;
    std::uint32_t m_n_parts;
    bool m_is_regular;
};

/** How sure it is that the file holds a time step, from 0 to 100. */
std::uint32_t probe_snapshot(const ByteFile& file);

std::unique_ptr<Snapshot> open_snapshot(const std::string& path, OpenFiles& files);

} // namespace elvis_nek5000
