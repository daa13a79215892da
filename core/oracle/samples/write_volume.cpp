#include "meshes.hpp"

namespace elvis::oracle {

void write_volume(const std::string& path, const VolumeData& data) {
    native::Description description;
    description.dimension = native::dimension(data.classes.front().geometry.shape);
    native::Field field;
    field.name = "u";
    field.n_components = data.n_components;
    field.transform = data.transform;
    description.fields.push_back(field);
    for (const ClassData& c : data.classes)
        description.classes.push_back({c.geometry, {c.field}, c.numbers.size()});
    native::Writer writer(path, description);
    for (std::size_t c = 0; c < data.classes.size(); ++c) {
        const ClassData& elements = data.classes[c];
        writer.write_geometry(c, 0, elements.numbers.size(), elements.geometry_coefficients);
        writer.write_field(0, 0, c, 0, elements.numbers.size(), elements.field_coefficients);
        writer.write_numbers(c, 0, elements.numbers.size(), elements.numbers);
    }
    writer.commit();
}

} // namespace elvis::oracle
