/**
 * @file object.hpp
 * What reading of files and of datasets shares. Every function is called while a Lock is held.
 */
#pragma once

#include "dataset.hpp"

#include <elvis/plugin.hpp>
#include <plugin_api/native/src/file/hdf5.hpp>

#include <functional>
#include <optional>

namespace elvis::hdf5 {

using native::h5::check;
using native::h5::Handle;
using native::h5::Lock;
using native::h5::Place;

/** Runs a call with HDF5's lock; what it says of a file becomes the error of a plugin. */
template <class Call> auto locked(const std::string& path, Call&& call) {
    const Lock lock;
    try {
        return call();
    } catch (const native::FileError& error) {
        const std::string what = error.what();
        // The text of a FileError begins with the path, that of a plugin's error does not.
        const std::string prefix = path + ": ";
        throw api::Error(ELVIS_ERROR_FORMAT, path, what.starts_with(prefix) ? what.substr(prefix.size()) : what);
    }
}

/** Extents of a dataset or attribute; empty for a single entry. */
std::vector<std::uint64_t> extents(const Handle& space, const Place& place);

/** Entries in all; nothing if that is more than 2^60. */
std::optional<std::uint64_t> n_entries(const std::vector<std::uint64_t>& shape);

/**
 * Whether a type is that of integers of 1 to 8 bytes or of floating-point numbers of 4 or 8, in either byte order. Damaged
 * files describe others, at which HDF5 1.10 reads beyond its memory.
 */
bool is_number(hid_t type);

/** A text without blanks and zeros at its end. */
std::string trimmed(std::string text);

/**
 * All texts of a dataset or attribute whose type and number are given; `read(type, target)` is H5Dread or H5Aread. Texts of
 * variable length are freed with `space`.
 */
std::vector<std::string> read_all_texts(const Handle& type, const Handle& space, const Place& place,
                                        const std::function<herr_t(hid_t type, void* target)>& read);

/** Made and destroyed while a Lock is held. */
struct Dataset::Impl {
    Impl(Place where, Handle opened, Handle type_in_file, std::vector<std::uint64_t> extents_in_file)
        : place(std::move(where)), dataset(std::move(opened)), type(std::move(type_in_file)),
          shape(std::move(extents_in_file)) {}

    Place place;
    Handle dataset;
    Handle type;
    std::vector<std::uint64_t> shape;
};

/** Opens a dataset and sees to it that the file is large enough for it. */
std::unique_ptr<Dataset::Impl> open_dataset(const Handle& file, const std::string& name, const Place& place);

} // namespace elvis::hdf5
