/**
 * @file file.hpp
 * HDF5 files of other programs, open for reading. What is wrong with one is an elvis::api::Error that names the file, the
 * object in it and the cause.
 *
 * HDF5 does one thing at a time: calls from several threads wait for each other.
 */
#pragma once

#include "dataset.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace elvis::hdf5 {

/** Whether a file begins as HDF5 files do. False for files that cannot be read. */
bool is_hdf5(const std::string& path);

class File {
public:
    explicit File(const std::string& path);
    ~File();
    File(File&&) noexcept;
    File& operator=(File&&) noexcept;

    const std::string& path() const;

    /** Whether there is an object of that name; names of groups and what is in them are separated by '/'. */
    bool has(const std::string& name) const;
    /** Names of what is in a group ("/" is the file itself), sorted. */
    std::vector<std::string> names(const std::string& group) const;

    /** Texts of fixed or variable length, without blanks and zeros at their ends. */
    std::vector<std::string> texts(const std::string& dataset) const;
    /** A dataset of one text. */
    std::string text(const std::string& dataset) const;
    /** A dataset of one number. */
    std::int64_t integer(const std::string& dataset) const;

    Dataset dataset(const std::string& name) const;

    /** Attributes of an object. */
    bool has_attribute(const std::string& object, const std::string& name) const;
    std::vector<double> numbers_of_attribute(const std::string& object, const std::string& name) const;
    std::vector<std::string> texts_of_attribute(const std::string& object, const std::string& name) const;

    /** Ends with an error about an object. */
    [[noreturn]] void fail(const std::string& object, const std::string& what) const;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace elvis::hdf5
