#include <core/scene/read/read_parts.hpp>

#include <elvis/native/space.hpp>

#include <string_view>

namespace elvis {

namespace {

std::uint32_t read_shape(const JsonObject& object, const std::string& name) {
    std::string list;
    for (std::uint32_t shape = 0; shape < native::n_shapes; ++shape) {
        const std::string_view known = native::name(native::Shape{shape});
        if (name == known) {
            return shape;
        }
        list += (list.empty() ? "" : ", ") + std::string(known);
    }
    object.fail("shapes", "has no shape '" + name + "'; there are " + list);
}

/** Numbers and pairs of numbers. */
std::vector<std::array<std::uint64_t, 2>> read_ids(const JsonObject& object) {
    std::vector<std::array<std::uint64_t, 2>> ranges;
    const auto number = [&](const nlohmann::json& value) -> std::uint64_t {
        if (!value.is_number_unsigned() && !(value.is_number_integer() && value.get<std::int64_t>() >= 0)) {
            object.fail("ids", "must be a list of element numbers and of ranges [first, last]");
        }
        return value.get<std::uint64_t>();
    };
    if (!object.raw("ids").is_array() || object.raw("ids").empty()) {
        object.fail("ids", "must be a list of element numbers and of ranges [first, last]");
    }
    for (const nlohmann::json& item : object.raw("ids")) {
        if (item.is_array() && item.size() == 2) {
            ranges.push_back({number(item[0]), number(item[1])});
        } else {
            ranges.push_back({number(item), number(item)});
        }
        if (ranges.back()[0] > ranges.back()[1]) {
            object.fail("ids", "has a range whose first number is larger than its last one");
        }
    }
    return ranges;
}

std::array<double, 2> read_interval(const JsonObject& object, const char* key) {
    const auto interval = fixed<2>(object.numbers(key));
    if (interval[0] > interval[1]) {
        object.fail(key, "must go from a smaller to a larger number");
    }
    return interval;
}

} // namespace

ElementSelection read_selection(const JsonObject& object) {
    ElementSelection selection;
    if (object.has("ids")) {
        selection.numbers = read_ids(object);
    }
    if (object.has("shapes")) {
        for (const std::string& name : object.texts("shapes")) {
            selection.shapes.push_back(read_shape(object, name));
        }
    }
    if (object.has("orders")) {
        const auto orders = read_interval(object, "orders");
        selection.orders = {static_cast<std::int32_t>(orders[0]), static_cast<std::int32_t>(orders[1])};
    }
    selection.has_negative_jacobian = object.has("negative_jacobian") && object.flag("negative_jacobian");
    if (object.has("value_range")) {
        selection.value_range = read_interval(object, "value_range");
    }
    if (object.has("box")) {
        selection.box = fixed<6>(object.numbers("box"));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if ((*selection.box)[axis] > (*selection.box)[axis + 3]) {
                object.fail("box", "must have the smaller coordinates first");
            }
        }
    }
    if (object.has("faces")) {
        const std::string faces = object.word("faces");
        selection.faces = faces == "all"     ? ElementSelection::Faces::all
                          : faces == "outer" ? ElementSelection::Faces::outer
                                             : ElementSelection::Faces::inner;
    }
    return selection;
}

WireFrame read_wireframe(const JsonObject& object) {
    WireFrame frame;
    frame.width = object.has("width") ? object.number("width") : 1;
    frame.is_undeformed = object.has("undeformed") && object.flag("undeformed");
    bool has_condition = false;
    for (const char* key : {"ids", "shapes", "orders", "negative_jacobian", "value_range", "box", "faces"}) {
        has_condition = has_condition || object.has(key);
    }
    if (has_condition) {
        frame.faces = ElementFaces{read_selection(object)};
    } else {
        frame.faces = BoundaryFaces{object.has("groups") ? object.texts("groups") : std::vector<std::string>()};
    }
    return frame;
}

} // namespace elvis
