#include "file.hpp"

#include "object.hpp"
#include "plain_driver.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

namespace elvis::hdf5 {

bool is_hdf5(const std::string& path) {
    constexpr std::array<char, 8> signature = {'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
    std::array<char, 8> found{};
    std::ifstream file(path, std::ios::binary);
    return file.read(found.data(), found.size()) && found == signature;
}

/** Made and destroyed while a Lock is held. */
struct File::Impl {
    std::string path;
    Handle file;

    Place place(const std::string& object) const { return {path, object}; }
    bool has(const std::string& name) const;
    Handle open_object(const std::string& name) const {
        return {check(H5Oopen(file.id(), name.c_str(), H5P_DEFAULT), place(name), "is missing or damaged"), H5Oclose};
    }
    Handle open_attribute(const std::string& object, const std::string& name) const {
        const Handle owner = open_object(object);
        return {check(H5Aopen(owner.id(), name.c_str(), H5P_DEFAULT), place(object + "@" + name), "is missing or damaged"),
                H5Aclose};
    }
};

bool File::Impl::has(const std::string& name) const {
    // Groups on the way have to be asked for one by one.
    for (std::size_t end = name.find('/'); end != std::string::npos; end = name.find('/', end + 1)) {
        if (H5Lexists(file.id(), name.substr(0, end).c_str(), H5P_DEFAULT) <= 0) {
            return false;
        }
    }
    return H5Lexists(file.id(), name.c_str(), H5P_DEFAULT) > 0;
}

File::File(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
        throw api::Error(ELVIS_ERROR_FILE, path, "there is no such file");
    }
    m_impl = locked(path, [&] {
        auto impl = std::make_unique<Impl>();
        impl->path = path;
        impl->file = open_plainly(path);
        if (!impl->file.is_valid()) {
            impl->place("").fail_with_stack("is not a readable HDF5 file: of another format, truncated or damaged");
        }
        return impl;
    });
}

File::~File() {
    if (m_impl) {
        const Lock lock;
        m_impl.reset();
    }
}
File::File(File&&) noexcept = default;
File& File::operator=(File&& other) noexcept {
    std::swap(m_impl, other.m_impl);
    return *this;
}

const std::string& File::path() const { return m_impl->path; }

bool File::has(const std::string& name) const {
    return locked(m_impl->path, [&] { return m_impl->has(name); });
}

std::vector<std::string> File::names(const std::string& group) const {
    return locked(m_impl->path, [&] {
        const Place place = m_impl->place(group);
        const Handle opened(check(H5Gopen2(m_impl->file.id(), group.c_str(), H5P_DEFAULT), place, "is missing or no group"),
                            H5Gclose);
        std::vector<std::string> names;
        const auto add = [](hid_t, const char* name, const H5L_info_t*, void* to) -> herr_t {
            static_cast<std::vector<std::string>*>(to)->emplace_back(name);
            return 0;
        };
        hsize_t index = 0;
        check(H5Literate(opened.id(), H5_INDEX_NAME, H5_ITER_NATIVE, &index, add, &names), place, "is damaged");
        std::ranges::sort(names);
        return names;
    });
}

std::vector<std::string> File::texts(const std::string& dataset) const {
    return locked(m_impl->path, [&] {
        const Place place = m_impl->place(dataset);
        const auto opened = open_dataset(m_impl->file, dataset, place);
        const Handle space(check(H5Dget_space(opened->dataset.id()), place, "has no shape"), H5Sclose);
        return read_all_texts(opened->type, space, place, [&](hid_t type, void* target) {
            return H5Dread(opened->dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, target);
        });
    });
}

std::string File::text(const std::string& dataset) const {
    const std::vector<std::string> all = texts(dataset);
    if (all.size() != 1) {
        fail(dataset, "is not one text");
    }
    return all.front();
}

std::int64_t File::integer(const std::string& name) const {
    const Dataset found = dataset(name);
    std::vector<std::int64_t> value(found.entry_size({}));
    const std::vector<std::uint64_t>& shape = found.shape();
    if (n_entries(shape).value_or(0) != 1 || value.size() != 1) {
        fail(name, "is not one number");
    }
    found.read(std::vector<std::uint64_t>(shape.size(), 0), shape, std::span(value));
    return value.front();
}

Dataset File::dataset(const std::string& name) const {
    return Dataset(locked(m_impl->path, [&] { return open_dataset(m_impl->file, name, m_impl->place(name)); }));
}

bool File::has_attribute(const std::string& object, const std::string& name) const {
    return locked(m_impl->path, [&] {
        const Handle owner = m_impl->open_object(object);
        return H5Aexists(owner.id(), name.c_str()) > 0;
    });
}

std::vector<double> File::numbers_of_attribute(const std::string& object, const std::string& name) const {
    return locked(m_impl->path, [&] {
        const Place place = m_impl->place(object + "@" + name);
        const Handle attribute = m_impl->open_attribute(object, name);
        const Handle type(check(H5Aget_type(attribute.id()), place, "has no type"), H5Tclose);
        const Handle space(check(H5Aget_space(attribute.id()), place, "has no shape"), H5Sclose);
        if (!is_number(type.id())) {
            place.fail("does not hold numbers");
        }
        constexpr std::uint64_t most = std::uint64_t{1} << 22;
        const auto n = n_entries(extents(space, place));
        if (!n || *n > most) {
            place.fail("has more numbers than is plausible");
        }
        std::vector<double> values(*n);
        if (*n > 0) {
            check(H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, values.data()), place, "cannot be read");
        }
        return values;
    });
}

std::vector<std::string> File::texts_of_attribute(const std::string& object, const std::string& name) const {
    return locked(m_impl->path, [&] {
        const Place place = m_impl->place(object + "@" + name);
        const Handle attribute = m_impl->open_attribute(object, name);
        const Handle type(check(H5Aget_type(attribute.id()), place, "has no type"), H5Tclose);
        const Handle space(check(H5Aget_space(attribute.id()), place, "has no shape"), H5Sclose);
        return read_all_texts(type, space, place,
                              [&](hid_t in_memory, void* target) { return H5Aread(attribute.id(), in_memory, target); });
    });
}

void File::fail(const std::string& object, const std::string& what) const {
    throw api::Error(ELVIS_ERROR_FORMAT, m_impl->path, (object.empty() ? "" : object + " ") + what);
}

} // namespace elvis::hdf5
