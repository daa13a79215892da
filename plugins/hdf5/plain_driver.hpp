/**
 * @file plain_driver.hpp
 * How HDF5 reads the bytes of a file.
 */
#pragma once

#include <plugin_api/native/src/file/hdf5.hpp>

#include <string>

namespace elvis::hdf5 {

/**
 * Opens a file for reading, with a driver that reads what it is asked for, and nothing beyond the file's end. HDF5's own ones
 * gather metadata in a buffer, in which HDF5 1.10 loses its way at addresses that damaged files hold (H5F__accum_read). Nor
 * does this one lock files, which some file systems cannot. The handle is invalid if the file cannot be opened.
 */
native::h5::Handle open_plainly(const std::string& path);

} // namespace elvis::hdf5
