#include "sample_files.hpp"

#include <core/base/error.hpp>
#include <core/base/output_file.hpp>
#include <core/scene/output/hdf5_attribute.hpp>

#include <algorithm>

namespace elvis::commands {

namespace {

void write_array(hid_t file, const NamedArray& array) {
    std::string name = array.name;
    std::ranges::replace(name, '/', '|');
    const std::vector<hsize_t> shape(array.shape.begin(), array.shape.end());
    const hid_t type = array.is_integer() ? H5T_NATIVE_INT64 : H5T_NATIVE_DOUBLE;
    const Hdf5Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
    const Hdf5Handle dataset(H5Dcreate2(file, name.c_str(), array.is_integer() ? H5T_STD_I64LE : H5T_IEEE_F64LE, space.id(),
                                        H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                             H5Dclose);
    if (array.n_bytes() > 0 && H5Dwrite(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.bytes()) < 0) {
        throw std::runtime_error("cannot be written");
    }
}

} // namespace

void write_hdf5(const SampleTable& table, const std::string& path) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    OutputFile output(path);
    try {
        const Hdf5Handle file(H5Fcreate(output.temporary().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
        for (const NamedArray& array : arrays_of(table)) {
            write_array(file.id(), array);
        }
    } catch (const std::runtime_error& error) {
        throw Error(path, error.what());
    }
    output.commit();
}

} // namespace elvis::commands
