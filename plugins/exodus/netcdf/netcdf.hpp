/**
 * @file netcdf.hpp
 * Files of netCDF, opened for reading: arrays with names, of numbers or characters.
 *
 * Errors are elvis::api::Error that names the file, the variable and the cause. Several threads may read at once.
 */
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace elvis_exodus {

using Extents = std::vector<std::uint64_t>;

class NetCdf {
public:
    virtual ~NetCdf() = default;

    const std::string& path() const { return m_path; }

    /** Length of a dimension, if there is one of that name. */
    virtual std::optional<std::uint64_t> dimension(const std::string& name) const = 0;
    virtual bool has(const std::string& variable) const = 0;
    virtual Extents shape(const std::string& variable) const = 0;
    /** Significant bits of a variable's numbers. */
    virtual unsigned mantissa_bits(const std::string& variable) const = 0;
    /** The box that begins at `start` and is `count` large, last index fastest; as many numbers as it holds. */
    virtual void read(const std::string& variable, const Extents& start, const Extents& count,
                      std::span<double> numbers) const = 0;
    virtual void read(const std::string& variable, const Extents& start, const Extents& count,
                      std::span<std::int64_t> numbers) const = 0;
    /** Rows of a variable of characters, or its only row, without zeros and blanks at their ends. */
    virtual std::vector<std::string> texts(const std::string& variable) const = 0;
    /** An attribute of a variable, if there is one and it is a text. */
    virtual std::optional<std::string> attribute(const std::string& variable, const std::string& name) const = 0;

    /** All numbers of a variable. */
    std::vector<double> reals(const std::string& variable) const;
    std::vector<std::int64_t> integers(const std::string& variable) const;

    /** Ends with an error about a variable. */
    [[noreturn]] void fail(const std::string& variable, const std::string& what) const;

protected:
    explicit NetCdf(std::string path) : m_path(std::move(path)) {}
    /** Throws unless the box lies in the shape and holds `n` numbers. */
    void check_box(const std::string& variable, const Extents& shape, const Extents& start, const Extents& count,
                   std::size_t n) const;

private:
    std::string m_path;
};

/** The product; throws for more than 2^48. */
std::uint64_t n_numbers(const NetCdf& file, const std::string& variable, const Extents& extents);

/** Whether a file begins as netCDF's own format does (classic, 64-bit offsets, 64-bit data). */
bool is_classic(const std::string& path);

/** Whether the beginning of a classic file has the name of a dimension that all Exodus II files have. */
bool names_blocks(const std::string& path);

/** A classic file, or netCDF-4, which is HDF5. */
std::unique_ptr<const NetCdf> open_netcdf(const std::string& path);
/** See classic_file.cpp and hdf5_file.cpp. */
std::unique_ptr<const NetCdf> open_classic(const std::string& path);
std::unique_ptr<const NetCdf> open_hdf5(const std::string& path);

} // namespace elvis_exodus
