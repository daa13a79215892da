#include <core/base/error.hpp>
#include <core/base/output_file.hpp>
#include <core/scene/output/buffers_file.hpp>
#include <core/scene/output/hdf5_attribute.hpp>
#include <core/scene/output/pixel_flags.hpp>
#include <core/scene/scene_annotation.hpp>

#include <algorithm>
#include <vector>

namespace elvis {

namespace {

/** A dataset, but for what it holds. */
struct Dataset {
    const char* name;
    hsize_t n_channels;
    hid_t in_file;
    hid_t in_memory;
    std::string description;
    std::string unit;
};

/** Which fields the picture's surfaces show, and in which units; both in the same order. */
struct ShownFields {
    std::vector<std::string> labels;
    std::vector<std::string> units;
};

ShownFields shown_fields(const FrameRequest& request, const RuntimeVolume& volume) {
    ShownFields shown;
    for (const Surface& surface : request.surfaces) {
        const std::string label = surface.field_label.empty() ? field_label(volume, surface.field) : surface.field_label;
        const bool is_new = std::find(shown.labels.begin(), shown.labels.end(), label) == shown.labels.end();
        if (is_new && traits_of(surface.geometry).wires == nullptr) {
            shown.labels.push_back(label);
            // The unit of an expression is the user's affair.
            const std::string unit = surface.field.expression ? "" : volume.fields()[surface.field.field].unit;
            shown.units.push_back(unit.empty() ? "not given" : unit);
        }
    }
    return shown;
}

std::string joined(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) {
        text += (text.empty() ? "" : "; ") + part;
    }
    return text;
}

Hdf5Handle write_dataset(hid_t file, const Frame& frame, const Dataset& dataset, const void* data) {
    const hsize_t shape[3] = {frame.height, frame.width, dataset.n_channels};
    const Hdf5Handle space(H5Screate_simple(dataset.n_channels > 1 ? 3 : 2, shape, nullptr), H5Sclose);
    // Without the time of writing: equal pictures make equal files.
    const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(properties.id(), false);
    Hdf5Handle written(H5Dcreate2(file, dataset.name, dataset.in_file, space.id(), H5P_DEFAULT, properties.id(), H5P_DEFAULT),
                       H5Dclose);
    if (H5Dwrite(written.id(), dataset.in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) {
        throw std::runtime_error("cannot be written");
    }
    write_attribute(written.id(), "description", dataset.description);
    write_attribute(written.id(), "unit", dataset.unit);
    return written;
}

/** One attribute with a row for each bit: its number, name and meaning. */
void write_bits(hid_t flags) {
    const Hdf5Handle text = hdf5_text_type();
    const Hdf5Handle row(H5Tcreate(H5T_COMPOUND, sizeof(PixelFlag)), H5Tclose);
    H5Tinsert(row.id(), "bit", HOFFSET(PixelFlag, bit), H5T_NATIVE_UINT32);
    H5Tinsert(row.id(), "name", HOFFSET(PixelFlag, name), text.id());
    H5Tinsert(row.id(), "meaning", HOFFSET(PixelFlag, meaning), text.id());
    const hsize_t n = pixel_flags().size();
    write_attribute(flags, "bits", row.id(), Hdf5Handle(H5Screate_simple(1, &n, nullptr), H5Sclose), pixel_flags().data());
}

void write_camera(hid_t file, const Camera& camera) {
    write_attribute(file, "camera_type", camera.orthographic ? "orthographic" : "perspective");
    write_attribute(file, "camera_eye", camera.eye);
    write_attribute(file, "camera_look_at", camera.look_at);
    write_attribute(file, "camera_up", camera.up);
    if (camera.orthographic) {
        write_attribute(file, "camera_height", camera.height);
    } else {
        write_attribute(file, "camera_field_of_view", camera.field_of_view);
    }
    write_attribute(file, "camera_image_shift", camera.image_shift);
    write_attribute(file, "camera_near", camera.near);
}

void write_all(hid_t file, const Frame& frame, const FrameRequest& request, const RuntimeVolume& volume, hid_t real) {
    const hid_t number = H5T_NATIVE_DOUBLE;
    const ShownFields fields = shown_fields(request, volume);
    write_dataset(file, frame,
                  {"color", 4, real, number, "red, green, blue, opacity, before rounding to the picture's bits", "1"},
                  frame.color.data());
    const Hdf5Handle value = write_dataset(file, frame,
                                           {"value", 1, real, number,
                                            "field at the point that the pixel's centre sees of the nearest surface; NaN: none",
                                            joined(fields.units)},
                                           frame.value.data());
    write_attribute(value.id(), "field", joined(fields.labels));
    write_dataset(file, frame,
                  {"depth", 1, real, number, "distance of that point from the ray's origin; NaN: none", "length in the world"},
                  frame.depth.data());
    write_dataset(file, frame,
                  {"normal", 3, real, number, "unit normal of the surface there, towards the viewer; NaN: none", "1"},
                  frame.normal.data());
    write_dataset(file, frame,
                  {"element", 1, H5T_STD_I64LE, H5T_NATIVE_INT64, "number of the element that the value is of; -1: none", "1"},
                  frame.element.data());
    const Hdf5Handle flags = write_dataset(
        file, frame, {"flags", 1, H5T_STD_U32LE, H5T_NATIVE_UINT32, "sum of the bits that the attribute 'bits' lists", "1"},
        frame.flags.data());
    write_bits(flags.id());
    write_attribute(file, "description", "What an ElVis picture is made of, per pixel, top row first");
    write_attribute(file, "time_step", request.time_step);
    write_camera(file, request.camera);
}

} // namespace

void write_buffers(const Frame& frame, const FrameRequest& request, const RuntimeVolume& volume, const std::string& path,
                   Precision precision) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    OutputFile output(path);
    const hid_t file = H5Fcreate(output.temporary().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    if (file < 0) {
        throw Error(path, "cannot be created");
    }
    try {
        write_all(file, frame, request, volume, precision == Precision::float64 ? H5T_IEEE_F64LE : H5T_IEEE_F32LE);
    } catch (const std::runtime_error&) {
        H5Fclose(file);
        throw Error(path, "cannot be written; is the disk full?");
    }
    if (H5Fclose(file) < 0) {
        throw Error(path, "cannot be written; is the disk full?");
    }
    output.commit();
}

} // namespace elvis
