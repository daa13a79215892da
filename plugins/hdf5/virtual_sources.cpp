#include "virtual_sources.hpp"

#include "plain_driver.hpp"

#include <filesystem>

namespace elvis::hdf5 {

namespace {

using GetName = ssize_t (*)(hid_t, std::size_t, char*, std::size_t);

std::string name_of(GetName get, const Handle& list, std::size_t index, const Place& place) {
    const auto length = static_cast<std::size_t>(check(get(list.id(), index, nullptr, 0), place, "has damaged sources"));
    std::string name(length + 1, '\0');
    check(get(list.id(), index, name.data(), name.size()), place, "has damaged sources");
    name.resize(length);
    return name;
}

/** Beside the file that refers to it, else where the program runs: as HDF5 looks for it. */
std::string found(const std::string& name, const Place& place) {
    const std::string beside = (std::filesystem::path(place.file).parent_path() / name).string();
    std::error_code ignored;
    return std::filesystem::exists(beside, ignored) ? beside : name;
}

} // namespace

void check_virtual_sources(const Handle& creation_list, const Place& place) {
    std::size_t n_sources = 0;
    check(H5Pget_virtual_count(creation_list.id(), &n_sources), place, "has damaged sources");
    for (std::size_t index = 0; index < n_sources; ++index) {
        const std::string name = name_of(H5Pget_virtual_filename, creation_list, index, place);
        const std::string dataset = name_of(H5Pget_virtual_dsetname, creation_list, index, place);
        // Numbered names stand for as many files as there are.
        if (name == "." || name.find('%') != std::string::npos || dataset.find('%') != std::string::npos) {
            continue;
        }
        const Handle file = open_plainly(found(name, place));
        if (!file.is_valid()) {
            place.fail("lies in the file '" + name + "', which is missing or not readable");
        }
        const Handle source(H5Dopen2(file.id(), dataset.c_str(), H5P_DEFAULT), H5Dclose);
        if (!source.is_valid()) {
            place.fail("lies in '" + dataset + "' of the file '" + name + "', which has none of that name");
        }
    }
}

} // namespace elvis::hdf5
