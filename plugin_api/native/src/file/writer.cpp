#include "chunk_rows.hpp"
#include "coverage.hpp"
#include "description.hpp"
#include "format.hpp"
#include "hdf5.hpp"

#include <elvis/native/extrema.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>

namespace elvis::native {

using h5::check;
using h5::Handle;
using h5::Place;

FileError::FileError(std::string file, const std::string& what)
    : std::runtime_error(file + ": " + what), m_file(std::move(file)) {}

namespace {

/** A name beside the target that no other writer has: this process's number, and a random one against leftovers of others. */
std::string temporary_name(const std::string& path) {
    std::random_device random;
    return path + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(random());
}

void write_space(const Handle& object, const Space& space, const char* basis_name, const char* order_name, const Place& place) {
    h5::write_text(object, basis_name, std::string(name(space.basis)), place);
    h5::write_attribute_raw(object, order_name, H5T_STD_U32LE, H5T_NATIVE_UINT32, space.order.data(), 3, place);
}

/** Waits until a file, or a folder's list of names, is on the disk. */
bool synchronize(const std::string& path, int flags) {
    const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC);
    if (descriptor < 0) {
        return false;
    }
    const bool is_done = ::fsync(descriptor) == 0;
    ::close(descriptor);
    return is_done;
}

} // namespace

struct Writer::Impl {
    std::string path;
    std::string temporary;
    Description description;
    Place place;
    Handle file;
    std::vector<Handle> field_groups;
    std::vector<Handle> geometry;
    std::vector<Handle> numbers;
    /** By field, then class. */
    std::vector<std::vector<Handle>> coefficients;
    Handle faces;
    Handle parts;
    /** Of each dataset of rows. */
    std::vector<h5::OpenChunk> open_geometry;
    std::vector<std::vector<h5::OpenChunk>> open_coefficients;
    h5::OpenChunk open_faces;
    std::vector<Coverage> written_geometry;
    std::vector<Coverage> written_numbers;
    /** By field, class and time step. */
    std::vector<std::vector<std::vector<Coverage>>> written_coefficients;
    Coverage written_faces;
    bool has_written_parts = false;
    /** By field and time step; none for fields with a transform. */
    std::vector<std::vector<ExtremaSearch>> searches;
    /** Element numbers that have been given out. */
    std::vector<bool> number_is_used;
    /** Whether the temporary file is there and ours to remove. */
    bool is_temporary_there = false;

    ~Impl() {
        const h5::Lock guard;
        close();
        if (is_temporary_there) {
            std::remove(temporary.c_str());
        }
    }

    void close() {
        parts.reset();
        faces.reset();
        coefficients.clear();
        numbers.clear();
        geometry.clear();
        field_groups.clear();
        file.reset();
    }

    void create_file();
    void create_classes();
    void create_fields();
    std::vector<Space> spaces_of(std::size_t field) const;
    void check_complete() const;
    void write_open_chunks();
    void reopen_coefficients(std::size_t field);
    void write_extrema(std::size_t field);
};

void Writer::Impl::create_file() {
    const Handle access(check(H5Pcreate(H5P_FILE_ACCESS), place, "no memory"), H5Pclose);
    // From 1.10 on, every structure of the file carries a checksum.
    check(H5Pset_libver_bounds(access.id(), H5F_LIBVER_V110, H5F_LIBVER_V110), place, "cannot be of this format version");
    file = Handle(H5Fcreate(temporary.c_str(), H5F_ACC_EXCL, H5P_DEFAULT, access.id()), H5Fclose);
    if (!file.is_valid()) {
        place.fail_with_stack("cannot be created: is its folder there and writable?");
    }
    is_temporary_there = true;
    h5::write_text(file, "format", format::mark, place);
    const std::uint32_t version[2] = {format::version_major, format::version_minor};
    h5::write_attribute_raw(file, "version", H5T_STD_U32LE, H5T_NATIVE_UINT32, version, 2, place);
    h5::write_attribute(file, "dimension", static_cast<std::uint32_t>(description.dimension), place);
    h5::write_attribute(file, "n_elements", description.n_elements(), place);
    h5::write_attribute(file, "n_classes", static_cast<std::uint32_t>(description.classes.size()), place);
    h5::write_attribute(file, "n_fields", static_cast<std::uint32_t>(description.fields.size()), place);
    h5::write_attribute(file, "n_times", static_cast<std::uint64_t>(description.times.size()), place);
    h5::write_attribute(file, "n_faces", description.n_faces, place);
    h5::write_attribute(file, "n_boundary_groups", static_cast<std::uint32_t>(description.boundary_groups.size()), place);

    const std::vector<hsize_t> shape = {description.times.size()};
    const Handle times = h5::create_dataset(file, "times", H5T_IEEE_F64LE, shape, 0, sizeof(double), place);
    h5::write_box(times, H5T_NATIVE_DOUBLE, {0}, shape, description.times.data(), place.child("times"));
    if (!description.boundary_groups.empty()) {
        h5::write_texts(file, "boundary_groups", description.boundary_groups, {description.boundary_groups.size()}, place);
    }
    if (description.n_faces > 0) {
        faces = h5::create_dataset(file, "faces", H5T_STD_I64LE, {description.n_faces, format::face_numbers}, 0,
                                   format::face_numbers * sizeof(std::int64_t), place);
    }
    if (description.n_parts > 0) {
        h5::write_attribute(file, "n_parts", description.n_parts, place);
        parts = h5::create_dataset(file, "parts", H5T_STD_U32LE, {description.n_elements()}, 0, sizeof(std::uint32_t), place);
    }
}

void Writer::Impl::create_classes() {
    const Handle classes = h5::create_group(file, "classes", place.child("classes"));
    open_geometry.resize(description.classes.size());
    written_geometry.resize(description.classes.size());
    written_numbers.resize(description.classes.size());
    number_is_used.resize(description.n_elements());
    for (std::size_t index = 0; index < description.classes.size(); ++index) {
        const ElementClass& element_class = description.classes[index];
        const Place here = place.child("classes").child(std::to_string(index));
        const Handle group = h5::create_group(classes, std::to_string(index), here);
        h5::write_text(group, "shape", std::string(name(element_class.geometry.shape)), here);
        write_space(group, element_class.geometry, "geometry_basis", "geometry_order", here);
        h5::write_attribute(group, "n_elements", element_class.n_elements, here);
        const std::size_t modes = n_modes(element_class.geometry);
        geometry.push_back(h5::create_dataset(group, "geometry", H5T_IEEE_F64LE, {element_class.n_elements, 3, modes}, 0,
                                              3 * modes * sizeof(double), here));
        numbers.push_back(
            h5::create_dataset(group, "numbers", H5T_STD_I64LE, {element_class.n_elements}, 0, sizeof(std::int64_t), here));
    }
}

void Writer::Impl::create_fields() {
    const Handle fields = h5::create_group(file, "fields", place.child("fields"));
    for (std::size_t index = 0; index < description.fields.size(); ++index) {
        const Field& field = description.fields[index];
        const Place here = place.child("fields").child(std::to_string(index));
        field_groups.push_back(h5::create_group(fields, std::to_string(index), here));
        const Handle& group = field_groups.back();
        h5::write_text(group, "name", field.name, here);
        h5::write_text(group, "unit", field.unit, here);
        h5::write_attribute(group, "n_components", field.n_components, here);
        h5::write_text(group, "transform", format::name_of(format::transforms, field.transform), here);
        coefficients.emplace_back();
        open_coefficients.emplace_back(description.classes.size());
        written_coefficients.emplace_back(description.classes.size(), std::vector<Coverage>(description.times.size()));
        searches.emplace_back();
        if (field.transform == Transform::none) {
            const ExtremaSearch search(spaces_of(index), field.n_components);
            searches.back() = std::vector<ExtremaSearch>(description.times.size(), search);
        }
        for (std::size_t element_class = 0; element_class < description.classes.size(); ++element_class) {
            const Space& space = description.classes[element_class].fields.at(index);
            const std::string class_name = std::to_string(element_class);
            const Handle part = h5::create_group(group, class_name, here.child(class_name));
            write_space(part, space, "basis", "order", here.child(class_name));
            const std::uint64_t n_elements = description.classes[element_class].n_elements;
            const std::size_t modes = n_modes(space);
            coefficients.back().push_back(h5::create_dataset(
                part, "coefficients", H5T_IEEE_F64LE, {description.times.size(), n_elements, field.n_components, modes}, 1,
                field.n_components * modes * sizeof(double), here.child(class_name)));
        }
    }
}

std::vector<Space> Writer::Impl::spaces_of(std::size_t field) const {
    std::vector<Space> spaces;
    for (const ElementClass& element_class : description.classes) {
        spaces.push_back(element_class.fields.at(field));
    }
    return spaces;
}

void Writer::Impl::write_open_chunks() {
    for (std::size_t element_class = 0; element_class < geometry.size(); ++element_class) {
        h5::write_open_chunk(geometry[element_class], 0, H5T_NATIVE_DOUBLE, place, open_geometry[element_class]);
        for (std::size_t field = 0; field < coefficients.size(); ++field) {
            h5::write_open_chunk(coefficients[field][element_class], 1, H5T_NATIVE_DOUBLE, place,
                                 open_coefficients[field][element_class]);
        }
    }
    if (faces.is_valid()) {
        h5::write_open_chunk(faces, 0, H5T_NATIVE_INT64, place, open_faces);
    }
}

/**
 * Before coefficients are read back. H5Dwrite_chunk leaves a filter mask that was never set with the chunk that it wrote last:
 * HDF5 would take the packed bytes of that chunk for numbers, as long as the dataset stays open (H5D__chunk_direct_write, 1.10
 * to 1.14).
 */
void Writer::Impl::reopen_coefficients(std::size_t field) {
    const Place here = place.child("fields").child(std::to_string(field));
    for (std::size_t element_class = 0; element_class < coefficients[field].size(); ++element_class) {
        Handle& dataset = coefficients[field][element_class];
        dataset.reset();
        const std::string name = std::to_string(element_class) + "/coefficients";
        dataset = Handle(
            h5::check(H5Dopen2(field_groups[field].id(), name.c_str(), H5P_DEFAULT), here.child(name), "is damaged"), H5Dclose);
    }
}

void Writer::Impl::write_extrema(std::size_t field) {
    reopen_coefficients(field);
    const Place here = place.child("fields").child(std::to_string(field));
    const std::uint32_t n_components = description.fields[field].n_components;
    std::vector<double> rows;
    for (std::size_t step = 0; step < searches[field].size(); ++step) {
        const auto read = [&](std::size_t element_class, std::uint64_t first, std::uint64_t count, std::span<double> out) {
            const std::size_t modes = n_modes(description.classes[element_class].fields[field]);
            h5::read_box(coefficients[field][element_class], H5T_NATIVE_DOUBLE, {step, first, 0, 0},
                         {1, count, n_components, modes}, out.data(), here);
        };
        for (const Extrema& extrema : searches[field][step].finish(read)) {
            for (const Extremum& extremum : {extrema.minimum, extrema.maximum}) {
                rows.insert(rows.end(),
                            {extremum.value, extremum.bound, static_cast<double>(extremum.element_class),
                             static_cast<double>(extremum.element), extremum.xi[0], extremum.xi[1], extremum.xi[2]});
            }
        }
    }
    const std::vector<hsize_t> shape = {description.times.size(), n_extrema(n_components), 2, format::extremum_numbers};
    const Handle dataset = h5::create_dataset(field_groups[field], "extrema", H5T_IEEE_F64LE, shape, 0,
                                              rows.size() / description.times.size() * sizeof(double), here);
    h5::write_box(dataset, H5T_NATIVE_DOUBLE, {0, 0, 0, 0}, shape, rows.data(), here.child("extrema"));
}

void Writer::Impl::check_complete() const {
    const auto require = [&](const Coverage& written, std::uint64_t n_rows, const std::string& what) {
        const std::uint64_t missing = written.first_missing(n_rows);
        if (missing < n_rows) {
            throw FileError(path, what + " is not complete: row " + std::to_string(missing) + " was not written");
        }
    };
    for (std::size_t index = 0; index < description.classes.size(); ++index) {
        const std::uint64_t n_elements = description.classes[index].n_elements;
        const std::string class_name = "class " + std::to_string(index);
        require(written_geometry[index], n_elements, "the geometry of " + class_name);
        require(written_numbers[index], n_elements, "the element numbers of " + class_name);
        for (std::size_t field = 0; field < description.fields.size(); ++field) {
            for (std::size_t step = 0; step < description.times.size(); ++step) {
                require(written_coefficients[field][index][step], n_elements,
                        "field '" + description.fields[field].name + "' of " + class_name + ", time step " +
                            std::to_string(step));
            }
        }
    }
    require(written_faces, description.n_faces, "the list of faces");
    if (description.n_parts > 0 && !has_written_parts) {
        throw FileError(path, "the list of parts was not written");
    }
    const auto unused = std::find(number_is_used.begin(), number_is_used.end(), false);
    if (unused != number_is_used.end()) {
        throw FileError(path, "no element has the number " + std::to_string(unused - number_is_used.begin()));
    }
}

Writer::Writer(const std::string& path, const Description& description) : m_impl(std::make_unique<Impl>()) {
    const std::string problem = problem_of(description);
    if (!problem.empty()) {
        throw FileError(path, "cannot be written: " + problem);
    }
    m_impl->path = path;
    m_impl->temporary = temporary_name(path);
    m_impl->description = description;
    m_impl->place = {path, {}};
    const h5::Lock guard;
    m_impl->create_file();
    m_impl->create_classes();
    m_impl->create_fields();
}

Writer::~Writer() = default;
Writer::Writer(Writer&&) noexcept = default;
Writer& Writer::operator=(Writer&&) noexcept = default;

PackedRows Writer::pack_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                                 std::span<const double> coefficients) const {
    assert(coefficients.size() == count * 3 * n_modes(m_impl->description.classes.at(element_class).geometry));
    return h5::pack_chunk_rows(m_impl->geometry[element_class], {first, 0, 0}, count, 0, coefficients.data());
}

void Writer::write_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                            std::span<const double> coefficients, const PackedRows& packed) {
    assert(coefficients.size() == count * 3 * n_modes(m_impl->description.classes.at(element_class).geometry));
    h5::write_chunk_rows(m_impl->geometry[element_class], {first, 0, 0}, count, 0, coefficients.data(), H5T_NATIVE_DOUBLE,
                         m_impl->place, m_impl->open_geometry[element_class], packed);
    const h5::Lock guard;
    m_impl->written_geometry[element_class].add(first, count);
}

PackedRows Writer::pack_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                              std::uint64_t count, std::span<const double> coefficients) const {
    assert(coefficients.size() == count * m_impl->description.fields.at(field).n_components *
                                      n_modes(m_impl->description.classes.at(element_class).fields[field]));
    return h5::pack_chunk_rows(m_impl->coefficients[field][element_class], {time_step, first, 0, 0}, count, 1,
                               coefficients.data());
}

void Writer::write_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                         std::uint64_t count, std::span<const double> coefficients, const PackedRows& packed) {
    assert(coefficients.size() == count * m_impl->description.fields[field].n_components *
                                      n_modes(m_impl->description.classes.at(element_class).fields.at(field)));
    if (m_impl->description.fields[field].transform == Transform::none) {
        m_impl->searches[field].at(time_step).add(element_class, first, count, coefficients);
    }
    h5::write_chunk_rows(m_impl->coefficients[field][element_class], {time_step, first, 0, 0}, count, 1, coefficients.data(),
                         H5T_NATIVE_DOUBLE, m_impl->place, m_impl->open_coefficients[field][element_class], packed);
    const h5::Lock guard;
    m_impl->written_coefficients[field][element_class].at(time_step).add(first, count);
}

void Writer::write_numbers(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                           std::span<const std::int64_t> numbers) {
    assert(numbers.size() == count);
    auto& is_used = m_impl->number_is_used;
    for (const std::int64_t number : numbers) {
        if (number < 0 || static_cast<std::uint64_t>(number) >= is_used.size()) {
            throw FileError(m_impl->path, "cannot be written: an element has the number " + std::to_string(number) + " of " +
                                              std::to_string(is_used.size()));
        }
        is_used[static_cast<std::size_t>(number)] = true;
    }
    const h5::Lock guard;
    h5::write_box(m_impl->numbers.at(element_class), H5T_NATIVE_INT64, {first}, {count}, numbers.data(), m_impl->place);
    m_impl->written_numbers[element_class].add(first, count);
}

void Writer::write_faces(std::uint64_t first, std::uint64_t count, std::span<const Face> faces) {
    assert(faces.size() == count);
    std::vector<std::int64_t> rows;
    rows.reserve(count * format::face_numbers);
    for (const Face& face : faces) {
        const std::string problem = problem_of(face, m_impl->number_is_used.size(), m_impl->description.boundary_groups.size());
        if (!problem.empty()) {
            throw FileError(m_impl->path, "cannot be written: a face " + problem);
        }
        rows.insert(rows.end(), {face.element, face.neighbour, face.local_face, face.neighbour_local_face, face.group});
    }
    h5::write_chunk_rows(m_impl->faces, {first, 0}, count, 0, rows.data(), H5T_NATIVE_INT64, m_impl->place, m_impl->open_faces);
    const h5::Lock guard;
    m_impl->written_faces.add(first, count);
}

void Writer::write_parts(std::span<const std::uint32_t> parts) {
    assert(parts.size() == m_impl->description.n_elements());
    for (const std::uint32_t part : parts) {
        if (part >= m_impl->description.n_parts) {
            throw FileError(m_impl->path, "cannot be written: an element is in part " + std::to_string(part) + " of " +
                                              std::to_string(m_impl->description.n_parts));
        }
    }
    const h5::Lock guard;
    h5::write_box(m_impl->parts, H5T_NATIVE_UINT32, {0}, {parts.size()}, parts.data(), m_impl->place.child("parts"));
    m_impl->has_written_parts = true;
}

void Writer::set_max_jump(std::size_t field, double jump) { m_impl->description.fields.at(field).max_jump = jump; }

void Writer::set_continuity(std::size_t field, Continuity continuity) {
    m_impl->description.fields.at(field).continuity = continuity;
}

void Writer::set_note(const std::string& key, const std::string& value) {
    auto& notes = m_impl->description.notes;
    const auto found = std::find_if(notes.begin(), notes.end(), [&](const auto& note) { return note.first == key; });
    if (found != notes.end()) {
        found->second = value;
    } else {
        notes.emplace_back(key, value);
    }
}

void Writer::commit() {
    const std::string problem = problem_of(m_impl->description);
    if (!problem.empty()) {
        throw FileError(m_impl->path, "cannot be written: " + problem);
    }
    m_impl->check_complete();
    m_impl->write_open_chunks();
    const Description& description = m_impl->description;
    {
        const h5::Lock guard;
        for (std::size_t index = 0; index < description.fields.size(); ++index) {
            const Place here = m_impl->place.child("fields").child(std::to_string(index));
            h5::write_text(m_impl->field_groups[index], "continuity",
                           format::name_of(format::continuities, description.fields[index].continuity), here);
            h5::write_attribute(m_impl->field_groups[index], "max_jump", description.fields[index].max_jump, here);
            if (description.fields[index].transform == Transform::none) {
                m_impl->write_extrema(index);
            }
        }
        h5::write_attribute(m_impl->file, "n_notes", static_cast<std::uint32_t>(description.notes.size()), m_impl->place);
        if (!description.notes.empty()) {
            std::vector<std::string> texts;
            for (const auto& [key, value] : description.notes) {
                texts.push_back(key);
                texts.push_back(value);
            }
            h5::write_texts(m_impl->file, "notes", texts, {description.notes.size(), 2}, m_impl->place);
        }
        // Closing writes what is still in memory: its result counts.
        check(H5Fflush(m_impl->file.id(), H5F_SCOPE_GLOBAL), m_impl->place, "cannot be written; is the disk full?");
        m_impl->close();
    }
    if (!synchronize(m_impl->temporary, O_RDONLY)) {
        throw FileError(m_impl->path, "cannot be written: " + std::string(std::strerror(errno)));
    }
    if (std::rename(m_impl->temporary.c_str(), m_impl->path.c_str()) != 0) {
        throw FileError(m_impl->path, "cannot be put in place: " + std::string(std::strerror(errno)));
    }
    m_impl->is_temporary_there = false;
    // The file is complete; some file systems cannot synchronize a folder, which is no failure of ours.
    const std::filesystem::path folder = std::filesystem::path(m_impl->path).parent_path();
    synchronize(folder.empty() ? "." : folder.string(), O_RDONLY | O_DIRECTORY);
}

} // namespace elvis::native
