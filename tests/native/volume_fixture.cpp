#include "volume_fixture.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

namespace elvis::native {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::vector<double> random_numbers(std::mt19937& random, std::size_t count) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<double> result(count);
    for (double& value : result)
        value = uniform(random);
    return result;
}

// Fills everything that follows from the description.
VolumeData with_content(Description description, unsigned seed) {
    std::mt19937 random(seed);
    VolumeData data;
    std::vector<std::int64_t> numbers(description.n_elements());
    std::iota(numbers.begin(), numbers.end(), 0);
    std::shuffle(numbers.begin(), numbers.end(), random);
    std::vector<Shape> shapes(numbers.size());
    auto next = numbers.begin();
    for (const ElementClass& element_class : description.classes) {
        const auto end = next + static_cast<std::ptrdiff_t>(element_class.n_elements);
        for (auto number = next; number != end; ++number)
            shapes[static_cast<std::size_t>(*number)] = element_class.geometry.shape;
        data.numbers.emplace_back(next, end);
        data.geometry.push_back(random_numbers(random, element_class.n_elements * 3 * n_modes(element_class.geometry)));
        next = end;
    }
    for (std::size_t field = 0; field < description.fields.size(); ++field) {
        auto& steps = data.fields.emplace_back(description.times.size());
        for (auto& step : steps)
            for (const ElementClass& element_class : description.classes)
                step.push_back(random_numbers(random, element_class.n_elements * description.fields[field].n_components *
                                                          n_modes(element_class.fields[field])));
    }
    const auto any = [&](std::int64_t end) { return std::uniform_int_distribution<std::int64_t>(0, end - 1)(random); };
    const auto any_face = [&](std::int64_t element) {
        return static_cast<std::int32_t>(any(n_faces(shapes[static_cast<std::size_t>(element)])));
    };
    const auto n_elements = static_cast<std::int64_t>(numbers.size());
    for (std::uint64_t i = 0; i < description.n_faces; ++i) {
        Face face;
        face.element = any(n_elements);
        face.local_face = any_face(face.element);
        face.neighbour = any(n_elements + 2) - 2;
        if (face.neighbour >= 0)
            face.neighbour_local_face = any_face(face.neighbour);
        else
            face.group = static_cast<std::int32_t>(any(static_cast<std::int64_t>(description.boundary_groups.size()) + 1)) - 1;
        data.faces.push_back(face);
    }
    data.description = std::move(description);
    return data;
}

bool same_bits(const void* a, const void* b, std::size_t size) { return size == 0 || std::memcmp(a, b, size) == 0; }

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && same_bits(a.data(), b.data(), a.size() * sizeof(double));
}

bool identical(const Field& a, const Field& b) {
    return a.name == b.name && a.unit == b.unit && a.n_components == b.n_components && a.continuity == b.continuity &&
           a.transform == b.transform && same_bits(&a.max_jump, &b.max_jump, sizeof(double));
}

bool identical(const ElementClass& a, const ElementClass& b) {
    return a.geometry == b.geometry && a.fields == b.fields && a.n_elements == b.n_elements;
}

bool identical(const Face& a, const Face& b) {
    return a.element == b.element && a.neighbour == b.neighbour && a.local_face == b.local_face &&
           a.neighbour_local_face == b.neighbour_local_face && a.group == b.group;
}

template <class T> bool all_identical(const std::vector<T>& a, const std::vector<T>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const T& x, const T& y) { return identical(x, y); });
}

bool identical(const Description& a, const Description& b) {
    return a.dimension == b.dimension && all_identical(a.classes, b.classes) && all_identical(a.fields, b.fields) &&
           same_bits(a.times, b.times) && a.boundary_groups == b.boundary_groups && a.n_faces == b.n_faces &&
           a.notes == b.notes;
}

} // namespace

bool identical(const VolumeData& a, const VolumeData& b) {
    if (!identical(a.description, b.description) || !all_identical(a.faces, b.faces) || a.numbers != b.numbers)
        return false;
    for (std::size_t i = 0; i < a.geometry.size(); ++i)
        if (!same_bits(a.geometry[i], b.geometry[i]))
            return false;
    for (std::size_t field = 0; field < a.fields.size(); ++field)
        for (std::size_t step = 0; step < a.fields[field].size(); ++step)
            for (std::size_t i = 0; i < a.fields[field][step].size(); ++i)
                if (!same_bits(a.fields[field][step][i], b.fields[field][step][i]))
                    return false;
    return true;
}

VolumeData large_volume() {
    Description d;
    d.fields = {{"p", "Pa", 1, Continuity::continuous, Transform::none, 1e-15},
                {"velocity – mean", "m/s", 3, Continuity::discontinuous, Transform::contravariant, 0.25},
                {"material", "", 1, Continuity::discontinuous, Transform::none, not_a_number}};
    d.times = {0.0, 0.1};
    d.boundary_groups = {"inflow", "wall", ""};
    d.n_faces = 5000;
    d.notes = {{"source file", "mesh.xml"}, {"converter", "org.example"}, {"empty", ""}};
    const auto add = [&](Shape shape, Space p, Space u, std::array<std::uint32_t, 3> geometry, std::uint64_t n) {
        p.shape = u.shape = shape;
        d.classes.push_back({{shape, Basis::modified, geometry}, {p, u, {shape, Basis::orthogonal, {0, 0, 0}}}, n});
    };
    const Shape any = Shape::hexahedron;
    add(Shape::hexahedron, {any, Basis::gll_lagrange, {4, 3, 2}}, {any, Basis::modified, {2, 2, 2}}, {1, 1, 1}, 700);
    add(Shape::prism, {any, Basis::modified, {3, 3, 3}}, {any, Basis::orthogonal, {2, 1, 3}}, {2, 2, 2}, 150);
    add(Shape::pyramid, {any, Basis::tensor, {2, 3, 2}}, {any, Basis::modified, {2, 2, 2}}, {1, 1, 1}, 7);
    add(Shape::tetrahedron, {any, Basis::modified, {8, 8, 8}}, {any, Basis::modified, {2, 3, 4}}, {3, 3, 3}, 900);
    add(Shape::tetrahedron, {any, Basis::orthogonal, {1, 1, 1}}, {any, Basis::orthogonal, {1, 1, 1}}, {1, 1, 1}, 1);
    VolumeData data = with_content(d, 1);
    data.fields[0][1][3][5] = not_a_number;
    data.fields[0][1][3][6] = std::numeric_limits<double>::infinity();
    data.fields[1][0][0][7] = -0.0;
    return data;
}

VolumeData small_volume() {
    Description d;
    d.fields = {{"p", "Pa", 1, Continuity::continuous, Transform::none, 1e-15}};
    d.times = {0.0, 0.5};
    d.boundary_groups = {"wall"};
    d.n_faces = 6;
    d.notes = {{"source file", "small.xml"}};
    for (const Shape shape : {Shape::hexahedron, Shape::tetrahedron})
        d.classes.push_back({{shape, Basis::modified, {1, 1, 1}}, {{shape, Basis::modified, {2, 2, 2}}}, 2});
    return with_content(d, 2);
}

void write_blocks(Writer& writer, const VolumeData& data) {
    const Description& d = data.description;
    for (std::size_t i = 0; i < d.classes.size(); ++i) {
        const std::uint64_t n = d.classes[i].n_elements;
        writer.write_geometry(i, 0, n, data.geometry[i]);
        writer.write_numbers(i, 0, n, data.numbers[i]);
        for (std::size_t field = 0; field < d.fields.size(); ++field)
            for (std::size_t step = 0; step < d.times.size(); ++step)
                writer.write_field(field, step, i, 0, n, data.fields[field][step][i]);
    }
    writer.write_faces(0, d.n_faces, data.faces);
}

void write(const std::string& path, const VolumeData& data, std::span<const std::uint32_t> parts) {
    Writer writer(path, data.description);
    write_blocks(writer, data);
    if (!parts.empty()) {
        writer.write_parts(parts);
    }
    writer.commit();
}

VolumeData read_all(const std::string& path) {
    const Reader reader(path);
    VolumeData data;
    data.description = reader.description();
    const Description& d = data.description;
    data.fields.resize(d.fields.size());
    for (auto& steps : data.fields)
        steps.resize(d.times.size());
    for (std::size_t i = 0; i < d.classes.size(); ++i) {
        const std::uint64_t n = d.classes[i].n_elements;
        reader.read_geometry(i, 0, n, data.geometry.emplace_back(n * 3 * n_modes(d.classes[i].geometry)));
        reader.read_numbers(i, 0, n, data.numbers.emplace_back(n));
        for (std::size_t field = 0; field < d.fields.size(); ++field)
            for (std::size_t step = 0; step < d.times.size(); ++step)
                reader.read_field(field, step, i, 0, n,
                                  data.fields[field][step].emplace_back(n * d.fields[field].n_components *
                                                                        n_modes(d.classes[i].fields[field])));
    }
    data.faces.resize(d.n_faces);
    reader.read_faces(0, d.n_faces, data.faces);
    return data;
}

std::vector<char> read_bytes(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void write_bytes(const std::string& path, const std::vector<char>& bytes) {
    std::ofstream stream(path, std::ios::binary | std::ios::trunc);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

} // namespace elvis::native
