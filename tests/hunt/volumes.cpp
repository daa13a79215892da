#include "volumes.hpp"

#include <core/base/temporary_folder.hpp>
#include <core/convert/convert.hpp>
#include <core/oracle/samples/meshes.hpp>
#include <core/oracle/samples/random_volumes.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

namespace elvis::hunt {
namespace {

using oracle::Random;
using oracle::Vector;
using oracle::VolumeData;

std::string generator_text(Random& random) {
    static const char* const meshes[] = {"box", "waves", "ball", "hemisphere", "shell", "torus"};
    static const char* const shapes[] = {"hexahedron", "prism", "tetrahedron", "pyramid", "mixed"};
    static const char* const fields[] = {"sphere", "polynomial", "jump", "element", "sinc", "waves", "distance"};
    nlohmann::json json{{"generator", 1}};
    const int mesh = random.whole(0, 5), shape = random.whole(0, 4), field = random.whole(0, 6);
    json["mesh"] = meshes[mesh];
    json["shape"] = shapes[shape];
    // The mixed box has slabs of each shape.
    const int least = shape == 4 && mesh < 2 ? 4 : mesh == 5 ? 3 : 1;
    json["elements"] = {random.whole(least, std::max(least, 3)), random.whole(1, 3), random.whole(mesh == 5 ? 4 : 1, 4)};
    if (mesh >= 2)
        json["layers"] = 2;
    json["geometry_order"] = mesh == 0 ? 1 : random.whole(2, 4);
    json["order"] = field == 3 ? 0 : random.whole(1, 6);
    json["field"] = fields[field];
    return json.dump();
}

void convert_file(const PluginRegistry& plugins, const std::string& input, const std::string& output) {
    const SourceVolume source(plugins.converter_for(input), {input});
    convert(source, output, {}, {});
}

/** Coefficients of x + shift, or of factor x. */
void move(VolumeData& data, double factor, const Vector& shift) {
    for (oracle::ClassData& elements : data.classes) {
        const std::size_t n = native::n_modes(elements.geometry);
        const std::vector<double> one = oracle::Fit(elements.geometry)([](const Vector&) { return 1.0; });
        for (std::size_t i = 0; i < elements.geometry_coefficients.size(); ++i) {
            const auto direction = static_cast<Eigen::Index>(i / n % 3);
            elements.geometry_coefficients[i] = factor * elements.geometry_coefficients[i] + shift[direction] * one[i % n];
        }
    }
}

/** Faces by their corners, which neighbours share. Those without a partner are on the boundary, or `alone`. */
std::vector<native::Face> faces_of(const VolumeData& data, std::int64_t alone) {
    const oracle::Volume volume(data);
    const double size = (volume.position(0, {-1, -1, -1}) - volume.position(0, {1, -1, -1})).norm();
    std::map<std::vector<std::array<std::int64_t, 3>>, std::size_t> known;
    std::vector<native::Face> faces;
    for (std::size_t element = 0; element < volume.n_elements(); ++element) {
        const native::Shape shape = volume.shape(element);
        for (int local = 0; local < native::n_faces(shape); ++local) {
            std::vector<std::array<std::int64_t, 3>> corners;
            for (const int corner : native::face_corners(shape, local)) {
                const native::Point xi = native::corner(shape, corner);
                const Vector x = volume.position(element, {xi[0], xi[1], xi[2]}) / (1e-7 * size);
                corners.push_back({std::llround(x[0]), std::llround(x[1]), std::llround(x[2])});
            }
            std::ranges::sort(corners);
            const auto [place, is_new] = known.try_emplace(corners, faces.size());
            if (is_new) {
                faces.push_back({volume.number(element), alone, local, -1, -1});
            } else {
                faces[place->second].neighbour = volume.number(element);
                faces[place->second].neighbour_local_face = local;
            }
        }
    }
    return faces;
}

std::string random_volume(Random& random, std::uint64_t number, const std::string& path) {
    oracle::RandomVolume made = oracle::random_volume(number);
    std::string description = made.description.substr(0, made.description.find(", ", made.description.find("field of")));
    if (random.one_in(6)) {
        move(made.data, 1e-6, Vector::Zero());
        description += ", scaled by 1e-6";
    } else if (random.one_in(6)) {
        move(made.data, 1, {1e4, -1e4, 1e4});
        description += ", shifted by 1e4";
    }
    // Without neighbours, elements are found by their places. Faces of different shapes need not match.
    if (random.one_in(3)) {
        oracle::write_volume(path, made.data);
        return description + ", without faces";
    }
    write_volume(path, made.data, faces_of(made.data, made.data.classes.size() > 1 ? -2 : -1));
    return description;
}

} // namespace

void write_volume(const std::string& path, const VolumeData& data, const std::vector<native::Face>& faces) {
    native::Description description;
    native::Field field;
    field.name = "u";
    description.fields.push_back(field);
    description.n_faces = faces.size();
    for (const oracle::ClassData& c : data.classes)
        description.classes.push_back({c.geometry, {c.field}, c.numbers.size()});
    native::Writer writer(path, description);
    for (std::size_t c = 0; c < data.classes.size(); ++c) {
        const oracle::ClassData& elements = data.classes[c];
        writer.write_geometry(c, 0, elements.numbers.size(), elements.geometry_coefficients);
        writer.write_field(0, 0, c, 0, elements.numbers.size(), elements.field_coefficients);
        writer.write_numbers(c, 0, elements.numbers.size(), elements.numbers);
    }
    writer.write_faces(0, faces.size(), faces);
    writer.commit();
}

std::string make_volume(const PluginRegistry& plugins, std::uint64_t number, const std::vector<std::string>& files,
                        const std::string& path) {
    Random random(number * 0x9E3779B97F4A7C15ull + 17);
    if (!files.empty() && random.one_in(4)) {
        const std::string& file = files[static_cast<std::size_t>(random.whole(0, static_cast<int>(files.size()) - 1))];
        if (native::Reader::probe(file) > 0)
            std::filesystem::copy_file(file, path, std::filesystem::copy_options::overwrite_existing);
        else
            convert_file(plugins, file, path);
        return std::filesystem::path(file).filename().string();
    }
    if (random.one_in(3)) {
        const TemporaryFile input("description.json");
        const std::string text = generator_text(random);
        std::ofstream(input.path()) << text;
        convert_file(plugins, input.path(), path);
        return text;
    }
    return random_volume(random, number, path);
}

} // namespace elvis::hunt
