/**
 * @file dataset.hpp
 * An array in an HDF5 file: numbers, or records of numbers, read by ranges.
 */
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace elvis::hdf5 {

/** Names from a record down to one of its members; empty for the whole entry. */
using Member = std::vector<std::string>;

class Dataset {
public:
    struct Impl;
    explicit Dataset(std::unique_ptr<Impl> impl);
    ~Dataset();
    Dataset(Dataset&&) noexcept;
    Dataset& operator=(Dataset&&) noexcept;

    const std::vector<std::uint64_t>& shape() const;
    /** Whether entries are plain numbers. */
    bool holds_numbers() const;
    /** Whether entries are records that have that member. */
    bool has(const Member& member) const;
    /** Members of the records in a member, in the order of the file. */
    std::vector<std::string> members(const Member& member) const;
    /** Numbers of an entry in a member: all arrays and records in it counted. */
    std::size_t entry_size(const Member& member) const;
    /** Significant bits of the numbers in a member: the least of all. */
    unsigned mantissa_bits(const Member& member) const;

    /**
     * Reads the box that begins at `start` and is `count` large, all numbers of a member of its entries. The size of `values`
     * is that of the box times entry_size. Integers are read from integers only.
     */
    void read(const std::vector<std::uint64_t>& start, const std::vector<std::uint64_t>& count, std::span<double> values,
              const Member& member = {}) const;
    void read(const std::vector<std::uint64_t>& start, const std::vector<std::uint64_t>& count, std::span<std::int64_t> values,
              const Member& member = {}) const;
    /** A member that is a text, of the entries of an array of one dimension. */
    std::vector<std::string> read_texts(std::uint64_t first, std::uint64_t count, const Member& member) const;

    /** Ends with an error about this dataset. */
    [[noreturn]] void fail(const std::string& what) const;

private:
    std::unique_ptr<Impl> m_impl;
};

} // namespace elvis::hdf5
