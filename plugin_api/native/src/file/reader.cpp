#include "chunk_rows.hpp"
#include "description.hpp"
#include "format.hpp"
#include "hdf5.hpp"

#include <elvis/native/volume_file.hpp>

#include <algorithm>
#include <cassert>
#include <filesystem>

namespace elvis::native {

using h5::Handle;
using h5::Place;

namespace {

template <class T> T read_count(const Handle& object, const char* name, T least, T most, const Place& place) {
    const T count = h5::read_attribute<T>(object, name, place);
    if (count < least || count > most) {
        place.child(name).fail("is " + std::to_string(count) + ", outside " + std::to_string(least) + ".." +
                               std::to_string(most));
    }
    return count;
}

Basis read_basis(const Handle& object, const char* attribute, const Place& place) {
    const std::string text = h5::read_text(object, attribute, place);
    for (const Basis basis : {Basis::modified, Basis::orthogonal, Basis::gll_lagrange, Basis::gauss_lagrange, Basis::tensor}) {
        if (text == name(basis)) {
            return basis;
        }
    }
    place.child(attribute).fail("is '" + text + "', which is no basis");
}

Shape read_shape(const Handle& object, const Place& place) {
    const std::string text = h5::read_text(object, "shape", place);
    for (const Shape shape :
         {Shape::hexahedron, Shape::prism, Shape::pyramid, Shape::tetrahedron, Shape::quadrilateral, Shape::triangle}) {
        if (text == name(shape)) {
            return shape;
        }
    }
    place.child("shape").fail("is '" + text + "', which is no shape");
}

Space read_space(const Handle& object, Shape shape, const char* basis, const char* order, const Place& place) {
    Space space;
    space.shape = shape;
    space.basis = read_basis(object, basis, place);
    h5::read_attribute_raw(object, order, H5T_STD_U32LE, H5T_NATIVE_UINT32, space.order.data(), 3, place);
    try {
        check(space); // its number of modes is needed at once
    } catch (const std::invalid_argument& error) {
        place.fail(std::string("names a space that does not exist: ") + error.what());
    }
    return space;
}

} // namespace

struct Reader::Impl {
    std::string path;
    Place place;
    Description description;
    Handle file;
    std::vector<Handle> geometry;
    std::vector<Handle> numbers;
    std::vector<std::vector<Handle>> coefficients;
    /** By field; not valid where the file has none. */
    std::vector<Handle> extrema;
    Handle faces;
    /** Not valid where the file tells none. */
    Handle parts;

    ~Impl() {
        const h5::Lock guard;
        parts.reset();
        faces.reset();
        extrema.clear();
        coefficients.clear();
        numbers.clear();
        geometry.clear();
        file.reset();
    }

    void open_file();
    void read_header();
    void open_classes();
    void open_fields();
    void check_numbers();
    void open_parts();

    /** Shape of the element with a number; filled when numbers or faces are first read. */
    std::vector<Shape> shape_of_number;
};

void Reader::Impl::open_file() {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) {
        throw FileError(path, "there is no such file");
    }
    file = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (!file.is_valid()) {
        place.fail_with_stack("is not a readable HDF5 file: no native volume, or truncated, or damaged");
    }
    if (h5::read_text(file, "format", place) != format::mark) {
        place.fail("is HDF5, but not a native volume: its attribute 'format' says something else");
    }
    std::uint32_t version[2] = {};
    h5::read_attribute_raw(file, "version", H5T_STD_U32LE, H5T_NATIVE_UINT32, version, 2, place);
    if (version[0] != format::version_major) {
        place.child("version").fail("is " + std::to_string(version[0]) + "." + std::to_string(version[1]) +
                                    "; this program reads native volumes of version " + std::to_string(format::version_major));
    }
}

void Reader::Impl::read_header() {
    description.dimension = static_cast<int>(read_count<std::uint32_t>(file, "dimension", 2, 3, place));
    const hsize_t n_times = read_count<std::uint64_t>(file, "n_times", 1, most_times, place);
    const Handle times = h5::open_dataset(file, "times", H5T_IEEE_F64LE, {n_times}, place);
    description.times.resize(n_times);
    h5::read_box(times, H5T_NATIVE_DOUBLE, {0}, {n_times}, description.times.data(), place.child("times"));
    const auto n_groups = read_count<std::uint32_t>(file, "n_boundary_groups", 0, most_groups, place);
    if (n_groups > 0) {
        description.boundary_groups = h5::read_texts(file, "boundary_groups", {n_groups}, place);
    }
    const auto n_notes = read_count<std::uint32_t>(file, "n_notes", 0, most_notes, place);
    if (n_notes > 0) {
        const std::vector<std::string> texts = h5::read_texts(file, "notes", {n_notes, 2}, place);
        for (std::size_t index = 0; index < n_notes; ++index) {
            description.notes.emplace_back(texts[2 * index], texts[2 * index + 1]);
        }
    }
    description.n_faces = read_count<std::uint64_t>(file, "n_faces", 0, 6 * most_elements, place);
    if (description.n_faces > 0) {
        faces = h5::open_dataset(file, "faces", H5T_STD_I64LE, {description.n_faces, format::face_numbers}, place);
    }
}

/** Since version 1.2, and not in every file. */
void Reader::Impl::open_parts() {
    if (!h5::has_object(file, "parts", place)) {
        return;
    }
    description.n_parts = read_count<std::uint32_t>(file, "n_parts", 1, most_parts, place);
    parts = h5::open_dataset(file, "parts", H5T_STD_U32LE, {description.n_elements()}, place);
}

void Reader::Impl::open_classes() {
    const auto n_classes = read_count<std::uint32_t>(file, "n_classes", 1, most_classes, place);
    const Handle classes = h5::open_group(file, "classes", place.child("classes"));
    for (std::uint32_t index = 0; index < n_classes; ++index) {
        const Place here = place.child("classes").child(std::to_string(index));
        const Handle group = h5::open_group(classes, std::to_string(index), here);
        const Shape shape = read_shape(group, here);
        ElementClass element_class;
        element_class.geometry = read_space(group, shape, "geometry_basis", "geometry_order", here);
        element_class.n_elements = read_count<std::uint64_t>(group, "n_elements", 1, most_elements, here);
        const hsize_t modes = n_modes(element_class.geometry);
        geometry.push_back(h5::open_dataset(group, "geometry", H5T_IEEE_F64LE, {element_class.n_elements, 3, modes}, here));
        numbers.push_back(h5::open_dataset(group, "numbers", H5T_STD_I64LE, {element_class.n_elements}, here));
        description.classes.push_back(std::move(element_class));
    }
    if (h5::read_attribute<std::uint64_t>(file, "n_elements", place) != description.n_elements()) {
        place.child("n_elements").fail("is not the sum over the classes");
    }
}

void Reader::Impl::open_fields() {
    const auto n_fields = read_count<std::uint32_t>(file, "n_fields", 0, most_fields, place);
    const Handle fields = h5::open_group(file, "fields", place.child("fields"));
    for (std::uint32_t index = 0; index < n_fields; ++index) {
        const Place here = place.child("fields").child(std::to_string(index));
        const Handle group = h5::open_group(fields, std::to_string(index), here);
        Field field;
        field.name = h5::read_text(group, "name", here);
        field.unit = h5::read_text(group, "unit", here);
        field.n_components = read_count<std::uint32_t>(group, "n_components", 1, most_components, here);
        field.max_jump = h5::read_attribute<double>(group, "max_jump", here);
        const auto continuity = format::value_of(format::continuities, h5::read_text(group, "continuity", here));
        const auto transform = format::value_of(format::transforms, h5::read_text(group, "transform", here));
        if (!continuity || !transform) {
            here.fail("has an unknown continuity or transform");
        }
        field.continuity = *continuity;
        field.transform = *transform;
        coefficients.emplace_back();
        for (std::size_t class_index = 0; class_index < description.classes.size(); ++class_index) {
            ElementClass& element_class = description.classes[class_index];
            const std::string class_name = std::to_string(class_index);
            const Place part_place = here.child(class_name);
            const Handle part = h5::open_group(group, class_name, part_place);
            const Space space = read_space(part, element_class.geometry.shape, "basis", "order", part_place);
            coefficients.back().push_back(h5::open_dataset(
                part, "coefficients", H5T_IEEE_F64LE,
                {description.times.size(), element_class.n_elements, field.n_components, n_modes(space)}, part_place));
            element_class.fields.push_back(space);
        }
        extrema.emplace_back();
        if (h5::has_object(group, "extrema", here)) {
            extrema.back() =
                h5::open_dataset(group, "extrema", H5T_IEEE_F64LE,
                                 {description.times.size(), n_extrema(field.n_components), 2, format::extremum_numbers}, here);
        }
        description.fields.push_back(std::move(field));
    }
}

// Every number 0 .. n_elements-1 must belong to one element: callers use numbers as indices.
void Reader::Impl::check_numbers() {
    if (!shape_of_number.empty()) {
        return;
    }
    constexpr auto unknown = static_cast<Shape>(0xff);
    constexpr std::uint64_t rows_at_once = 65536;
    const std::uint64_t n_elements = description.n_elements();
    std::vector<Shape> shapes(n_elements, unknown);
    std::vector<std::int64_t> block;
    for (std::size_t index = 0; index < description.classes.size(); ++index) {
        const Place here = place.child("classes").child(std::to_string(index)).child("numbers");
        const ElementClass& element_class = description.classes[index];
        for (std::uint64_t first = 0; first < element_class.n_elements; first += rows_at_once) {
            block.resize(std::min(rows_at_once, element_class.n_elements - first));
            h5::read_box(numbers[index], H5T_NATIVE_INT64, {first}, {block.size()}, block.data(), here);
            for (const std::int64_t number : block) {
                if (number < 0 || static_cast<std::uint64_t>(number) >= n_elements) {
                    here.fail("holds the number " + std::to_string(number) + " in a volume of " + std::to_string(n_elements) +
                              " elements");
                }
                Shape& shape = shapes[static_cast<std::size_t>(number)];
                if (shape != unknown) {
                    here.fail("gives the number " + std::to_string(number) + " to a second element");
                }
                shape = element_class.geometry.shape;
            }
        }
    }
    shape_of_number = std::move(shapes);
}

Reader::Reader(const std::string& path) : m_impl(std::make_unique<Impl>()) {
    m_impl->path = path;
    m_impl->place = {path, {}};
    const h5::Lock guard;
    try {
        m_impl->open_file();
        m_impl->read_header();
        m_impl->open_classes();
        m_impl->open_parts();
        m_impl->open_fields();
        const std::string problem = problem_of(m_impl->description);
        if (!problem.empty()) {
            m_impl->place.fail("is inconsistent: " + problem);
        }
    } catch (const std::bad_alloc&) {
        throw FileError(path, "asks for more memory than there is");
    }
}

Reader::~Reader() = default;
Reader::Reader(Reader&&) noexcept = default;
Reader& Reader::operator=(Reader&&) noexcept = default;

int Reader::probe(const std::string& path) noexcept {
    try {
        const h5::Lock guard;
        if (H5Fis_hdf5(path.c_str()) <= 0) {
            return 0;
        }
        const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
        return file.is_valid() && h5::read_text(file, "format", {path, {}}) == format::mark ? 100 : 0;
    } catch (...) {
        return 0;
    }
}

const Description& Reader::description() const { return m_impl->description; }

void Reader::read_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                           std::span<double> coefficients) const {
    const std::size_t modes = n_modes(m_impl->description.classes.at(element_class).geometry);
    assert(coefficients.size() == count * 3 * modes);
    if (h5::read_chunk_rows(m_impl->geometry[element_class], {first, 0, 0}, count, 0, coefficients.data())) {
        return;
    }
    const h5::Lock guard;
    h5::read_box(m_impl->geometry[element_class], H5T_NATIVE_DOUBLE, {first, 0, 0}, {count, 3, modes}, coefficients.data(),
                 m_impl->place.child("classes").child(std::to_string(element_class)).child("geometry"));
}

void Reader::read_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                        std::uint64_t count, std::span<double> coefficients) const {
    const std::size_t modes = n_modes(m_impl->description.classes.at(element_class).fields.at(field));
    const std::uint32_t n_components = m_impl->description.fields[field].n_components;
    assert(coefficients.size() == count * n_components * modes);
    if (h5::read_chunk_rows(m_impl->coefficients[field][element_class], {time_step, first, 0, 0}, count, 1,
                            coefficients.data())) {
        return;
    }
    const h5::Lock guard;
    h5::read_box(
        m_impl->coefficients[field][element_class], H5T_NATIVE_DOUBLE, {time_step, first, 0, 0},
        {1, count, n_components, modes}, coefficients.data(),
        m_impl->place.child("fields").child(std::to_string(field)).child(std::to_string(element_class)).child("coefficients"));
}

void Reader::read_numbers(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                          std::span<std::int64_t> numbers) const {
    assert(numbers.size() == count);
    const Place place = m_impl->place.child("classes").child(std::to_string(element_class)).child("numbers");
    const h5::Lock guard;
    m_impl->check_numbers();
    h5::read_box(m_impl->numbers.at(element_class), H5T_NATIVE_INT64, {first}, {count}, numbers.data(), place);
}

void Reader::read_parts(std::uint64_t first, std::span<std::uint32_t> parts) const {
    const Place place = m_impl->place.child("parts");
    {
        const h5::Lock guard;
        h5::read_box(m_impl->parts, H5T_NATIVE_UINT32, {first}, {parts.size()}, parts.data(), place);
    }
    for (std::size_t index = 0; index < parts.size(); ++index) {
        if (parts[index] >= m_impl->description.n_parts) {
            place.fail("names part " + std::to_string(parts[index]) + " of " + std::to_string(m_impl->description.n_parts) +
                       ", in row " + std::to_string(first + index));
        }
    }
}

void Reader::read_faces(std::uint64_t first, std::uint64_t count, std::span<Face> faces) const {
    assert(faces.size() == count);
    if (count == 0) {
        return;
    }
    const Place place = m_impl->place.child("faces");
    std::vector<std::int64_t> rows(count * format::face_numbers);
    const bool is_read = h5::read_chunk_rows(m_impl->faces, {first, 0}, count, 0, rows.data());
    const h5::Lock guard;
    if (!is_read) {
        h5::read_box(m_impl->faces, H5T_NATIVE_INT64, {first, 0}, {count, format::face_numbers}, rows.data(), place);
    }
    m_impl->check_numbers();
    const std::vector<Shape>& shapes = m_impl->shape_of_number;
    const std::size_t n_groups = m_impl->description.boundary_groups.size();
    for (std::uint64_t index = 0; index < count; ++index) {
        const std::int64_t* row = &rows[index * format::face_numbers];
        const auto narrow = [&](std::int64_t value) {
            const auto result = static_cast<std::int32_t>(value);
            if (result != value) {
                place.fail("has numbers out of range in row " + std::to_string(first + index));
            }
            return result;
        };
        Face& face = faces[index];
        face = {row[0], row[1], narrow(row[2]), narrow(row[3]), narrow(row[4])};
        std::string problem = problem_of(face, shapes.size(), n_groups);
        const auto has_face = [&](std::int64_t element, std::int32_t local_face) {
            return local_face < n_faces(shapes[static_cast<std::size_t>(element)]);
        };
        if (problem.empty() && !(has_face(face.element, face.local_face) &&
                                 (face.neighbour < 0 || has_face(face.neighbour, face.neighbour_local_face)))) {
            problem = "names a local face that its element's shape does not have";
        }
        if (!problem.empty()) {
            place.fail(problem + ", in row " + std::to_string(first + index));
        }
    }
}

std::vector<Extrema> Reader::read_extrema(std::size_t field, std::size_t time_step) const {
    const Handle& dataset = m_impl->extrema.at(field);
    if (!dataset.is_valid()) {
        return {};
    }
    const Place place = m_impl->place.child("fields").child(std::to_string(field)).child("extrema");
    const Description& description = m_impl->description;
    const std::size_t n = n_extrema(description.fields[field].n_components);
    std::vector<double> numbers(n * 2 * format::extremum_numbers);
    const h5::Lock guard;
    h5::read_box(dataset, H5T_NATIVE_DOUBLE, {time_step, 0, 0, 0}, {1, n, 2, format::extremum_numbers}, numbers.data(), place);
    std::vector<Extrema> result(n);
    for (std::size_t at = 0; at < 2 * n; ++at) {
        const double* row = &numbers[at * format::extremum_numbers];
        const auto is_below = [](double index, std::uint64_t end) { return index >= 0 && index < static_cast<double>(end); };
        if (!is_below(row[2], description.classes.size()) ||
            !is_below(row[3], description.classes[static_cast<std::size_t>(row[2])].n_elements)) {
            place.fail("names an element that is not there");
        }
        Extremum& extremum = at % 2 == 0 ? result[at / 2].minimum : result[at / 2].maximum;
        extremum = {
            row[0], row[1], static_cast<std::uint64_t>(row[2]), static_cast<std::uint64_t>(row[3]), {row[4], row[5], row[6]}};
    }
    return result;
}

} // namespace elvis::native
