/**
 * @file hdf5.hpp
 * HDF5's C library behind handles that close themselves and errors that say where they happened.
 *
 * Every function here is called while a Lock is held.
 */
#pragma once

#include <elvis/native/volume_file.hpp>

#include <hdf5.h>

#include <mutex>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace elvis::native::h5 {

/**
 * Holds the lock of this library, with HDF5's own printing of errors turned off for this thread. Other users of HDF5 in the
 * process are kept apart by HDF5 itself, where it is built thread-safe (as Debian's is).
 *
 * Printing is as before afterwards, unless an exception leaves: HDF5 1.10 cannot release all of a damaged file and would print
 * "infinite loop closing library" when the program ends.
 */
class Lock {
public:
    Lock();
    ~Lock();
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

private:
    std::unique_lock<std::mutex> m_guard;
    H5E_auto2_t m_printer = nullptr;
    void* m_printer_data = nullptr;
};

/** An open object of any kind. */
class Handle {
public:
    using Close = herr_t (*)(hid_t);
    Handle() = default;
    Handle(hid_t id, Close close) : m_id(id), m_close(close) {}
    ~Handle() { reset(); }
    Handle(Handle&& other) noexcept : m_id(std::exchange(other.m_id, H5I_INVALID_HID)), m_close(other.m_close) {}
    Handle& operator=(Handle&& other) noexcept {
        if (this != &other) {
            reset();
            m_id = std::exchange(other.m_id, H5I_INVALID_HID);
            m_close = other.m_close;
        }
        return *this;
    }

    hid_t id() const { return m_id; }
    bool is_valid() const { return m_id >= 0; }
    void reset() {
        if (m_id >= 0) {
            m_close(std::exchange(m_id, H5I_INVALID_HID));
        }
    }

private:
    hid_t m_id = H5I_INVALID_HID;
    Close m_close = nullptr;
};

/** Which file and which object in it is being worked on: what an error names. */
struct Place {
    std::string file;
    std::string object;

    [[noreturn]] void fail(const std::string& what) const;
    /** The same with the innermost message of HDF5's error stack. */
    [[noreturn]] void fail_with_stack(const std::string& what) const;
    Place child(const std::string& name) const { return {file, object + "/" + name}; }
};

/** Throws if `result` of an HDF5 call is negative. */
template <class Result> Result check(Result result, const Place& place, const char* what) {
    if (result < 0) {
        place.fail_with_stack(what);
    }
    return result;
}

template <class T> hid_t native_type() {
    if constexpr (std::is_same_v<T, double>) {
        return H5T_NATIVE_DOUBLE;
    } else if constexpr (std::is_same_v<T, std::int64_t>) {
        return H5T_NATIVE_INT64;
    } else if constexpr (std::is_same_v<T, std::uint64_t>) {
        return H5T_NATIVE_UINT64;
    } else {
        static_assert(std::is_same_v<T, std::uint32_t>);
        return H5T_NATIVE_UINT32;
    }
}

/** The type in the file: little-endian whatever the machine. */
template <class T> hid_t file_type() {
    if constexpr (std::is_same_v<T, double>) {
        return H5T_IEEE_F64LE;
    } else if constexpr (std::is_same_v<T, std::int64_t>) {
        return H5T_STD_I64LE;
    } else if constexpr (std::is_same_v<T, std::uint64_t>) {
        return H5T_STD_U64LE;
    } else {
        static_assert(std::is_same_v<T, std::uint32_t>);
        return H5T_STD_U32LE;
    }
}

Handle open_group(const Handle& parent, const std::string& name, const Place& place);
Handle create_group(const Handle& parent, const std::string& name, const Place& place);

/** Attributes: arrays of numbers of known length, and texts of fixed length. */
void write_attribute_raw(const Handle& object, const char* name, hid_t in_file, hid_t in_memory, const void* data,
                         hsize_t count, const Place& place);
void read_attribute_raw(const Handle& object, const char* name, hid_t in_file, hid_t in_memory, void* data, hsize_t count,
                        const Place& place);
void write_text(const Handle& object, const char* name, const std::string& text, const Place& place);
std::string read_text(const Handle& object, const char* name, const Place& place);

template <class T> void write_attribute(const Handle& object, const char* name, const T& value, const Place& place) {
    write_attribute_raw(object, name, file_type<T>(), native_type<T>(), &value, 1, place);
}
template <class T> T read_attribute(const Handle& object, const char* name, const Place& place) {
    T value{};
    read_attribute_raw(object, name, file_type<T>(), native_type<T>(), &value, 1, place);
    return value;
}

/**
 * A chunked, compressed, checksummed dataset; `rows_a_chunk` runs along dimension `row_dimension`, dimensions before it have
 * chunks of one, those after it are whole in a chunk.
 */
Handle create_dataset(const Handle& parent, const std::string& name, hid_t type, const std::vector<hsize_t>& shape,
                      std::size_t row_dimension, std::size_t bytes_a_row, const Place& place);

/**
 * Opens a dataset and refuses it unless type and shape are as expected, every chunk is present, and every chunk has a checksum.
 * `type` is exact for numbers; of texts, only that they have a fixed length is asked.
 */
Handle open_dataset(const Handle& parent, const std::string& name, hid_t type, const std::vector<hsize_t>& shape,
                    const Place& place);

/** Whether the group has an object of that name. */
bool has_object(const Handle& group, const std::string& name, const Place& place);

/** Reads or writes the box that starts at `start` and is `count` large. */
void read_box(const Handle& dataset, hid_t type, const std::vector<hsize_t>& start, const std::vector<hsize_t>& count,
              void* data, const Place& place);
void write_box(const Handle& dataset, hid_t type, const std::vector<hsize_t>& start, const std::vector<hsize_t>& count,
               const void* data, const Place& place);

/** A dataset of texts of one fixed length; `shape` is its shape, entries row by row. */
void write_texts(const Handle& parent, const std::string& name, const std::vector<std::string>& texts,
                 const std::vector<hsize_t>& shape, const Place& place);
std::vector<std::string> read_texts(const Handle& parent, const std::string& name, const std::vector<hsize_t>& shape,
                                    const Place& place);

} // namespace elvis::native::h5
