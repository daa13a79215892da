#include "volume.hpp"

namespace elvis::oracle {

VolumeData read_volume(const std::string& path, std::size_t field, std::size_t time_step) {
    const native::Reader reader(path);
    const native::Description& description = reader.description();
    VolumeData data;
    data.n_components = description.fields.at(field).n_components;
    data.transform = description.fields.at(field).transform;
    for (std::size_t c = 0; c < description.classes.size(); ++c) {
        const native::ElementClass& source = description.classes[c];
        const std::size_t n = source.n_elements;
        ClassData target;
        target.geometry = source.geometry;
        target.field = source.fields.at(field);
        target.geometry_coefficients.resize(n * 3 * native::n_modes(target.geometry));
        target.field_coefficients.resize(n * data.n_components * native::n_modes(target.field));
        target.numbers.resize(n);
        reader.read_geometry(c, 0, n, target.geometry_coefficients);
        reader.read_field(field, time_step, c, 0, n, target.field_coefficients);
        reader.read_numbers(c, 0, n, target.numbers);
        data.classes.push_back(std::move(target));
    }
    return data;
}

} // namespace elvis::oracle
