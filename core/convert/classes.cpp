#include <core/convert/classes.hpp>

#include <algorithm>
#include <map>
#include <tuple>

namespace elvis {

namespace {

constexpr std::uint64_t elements_at_once = 65536;

using Orders = std::array<std::uint32_t, 3>;
/** Shape, geometry orders, then orders and containment of each field. */
using Key = std::vector<std::uint32_t>;

/** Orders that native spaces can have: collapsed directions may not be poorer than those collapsed into them. */
Orders admissible(native::Shape shape, native::Basis basis, Orders order) {
    using native::Shape;
    if (*std::max_element(order.begin(), order.end()) > 0) {
        for (std::uint32_t& one : order) {
            one = std::max(one, 1u);
        }
    }
    if (shape == Shape::prism) {
        order[2] = std::max(order[2], order[0]);
    } else if (shape == Shape::tetrahedron) {
        order[1] = std::max(order[1], order[0]);
        order[2] = std::max(order[2], order[1]);
    } else if (shape == Shape::pyramid && basis != native::Basis::tensor) {
        order.fill(*std::max_element(order.begin(), order.end()));
    } else if (shape == Shape::triangle) {
        order[1] = std::max(order[1], order[0]);
    }
    if (native::dimension(shape) == 2) {
        order[2] = 0;
    }
    return order;
}

/**
 * The space of a shape and order. Pyramids take `tensor`, which contains the polynomials and the rational spaces of other
 * codes, with an order of its own in each direction; a continuous target takes the modified basis, whose modes belong to
 * corners, edges and faces.
 */
native::Space target_space(native::Shape shape, const Orders& order, bool is_projected_continuous) {
    native::Space space;
    space.shape = shape;
    const bool is_linear = *std::max_element(order.begin(), order.end()) <= 1;
    space.basis = shape == native::Shape::pyramid && !is_linear && !is_projected_continuous ? native::Basis::tensor
                                                                                            : native::Basis::modified;
    space.order = admissible(shape, space.basis, order);
    return space;
}

} // namespace

std::vector<TargetClass> target_classes(const SourceVolume& source, const std::vector<std::uint32_t>& fields,
                                        const ConvertOptions& options, const TaskControl& control) {
    const std::uint64_t n_elements = source.info().n_elements;
    std::vector<TargetClass> classes;
    std::map<Key, std::size_t> index_of;
    std::vector<elvis_source_element> elements;
    std::vector<std::vector<elvis_source_space>> spaces(fields.size());

    for (std::uint64_t first = 0; first < n_elements; first += elements_at_once) {
        control.check();
        control.progress(-1, "looking at elements");
        const std::uint64_t count = std::min(elements_at_once, n_elements - first);
        elements.resize(count);
        source.elements(first, count, elements);
        for (std::size_t field = 0; field < fields.size(); ++field) {
            spaces[field].resize(count);
            source.spaces(fields[field], first, count, spaces[field]);
        }
        for (std::uint64_t index = 0; index < count; ++index) {
            const elvis_source_element& element = elements[index];
            Key key = {element.shape, element.geometry_order[0], element.geometry_order[1], element.geometry_order[2]};
            for (const auto& of_field : spaces) {
                const elvis_source_space& space = of_field[index];
                key.insert(key.end(), {space.order[0], space.order[1], space.order[2], space.is_contained});
            }
            const auto [found, is_new] = index_of.try_emplace(std::move(key), classes.size());
            if (is_new) {
                const auto shape = static_cast<native::Shape>(element.shape);
                TargetClass added;
                added.geometry = target_space(
                    shape, {element.geometry_order[0], element.geometry_order[1], element.geometry_order[2]}, false);
                for (std::size_t field = 0; field < fields.size(); ++field) {
                    const elvis_source_space& advised = spaces[field][index];
                    const Orders least = {advised.order[0], advised.order[1], advised.order[2]};
                    const Orders order = options.order ? Orders{*options.order, *options.order, *options.order} : least;
                    const bool contained =
                        advised.is_contained && std::equal(order.begin(), order.end(), least.begin(),
                                                           [](auto ours, auto needed) { return ours >= needed; });
                    const elvis_continuity continuity = options.continuity.value_or(source.fields()[fields[field]].continuity);
                    added.fields.push_back(target_space(shape, order, continuity == ELVIS_CONTINUITY_CONTINUOUS && !contained));
                    added.is_contained.push_back(contained);
                }
                classes.push_back(std::move(added));
            }
            classes[found->second].elements.push_back(first + index);
        }
    }
    return classes;
}

} // namespace elvis
