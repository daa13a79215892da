#include "element_classes.hpp"

#include "nektarpp_snippet.hpp"
#include "nodes_text.hpp"

#include <algorithm>
#include <cstring>
#include <map>

namespace nektarpp {

namespace {

namespace native = elvis::native;

/** Highest order that the snippet is compiled for: beyond, unrolled loops take a compiler seconds. */
constexpr std::uint32_t max_snippet_order = 16;

/** Number of a basis in the snippet. */
std::int64_t number_of(Basis basis) { return basis == Basis::modified ? 0 : basis == Basis::orthogonal ? 1 : 2; }

void check_order(const Space& space, const MeshElement& element, const std::string& path, const std::string& what) {
    const std::uint32_t order = std::ranges::max(space.order);
    if (order > max_snippet_order) {
        throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, path,
                                std::string(native::name(element.shape)) + " " + std::to_string(element.id) + ": " + what +
                                    " has " + std::to_string(order + 1) + " modes in a direction; up to " +
                                    std::to_string(max_snippet_order + 1) +
                                    " are drawn without conversion. Convert the data instead, to a lower order: elvis convert "
                                    "MESH FIELDS --order " +
                                    std::to_string(max_snippet_order) + " -o volume.h5");
    }
}

/** A space where the file has no data: it holds the same NaN everywhere, whatever its modes are. */
Space space_without_data(Shape shape) { return native_space(modified_modes(shape, 2)); }

void add_space(std::vector<elvis_constant>& list, const std::array<const char*, 4>& names, const Space& space,
               std::size_t width) {
    // The snippet takes a triangle for a prism's section, whose third direction is the triangle's second.
    const bool is_triangle = space.shape == Shape::triangle;
    list.push_back(elvis::api::constant(names[0], space.order[0]));
    list.push_back(elvis::api::constant(names[1], is_triangle ? 0 : space.order[1]));
    list.push_back(elvis::api::constant(names[2], is_triangle ? space.order[1] : space.order[2]));
    list.push_back(elvis::api::constant(names[3], static_cast<std::int64_t>(Record(space, width).slab_rows())));
}

void complete(ElementClass& of) {
    for (const Space& field : of.fields) {
        std::vector<elvis_constant> list;
        add_space(list, {"NEKTAR_GEOMETRY_P", "NEKTAR_GEOMETRY_Q", "NEKTAR_GEOMETRY_R", "NEKTAR_GEOMETRY_SLAB_ROWS"},
                  of.geometry, 3);
        add_space(list, {"NEKTAR_FIELD_P", "NEKTAR_FIELD_Q", "NEKTAR_FIELD_R", "NEKTAR_FIELD_SLAB_ROWS"}, field, 1);
        list.push_back(elvis::api::constant("NEKTAR_FIELD_BASIS", number_of(field.basis)));
        list.push_back(elvis::api::constant("NEKTAR_FIELD_NODES", field.basis == Basis::gauss_lagrange ? 1 : 0));
        of.constants.push_back(std::move(list));
    }
    of.nodes_text = write_nodes(of.fields);
    for (const auto& file : snippet::files) {
        // Known to #include and to messages by its name alone.
        const char* slash = std::strrchr(file.name, '/');
        of.sources.push_back(elvis::api::text(slash ? slash + 1 : file.name, file.text));
    }
    of.sources.push_back(elvis::api::text("nektar_nodes.glsl", of.nodes_text.c_str()));
}

} // namespace

ElementClasses::ElementClasses(const Mesh& mesh, const FieldSeries& series) {
    const std::vector<MeshElement>& elements = mesh.elements();
    // Shape, modes of the mapping, then basis and orders of each field. In the order of shapes, then of orders.
    using Key = std::vector<std::uint32_t>;
    std::map<Key, std::vector<std::uint64_t>> members;
    std::map<Key, std::vector<Space>> spaces;
    Key key;
    std::vector<Space> fields(series.fields().size());
    for (std::uint64_t element = 0; element < elements.size(); ++element) {
        const Shape shape = elements[element].shape;
        key = {static_cast<std::uint32_t>(shape), elements[element].n_along};
        for (std::size_t field = 0; field < fields.size(); ++field) {
            const ModeSet* modes = series.modes(field, element);
            fields[field] = modes ? native_space(*modes) : space_without_data(shape);
            key.push_back(static_cast<std::uint32_t>(fields[field].basis));
            key.insert(key.end(), fields[field].order.begin(), fields[field].order.end());
        }
        std::vector<std::uint64_t>& list = members[key];
        if (list.empty()) {
            check_order(native_space(Mesh::mapping_modes(elements[element])), elements[element], mesh.path(), "the mapping");
            for (std::size_t field = 0; field < fields.size(); ++field) {
                check_order(fields[field], elements[element], series.paths(0).path, "field " + series.fields()[field]);
            }
            spaces[key] = fields;
        }
        list.push_back(element);
    }
    position_of.resize(elements.size());
    for (auto& [of, list] : members) {
        ElementClass added;
        added.geometry = native_space(Mesh::mapping_modes(elements[list.front()]));
        added.fields = std::move(spaces[of]);
        added.first = number_of.size();
        added.n_elements = list.size();
        for (const std::uint64_t element : list) {
            position_of[element] = number_of.size();
            number_of.push_back(element);
        }
        classes.push_back(std::move(added));
    }
    // Texts are pointed to: only now does no class move any more.
    std::ranges::for_each(classes, complete);
}

const ElementClass& ElementClasses::at_position(std::uint64_t position) const {
    return *(std::ranges::upper_bound(classes, position, {}, &ElementClass::first) - 1);
}

} // namespace nektarpp
