#include "array_mesh.hpp"

#include "call.hpp"

#include <core/convert/topology/face_list.hpp>

#include <elvis/plugin.hpp>

#include <algorithm>

namespace elvis::library {

namespace {

/** The mesh of arrays as a source of conversion, which has no fields. */
class Mesh : public api::ConverterSource {
public:
    Mesh(const elvis_host* host, const native::Description& description, const std::vector<std::vector<double>>& geometry,
         const std::vector<elvis_array_class>& classes)
        : ConverterSource(api::Host(host)), m_description(&description), m_geometry(&geometry), m_classes(&classes) {
        m_first_elements.push_back(0);
        for (const elvis_array_class& element_class : classes) {
            m_first_elements.push_back(m_first_elements.back() + element_class.n_elements);
        }
    }
    /** What the table asks for; these meshes have no path. */
    Mesh(const api::Host& host, const std::vector<std::string>&, const std::string&) : ConverterSource(host) {
        throw api::Error(ELVIS_ERROR_UNSUPPORTED, {}, "a mesh of arrays is not opened by a path");
    }
    static std::uint32_t probe(const char*) { return 0; }

    void get_info(elvis_source_info& info) override {
        info.dimension = static_cast<std::uint32_t>(m_description->dimension);
        info.n_elements = m_first_elements.back();
        info.n_corner_ids = n_corner_ids();
        info.n_time_steps = 1;
        info.n_boundary_groups = static_cast<std::uint32_t>(m_description->boundary_groups.size());
        info.mantissa_bits = 53;
    }
    void get_field(std::uint32_t, elvis_source_field&) override {}
    void get_spaces(std::uint32_t, std::uint64_t, api::StructArray<elvis_source_space>) override {}
    /** There are no fields. */
    void sample(std::uint32_t, std::uint64_t, std::span<const double>, double*) override {}
    elvis_string get_boundary_group(std::uint32_t group) { return m_description->boundary_groups[group].c_str(); }

    void get_elements(std::uint64_t first, api::StructArray<elvis_source_element> elements) override {
        for (std::uint64_t index = 0; index < elements.size(); ++index) {
            const auto [element_class, local] = place(first + index);
            elements.set(index, element(element_class, local));
        }
    }

    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) override {
        const auto [element_class, local] = place(element);
        const native::Space& space = m_description->classes[element_class].geometry;
        const std::size_t n_modes = native::n_modes(space);
        const std::span<const double> numbers =
            std::span((*m_geometry)[element_class]).subspan(3 * n_modes * local, 3 * n_modes);
        for (std::size_t at = 0; at < xi.size(); at += 3) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                positions[at + axis] =
                    native::evaluate(space, numbers.subspan(axis * n_modes, n_modes), {xi[at], xi[at + 1], xi[at + 2]});
            }
        }
    }

private:
    std::pair<std::size_t, std::uint64_t> place(std::uint64_t element) const {
        const auto after = std::ranges::upper_bound(m_first_elements, element);
        const auto element_class = static_cast<std::size_t>(after - m_first_elements.begin()) - 1;
        return {element_class, element - m_first_elements[element_class]};
    }

    /** 0: corners are matched by their places. */
    std::uint64_t n_corner_ids() const {
        std::int64_t largest = -1;
        for (const elvis_array_class& element_class : *m_classes) {
            const auto n = static_cast<std::uint64_t>(native::n_corners(static_cast<native::Shape>(element_class.shape)));
            for (std::uint64_t at = 0; element_class.corners != nullptr && at < n * element_class.n_elements; ++at) {
                largest = std::max(largest, element_class.corners[at]);
            }
        }
        return static_cast<std::uint64_t>(largest + 1);
    }

    elvis_source_element element(std::size_t element_class, std::uint64_t local) const {
        const elvis_array_class& given = (*m_classes)[element_class];
        const native::Space& space = m_description->classes[element_class].geometry;
        const auto n_corners = static_cast<std::size_t>(native::n_corners(space.shape));
        const auto n_faces = static_cast<std::size_t>(native::n_faces(space.shape));
        elvis_source_element result{};
        result.shape = given.shape;
        std::ranges::copy(space.order, result.geometry_order);
        std::ranges::fill(result.face_groups, ELVIS_GROUP_NONE);
        if (given.corners != nullptr) {
            std::copy_n(given.corners + local * n_corners, n_corners, result.corners);
        }
        if (given.face_groups != nullptr) {
            std::copy_n(given.face_groups + local * n_faces, n_faces, result.face_groups);
        }
        return result;
    }

    const native::Description* m_description = nullptr;
    const std::vector<std::vector<double>>* m_geometry = nullptr;
    const std::vector<elvis_array_class>* m_classes = nullptr;
    std::vector<std::uint64_t> m_first_elements;
};

/** Ids and groups lie within what there is. */
void check_connectivity(const native::Description& description, const std::vector<elvis_array_class>& classes) {
    for (std::size_t index = 0; index < classes.size(); ++index) {
        const elvis_array_class& given = classes[index];
        const std::string what = "class " + std::to_string(index);
        if ((given.corners != nullptr) != (classes[0].corners != nullptr)) {
            throw InvalidArgument(what, "has corners where another class has none, or none where another has");
        }
        const auto shape = static_cast<native::Shape>(given.shape);
        const auto count = [&](int n_an_element) { return static_cast<std::uint64_t>(n_an_element) * given.n_elements; };
        constexpr std::int64_t n_ids = 0xfffffffe; // Topology counts corners with 32 bits.
        for (std::uint64_t at = 0; given.corners != nullptr && at < count(native::n_corners(shape)); ++at) {
            if (given.corners[at] < 0 || given.corners[at] >= n_ids) {
                throw InvalidArgument(what,
                                      "corner id " + std::to_string(given.corners[at]) + " is negative or above 2^32 - 3");
            }
        }
        const auto n_groups = static_cast<std::int32_t>(description.boundary_groups.size());
        for (std::uint64_t at = 0; given.face_groups != nullptr && at < count(native::n_faces(shape)); ++at) {
            if (given.face_groups[at] < ELVIS_GROUP_NONE || given.face_groups[at] >= n_groups) {
                throw InvalidArgument(what, "boundary group " + std::to_string(given.face_groups[at]) + " has no name");
            }
        }
    }
}

} // namespace

std::vector<native::Face> faces_of_mesh(const native::Description& description,
                                        const std::vector<std::vector<double>>& geometry,
                                        const std::vector<elvis_array_class>& classes, const std::string& name,
                                        const TaskControl& control) {
    check_connectivity(description, classes);
    const auto open = [&](const elvis_host* host) {
        return reinterpret_cast<elvis_source_volume*>(new Mesh(host, description, geometry, classes));
    };
    const SourceVolume source(Plugin::of_mesh(*api::converter_table<Mesh>(), name), name, open, &control);
    std::vector<elvis_shape> shapes;
    for (const elvis_array_class& element_class : classes) {
        shapes.insert(shapes.end(), element_class.n_elements, element_class.shape);
    }
    const Topology topology = find_topology(source, std::move(shapes), control);
    std::vector<native::Face> faces;
    list_faces(source, topology, control,
               [&](std::span<const native::Face> some) { faces.insert(faces.end(), some.begin(), some.end()); });
    return faces;
}

} // namespace elvis::library
