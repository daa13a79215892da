/**
 * @file written_hdf5.hpp
 * Writes HDF5 files for tests, with nothing of those who read them.
 */
#pragma once

#include <plugin_api/native/src/file/hdf5.hpp>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace elvis::test {

using native::h5::Handle;

inline Handle made(hid_t id, Handle::Close close) {
    if (id < 0) {
        throw std::runtime_error("HDF5 could not write a test's file");
    }
    return {id, close};
}

inline Handle array_of(const Handle& base, std::vector<hsize_t> extent) {
    return made(H5Tarray_create2(base.id(), static_cast<unsigned>(extent.size()), extent.data()), H5Tclose);
}

inline Handle number_type(hid_t type) { return made(H5Tcopy(type), H5Tclose); }

inline Handle text_type(std::size_t length) {
    Handle type = made(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.id(), length);
    return type;
}

/** Name and type of a record's member. */
using Member = std::pair<std::string, Handle>;

/** A record without gaps. */
inline Handle record_of(std::vector<Member> members) {
    std::size_t size = 0;
    for (const auto& [name, type] : members) {
        size += H5Tget_size(type.id());
    }
    Handle record = made(H5Tcreate(H5T_COMPOUND, size), H5Tclose);
    std::size_t offset = 0;
    for (const auto& [name, type] : members) {
        H5Tinsert(record.id(), name.c_str(), offset, type.id());
        offset += H5Tget_size(type.id());
    }
    return record;
}

/** Bytes of records, one number after the other. */
class Bytes {
public:
    template <class Number> void add(Number number) {
        const auto* const first = reinterpret_cast<const char*>(&number);
        m_bytes.insert(m_bytes.end(), first, first + sizeof number);
    }
    void add_real(double value, bool is_single) {
        if (is_single) {
            add(static_cast<float>(value));
        } else {
            add(value);
        }
    }
    void add_text(std::string text, std::size_t length) {
        text.resize(length, '\0');
        m_bytes.insert(m_bytes.end(), text.begin(), text.end());
    }
    const void* data() const { return m_bytes.data(); }

private:
    std::vector<char> m_bytes;
};

class WrittenFile {
public:
    explicit WrittenFile(const std::string& path)
        : m_file(made(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose)) {}

    void group(const std::string& name) {
        made(H5Gcreate2(m_file.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    }
    void dataset(const std::string& name, const Handle& type, std::vector<hsize_t> shape, const void* data) {
        const Handle space = made(shape.empty() ? H5Screate(H5S_SCALAR)
                                                : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                                  H5Sclose);
        const Handle set =
            made(H5Dcreate2(m_file.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
        H5Dwrite(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
    }
    void text(const std::string& name, const std::string& text) { texts(name, {text}, true); }
    void texts(const std::string& name, const std::vector<std::string>& texts, bool is_single = false) {
        std::size_t length = 1;
        for (const std::string& one : texts) {
            length = std::max(length, one.size());
        }
        const Handle type = text_type(length);
        Bytes bytes;
        for (const std::string& one : texts) {
            bytes.add_text(one, length);
        }
        dataset(name, type, is_single ? std::vector<hsize_t>{} : std::vector<hsize_t>{texts.size()}, bytes.data());
    }
    void integer(const std::string& name, std::int64_t value) { dataset(name, number_type(H5T_STD_I64LE), {}, &value); }
    /** An attribute of an object, of reals. */
    void attribute(const std::string& object, const std::string& name, std::vector<hsize_t> shape,
                   const std::vector<double>& numbers) {
        attribute(object, name, number_type(H5T_IEEE_F64LE), std::move(shape), numbers.data());
    }
    void attribute(const std::string& object, const std::string& name, const Handle& type, std::vector<hsize_t> shape,
                   const void* data) {
        const Handle owner = made(H5Oopen(m_file.id(), object.c_str(), H5P_DEFAULT), H5Oclose);
        const Handle space = made(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
        const Handle attribute =
            made(H5Acreate2(owner.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
        H5Awrite(attribute.id(), type.id(), data);
    }
    /** Texts filled up with blanks to a length, as Fortran writes them. */
    void texts_attribute(const std::string& object, const std::string& name, const std::vector<std::string>& texts,
                         std::size_t length) {
        Bytes bytes;
        for (std::string one : texts) {
            one.resize(length, ' ');
            bytes.add_text(one, length);
        }
        attribute(object, name, text_type(length), {texts.size()}, bytes.data());
    }

private:
    Handle m_file;
};

inline Member member(const std::string& name, Handle type) { return {name, std::move(type)}; }

inline std::vector<Member> list(Member first) {
    std::vector<Member> members;
    members.push_back(std::move(first));
    return members;
}

} // namespace elvis::test
