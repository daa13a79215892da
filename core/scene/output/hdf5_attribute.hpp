/**
 * @file hdf5_attribute.hpp
 * Attributes of objects in HDF5 files, and handles that close themselves. Throws std::runtime_error where HDF5 fails.
 */
#pragma once

#include <hdf5.h>

#include <span>
#include <stdexcept>
#include <string>
#include <utility>

namespace elvis {

/** Closes what it holds. */
class Hdf5Handle {
public:
    /** `id`: negative where HDF5 has failed. */
    Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : m_id(id), m_close(close) {
        if (id < 0) {
            throw std::runtime_error("cannot be written");
        }
    }
    Hdf5Handle(Hdf5Handle&& other) noexcept : m_id(std::exchange(other.m_id, -1)), m_close(other.m_close) {}
    ~Hdf5Handle() {
        if (m_id >= 0) {
            m_close(m_id);
        }
    }
    Hdf5Handle(const Hdf5Handle&) = delete;
    Hdf5Handle& operator=(const Hdf5Handle&) = delete;
    Hdf5Handle& operator=(Hdf5Handle&&) = delete;

    hid_t id() const { return m_id; }

private:
    hid_t m_id;
    herr_t (*m_close)(hid_t);
};

/** Text in UTF-8, of any length. */
inline Hdf5Handle hdf5_text_type() {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, H5T_VARIABLE);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return {type, H5Tclose};
}

inline void write_attribute(hid_t object, const char* name, hid_t type, const Hdf5Handle& space, const void* data) {
    const Hdf5Handle attribute(H5Acreate2(object, name, type, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (H5Awrite(attribute.id(), type, data) < 0) {
        throw std::runtime_error("cannot be written");
    }
}

inline void write_attribute(hid_t object, const char* name, const std::string& text) {
    const Hdf5Handle type = hdf5_text_type();
    const char* data = text.c_str();
    write_attribute(object, name, type.id(), Hdf5Handle(H5Screate(H5S_SCALAR), H5Sclose), &data);
}

inline void write_attribute(hid_t object, const char* name, std::span<const double> numbers) {
    const hsize_t n = numbers.size();
    write_attribute(object, name, H5T_NATIVE_DOUBLE, Hdf5Handle(H5Screate_simple(1, &n, nullptr), H5Sclose), numbers.data());
}

inline void write_attribute(hid_t object, const char* name, double number) {
    write_attribute(object, name, H5T_NATIVE_DOUBLE, Hdf5Handle(H5Screate(H5S_SCALAR), H5Sclose), &number);
}

} // namespace elvis
