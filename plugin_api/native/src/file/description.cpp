#include "description.hpp"

#include <algorithm>
#include <set>

namespace elvis::native {

std::uint64_t Description::n_elements() const {
    std::uint64_t sum = 0;
    for (const ElementClass& element_class : classes) {
        sum += element_class.n_elements;
    }
    return sum;
}

namespace {

std::string problem_of(const Space& space, Shape shape) {
    try {
        check(space);
    } catch (const std::invalid_argument& error) {
        return std::string("a space that does not exist: ") + error.what();
    }
    return space.shape == shape ? "" : "a field whose space has another shape than the geometry";
}

std::string problem_of(const ElementClass& element_class, const Description& description) {
    const Space& geometry = element_class.geometry;
    if (element_class.n_elements == 0 || element_class.n_elements > most_elements) {
        return "an impossible number of elements, " + std::to_string(element_class.n_elements);
    }
    if (element_class.fields.size() != description.fields.size()) {
        return std::to_string(element_class.fields.size()) + " spaces for " + std::to_string(description.fields.size()) +
               " fields";
    }
    std::string problem = problem_of(geometry, geometry.shape);
    for (const Space& space : element_class.fields) {
        if (problem.empty()) {
            problem = problem_of(space, geometry.shape);
        }
    }
    if (problem.empty() && dimension(geometry.shape) != description.dimension) {
        problem = "the shape " + std::string(name(geometry.shape)) + " in a volume of dimension " +
                  std::to_string(description.dimension);
    }
    if (problem.empty() && geometry.order[0] == 0) {
        problem = "geometry of order 0";
    }
    return problem;
}

std::string problem_of(const Field& field, int dimension) {
    if (field.name.empty()) {
        return "no name";
    }
    if (field.name.size() > longest_text || field.unit.size() > longest_text) {
        return "a name or unit that is too long";
    }
    if (field.n_components == 0 || field.n_components > most_components) {
        return "an impossible number of components, " + std::to_string(field.n_components);
    }
    if (field.continuity > Continuity::discontinuous || field.transform > Transform::contravariant) {
        return "an unknown continuity or transform";
    }
    if (field.transform != Transform::none && field.n_components != static_cast<std::uint32_t>(dimension)) {
        return "a transform, which needs " + std::to_string(dimension) + " components, but " +
               std::to_string(field.n_components) + " of them";
    }
    return "";
}

bool too_long(const std::string& text) { return text.size() > longest_text; }

} // namespace

std::string problem_of(const Description& description) {
    if (description.dimension != 2 && description.dimension != 3) {
        return "the dimension is " + std::to_string(description.dimension) + ", neither 2 nor 3";
    }
    if (description.classes.empty() || description.classes.size() > most_classes) {
        return "there are " + std::to_string(description.classes.size()) + " element classes";
    }
    if (description.times.empty() || description.times.size() > most_times) {
        return "there are " + std::to_string(description.times.size()) + " time steps";
    }
    if (description.fields.size() > most_fields || description.notes.size() > most_notes ||
        description.boundary_groups.size() > most_groups) {
        return "there are too many fields, notes or boundary groups";
    }
    std::set<std::string> names;
    for (std::size_t index = 0; index < description.fields.size(); ++index) {
        const std::string problem = problem_of(description.fields[index], description.dimension);
        if (!problem.empty()) {
            return "field " + std::to_string(index) + " has " + problem;
        }
        if (!names.insert(description.fields[index].name).second) {
            return "two fields have the name '" + description.fields[index].name + "'";
        }
    }
    for (std::size_t index = 0; index < description.classes.size(); ++index) {
        const std::string problem = problem_of(description.classes[index], description);
        if (!problem.empty()) {
            return "class " + std::to_string(index) + " has " + problem;
        }
    }
    if (description.n_elements() > most_elements || description.n_faces > 6 * most_elements) {
        return "there are too many elements or faces";
    }
    if (description.n_parts > most_parts) {
        return "there are too many parts";
    }
    const auto long_note = [](const auto& note) { return too_long(note.first) || too_long(note.second); };
    if (std::any_of(description.boundary_groups.begin(), description.boundary_groups.end(), too_long) ||
        std::any_of(description.notes.begin(), description.notes.end(), long_note)) {
        return "the name of a boundary group or a note is too long";
    }
    return "";
}

std::string problem_of(const Face& face, std::uint64_t n_elements, std::uint64_t n_groups) {
    const auto end = static_cast<std::int64_t>(n_elements);
    if (face.element < 0 || face.element >= end) {
        return "names element " + std::to_string(face.element) + " of " + std::to_string(end);
    }
    if (face.neighbour < -2 || face.neighbour >= end) {
        return "names the neighbour " + std::to_string(face.neighbour) + " of " + std::to_string(end);
    }
    // Six local faces is the most that a shape has.
    if (face.local_face < 0 || face.local_face > 5 || face.neighbour_local_face < -1 || face.neighbour_local_face > 5) {
        return "names a local face that no shape has";
    }
    if (face.group < -1 || face.group >= static_cast<std::int64_t>(n_groups)) {
        return "names boundary group " + std::to_string(face.group) + " of " + std::to_string(n_groups);
    }
    return "";
}

} // namespace elvis::native
