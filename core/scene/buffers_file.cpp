#include <core/base/error.hpp>
#include <core/scene/buffers_file.hpp>
#include <core/scene/output_file.hpp>

#include <hdf5.h>

namespace elvis {

namespace {

void write_dataset(hid_t file, const char* name, const Frame& frame, hsize_t n_channels, hid_t in_file, hid_t in_memory,
                   const void* data, const std::string& path) {
    const hsize_t shape[3] = {frame.height, frame.width, n_channels};
    const hid_t space = H5Screate_simple(n_channels > 1 ? 3 : 2, shape, nullptr);
    const hid_t dataset = H5Dcreate2(file, name, in_file, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const bool is_written = dataset >= 0 && H5Dwrite(dataset, in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0;
    H5Dclose(dataset);
    H5Sclose(space);
    if (!is_written) {
        H5Fclose(file);
        throw Error(path, std::string("the buffer '") + name + "' cannot be written");
    }
}

} // namespace

void write_buffers(const Frame& frame, const std::string& path, bool double_precision) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    OutputFile output(path);
    const hid_t file = H5Fcreate(output.temporary().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    if (file < 0) {
        throw Error(path, "cannot be created");
    }
    const hid_t real = double_precision ? H5T_IEEE_F64LE : H5T_IEEE_F32LE;
    write_dataset(file, "color", frame, 4, real, H5T_NATIVE_DOUBLE, frame.color.data(), path);
    write_dataset(file, "value", frame, 1, real, H5T_NATIVE_DOUBLE, frame.value.data(), path);
    write_dataset(file, "depth", frame, 1, real, H5T_NATIVE_DOUBLE, frame.depth.data(), path);
    write_dataset(file, "normal", frame, 3, real, H5T_NATIVE_DOUBLE, frame.normal.data(), path);
    write_dataset(file, "element", frame, 1, H5T_STD_I64LE, H5T_NATIVE_INT64, frame.element.data(), path);
    write_dataset(file, "flags", frame, 1, H5T_STD_U32LE, H5T_NATIVE_UINT32, frame.flags.data(), path);
    if (H5Fclose(file) < 0) {
        throw Error(path, "cannot be written; is the disk full?");
    }
    output.commit();
}

} // namespace elvis
