#include "object.hpp"

#include "virtual_sources.hpp"

#include <algorithm>
#include <cstring>

namespace elvis::hdf5 {

namespace {

/** More bytes of text than a file of any of these programs has. */
constexpr std::uint64_t most_text = std::uint64_t{1} << 26;

std::vector<std::string> read_texts_of_fixed_length(const Handle& type, std::uint64_t count, const Place& place,
                                                    const std::function<herr_t(hid_t, void*)>& read) {
    const std::size_t length = H5Tget_size(type.id());
    if (length == 0 || length > most_text / count) {
        place.fail("has more text than is plausible");
    }
    std::vector<char> all(length * count);
    check(read(type.id(), all.data()), place, "cannot be read");
    std::vector<std::string> texts;
    for (std::uint64_t index = 0; index < count; ++index) {
        texts.push_back(trimmed(std::string(&all[index * length], length)));
    }
    return texts;
}

std::vector<std::string> read_texts_of_variable_length(const Handle& type, const Handle& space, std::uint64_t count,
                                                       const Place& place, const std::function<herr_t(hid_t, void*)>& read) {
    std::vector<char*> all(count, nullptr);
    const Handle in_memory(check(H5Tcopy(type.id()), place, "no memory for a type"), H5Tclose);
    check(read(in_memory.id(), all.data()), place, "cannot be read");
    std::vector<std::string> texts;
    for (const char* const text : all) {
        texts.push_back(trimmed(text ? text : ""));
    }
    H5Dvlen_reclaim(in_memory.id(), space.id(), H5P_DEFAULT, all.data());
    return texts;
}

/** Bytes on disk must do for the numbers: a damaged extent must not become an allocation. */
void check_storage(const Dataset::Impl& opened, const Handle& file) {
    const std::optional<std::uint64_t> n = n_entries(opened.shape);
    const std::uint64_t size = H5Tget_size(opened.type.id());
    if (!n || size == 0 || *n > (std::uint64_t{1} << 60) / size) {
        opened.place.fail("has an impossible size");
    }
    const Handle list(check(H5Dget_create_plist(opened.dataset.id()), opened.place, "is damaged"), H5Pclose);
    const H5D_layout_t layout = check(H5Pget_layout(list.id()), opened.place, "is damaged");
    if (layout == H5D_VIRTUAL) {
        check_virtual_sources(list, opened.place);
    }
    if (*n == 0 || layout == H5D_VIRTUAL) {
        return;
    }
    if (layout == H5D_COMPACT) {
        // HDF5 1.10 reads beyond what it holds.
        if (H5Dget_storage_size(opened.dataset.id()) < *n * size) {
            opened.place.fail("holds less than its extent: it is damaged");
        }
        return;
    }
    hsize_t in_file = 0;
    check(H5Fget_filesize(file.id(), &in_file), opened.place, "is in a file of unknown size");
    const std::uint64_t stored = H5Dget_storage_size(opened.dataset.id());
    if (stored == 0) {
        opened.place.fail("was never written");
    }
    // Deflate makes a byte of at most 1032.
    const bool is_short = layout == H5D_CONTIGUOUS ? *n * size > in_file : *n * size / 1032 > in_file;
    if (is_short) {
        opened.place.fail("has " + std::to_string(*n) + " entries of " + std::to_string(size) +
                          " bytes, more than the file can hold: it is truncated or damaged");
    }
}

} // namespace

std::vector<std::uint64_t> extents(const Handle& space, const Place& place) {
    const int rank = check(H5Sget_simple_extent_ndims(space.id()), place, "has no shape");
    std::vector<hsize_t> found(static_cast<std::size_t>(rank));
    if (rank > 0) {
        check(H5Sget_simple_extent_dims(space.id(), found.data(), nullptr), place, "has no shape");
    }
    return {found.begin(), found.end()};
}

std::optional<std::uint64_t> n_entries(const std::vector<std::uint64_t>& shape) {
    std::uint64_t n = 1;
    for (const std::uint64_t extent : shape) {
        if (extent == 0) {
            return 0;
        }
        if (n > (std::uint64_t{1} << 60) / extent) {
            return std::nullopt;
        }
        n *= extent;
    }
    return n;
}

bool is_number(hid_t type) {
    const hid_t numbers[] = {H5T_STD_I8LE,  H5T_STD_I16LE, H5T_STD_I32LE, H5T_STD_I64LE,  H5T_STD_U8LE,
                             H5T_STD_U16LE, H5T_STD_U32LE, H5T_STD_U64LE, H5T_IEEE_F32LE, H5T_IEEE_F64LE,
                             H5T_STD_I8BE,  H5T_STD_I16BE, H5T_STD_I32BE, H5T_STD_I64BE,  H5T_STD_U8BE,
                             H5T_STD_U16BE, H5T_STD_U32BE, H5T_STD_U64BE, H5T_IEEE_F32BE, H5T_IEEE_F64BE};
    return std::ranges::any_of(numbers, [&](hid_t number) { return H5Tequal(type, number) > 0; });
}

std::string trimmed(std::string text) {
    text.resize(std::strlen(text.c_str()));
    text.erase(text.find_last_not_of(" \n\t\r") + 1);
    return text;
}

std::vector<std::string> read_all_texts(const Handle& type, const Handle& space, const Place& place,
                                        const std::function<herr_t(hid_t type, void* target)>& read) {
    if (H5Tget_class(type.id()) != H5T_STRING) {
        place.fail("is not text");
    }
    const std::optional<std::uint64_t> count = n_entries(extents(space, place));
    if (!count || *count > most_text) {
        place.fail("has more texts than is plausible");
    }
    if (*count == 0) {
        return {};
    }
    return H5Tis_variable_str(type.id()) > 0 ? read_texts_of_variable_length(type, space, *count, place, read)
                                             : read_texts_of_fixed_length(type, *count, place, read);
}

std::unique_ptr<Dataset::Impl> open_dataset(const Handle& file, const std::string& name, const Place& place) {
    Handle dataset(H5Dopen2(file.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!dataset.is_valid()) {
        place.fail_with_stack("is missing, damaged or no dataset");
    }
    Handle type(check(H5Dget_type(dataset.id()), place, "has no type"), H5Tclose);
    const Handle space(check(H5Dget_space(dataset.id()), place, "has no shape"), H5Sclose);
    std::vector<std::uint64_t> shape = extents(space, place);
    auto opened = std::make_unique<Dataset::Impl>(place, std::move(dataset), std::move(type), std::move(shape));
    check_storage(*opened, file);
    return opened;
}

} // namespace elvis::hdf5
