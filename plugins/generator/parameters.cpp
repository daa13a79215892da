#include "parameters.hpp"

#include "json_object.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

namespace generator {
namespace {

using nlohmann::json;

// Limits that keep every count within 64 bits and every space within the native volume's largest order (30).
constexpr std::uint32_t max_elements_per_direction = 1u << 20;
constexpr double max_elements = 1e11;
constexpr std::uint32_t highest_order = 30;
constexpr std::uint32_t max_geometry_order = 12;
constexpr std::uint32_t max_degree = 30;

const std::vector<std::pair<std::string, MeshKind>> meshes{{"box", MeshKind::box},
                                                           {"waves", MeshKind::waves},
                                                           {"ball", MeshKind::ball},
                                                           {"hemisphere", MeshKind::hemisphere},
                                                           {"shell", MeshKind::shell},
                                                           {"torus", MeshKind::torus},
                                                           {"twisted-tetrahedron", MeshKind::twisted_tetrahedron}};

const std::vector<std::pair<std::string, Split>> splits{{"hexahedron", Split::hexahedron},
                                                        {"prism", Split::prism},
                                                        {"tetrahedron", Split::tetrahedron},
                                                        {"pyramid", Split::pyramid},
                                                        {"mixed", Split::mixed}};

const std::vector<std::pair<std::string, FieldKind>> field_kinds{
    {"sphere", FieldKind::sphere},   {"polynomial", FieldKind::polynomial},
    {"sinc", FieldKind::sinc},       {"taylor-green", FieldKind::taylor_green},
    {"waves", FieldKind::waves},     {"jump", FieldKind::jump},
    {"element", FieldKind::element}, {"distance", FieldKind::distance}};

const std::vector<std::pair<std::string, elvis_continuity>> continuities{{"continuous", ELVIS_CONTINUITY_CONTINUOUS},
                                                                         {"discontinuous", ELVIS_CONTINUITY_DISCONTINUOUS}};

// Defaults of fields, given beside them in the file.
struct FieldDefaults {
    std::optional<std::array<std::uint32_t, 3>> order;
    std::optional<elvis_continuity> continuity;
    std::optional<std::uint32_t> degree;
    std::optional<std::vector<Term>> terms;
};

std::optional<std::array<std::uint32_t, 3>> read_order(const JsonObject& object) {
    if (!object.has("order"))
        return std::nullopt;
    const std::vector<double> order = object.numbers("order", 1, 3);
    if (order.size() == 2)
        object.fail("order", "must be one number, or three (hexahedra only)");
    std::array<std::uint32_t, 3> result{};
    for (std::size_t d = 0; d < 3; ++d)
        result[d] = object.whole("order", order[order.size() == 1 ? 0 : d], 0, highest_order);
    if (std::ranges::count(result, 0u) % 3 != 0)
        object.fail("order", "order 0 in one direction asks for order 0 in all");
    return result;
}

std::optional<std::vector<Term>> read_terms(const JsonObject& object) {
    if (!object.has("coefficients"))
        return std::nullopt;
    const json& list = object.take("coefficients");
    const std::string shape = "must be a list of [i, j, k, c], each the term c x^i y^j z^k";
    if (!list.is_array() || list.empty())
        object.fail("coefficients", shape);
    std::vector<Term> terms;
    for (const json& entry : list) {
        if (!entry.is_array() || entry.size() != 4 || !std::ranges::all_of(entry, [](const json& n) { return n.is_number(); }))
            object.fail("coefficients", shape);
        Term term;
        for (std::size_t d = 0; d < 3; ++d)
            term.exponents[d] = object.whole("coefficients", entry[d].get<double>(), 0, max_degree);
        term.coefficient = entry[3].get<double>();
        terms.push_back(term);
    }
    return terms;
}

FieldDefaults read_field_keys(const JsonObject& object) {
    FieldDefaults result;
    result.order = read_order(object);
    if (object.has("continuity"))
        result.continuity = object.choice("continuity", continuities);
    if (object.has("degree"))
        result.degree = object.whole("degree", object.number("degree"), 0, max_degree);
    result.terms = read_terms(object);
    return result;
}

// All monomials up to a total degree, with coefficients that differ from each other and fall off slowly.
std::vector<Term> default_terms(std::uint32_t degree) {
    std::vector<Term> terms;
    for (std::uint32_t i = 0; i <= degree; ++i)
        for (std::uint32_t j = 0; i + j <= degree; ++j)
            for (std::uint32_t k = 0; i + j + k <= degree; ++k)
                terms.push_back({{i, j, k}, 1.0 / (1.0 + i + 2.0 * j + 3.0 * k)});
    return terms;
}

FieldParameters make_field(FieldKind kind, std::optional<std::string> name, const FieldDefaults& own,
                           const FieldDefaults& defaults) {
    FieldParameters field;
    field.kind = kind;
    field.order = own.order ? own.order : defaults.order;
    field.continuity = own.continuity ? own.continuity : defaults.continuity;
    if (kind == FieldKind::element)
        field.order = {{0, 0, 0}};
    field.name = name.value_or(std::ranges::find(field_kinds, kind, &std::pair<std::string, FieldKind>::second)->first);
    if (kind == FieldKind::polynomial) {
        const auto& terms = own.terms || own.degree ? own.terms : defaults.terms;
        const auto& degree = own.degree ? own.degree : defaults.degree;
        field.terms = terms ? *terms : default_terms(degree.value_or(2));
    }
    return field;
}

std::vector<FieldParameters> read_fields(const JsonObject& root) {
    const FieldDefaults defaults = read_field_keys(root);
    std::vector<FieldParameters> fields;
    if (root.has("field") == root.has("fields"))
        root.fail("field", "give either \"field\", a name, or \"fields\", a list of names and objects");
    if (root.has("field")) {
        fields.push_back(make_field(root.choice("field", field_kinds), std::nullopt, {}, defaults));
    } else {
        const json& list = root.take("fields");
        if (!list.is_array() || list.empty())
            root.fail("fields", "must be a list of names and objects");
        for (const json& entry : list) {
            const json wrapped = entry.is_object() ? entry : json{{"field", entry}};
            const JsonObject object(wrapped, root.path(), "fields[" + std::to_string(fields.size()) + "].",
                                    {"field", "name", "order", "degree", "coefficients", "continuity"});
            const FieldKind kind = object.choice("field", field_kinds);
            std::optional<std::string> name;
            if (object.has("name"))
                name = object.text("name");
            fields.push_back(make_field(kind, name, read_field_keys(object), defaults));
        }
    }
    std::set<std::string> names;
    for (const FieldParameters& field : fields)
        if (field.name.empty() || !names.insert(field.name).second)
            root.fail("fields", "two fields are called \"" + field.name + "\"; give each a \"name\" of its own");
    return fields;
}

void read_box(const JsonObject& root, Parameters& p) {
    const json& box = root.take("box");
    bool valid = box.is_array() && box.size() == 2;
    for (std::size_t end = 0; valid && end < 2; ++end) {
        valid = box[end].is_array() && box[end].size() == 3;
        for (std::size_t d = 0; valid && d < 3; ++d) {
            valid = box[end][d].is_number();
            if (valid)
                p.box[end][d] = box[end][d].get<double>();
        }
    }
    for (std::size_t d = 0; valid && d < 3; ++d)
        valid = std::isfinite(p.box[0][d]) && std::isfinite(p.box[1][d]) && p.box[0][d] < p.box[1][d];
    if (!valid)
        root.fail("box", "must be [[x0, y0, z0], [x1, y1, z1]] with x0 < x1, y0 < y1, z0 < z1");
}

void read_mesh(const JsonObject& root, Parameters& p) {
    p.mesh = root.choice("mesh", meshes);
    const bool twisted = p.mesh == MeshKind::twisted_tetrahedron;
    const bool boxed = p.mesh == MeshKind::box || p.mesh == MeshKind::waves;
    p.split = twisted ? Split::tetrahedron : Split::hexahedron;
    if (root.has("shape"))
        p.split = root.choice("shape", splits);
    if (twisted && p.split != Split::tetrahedron)
        root.fail("shape", "the twisted tetrahedron is a tetrahedron");

    if (root.has("box")) {
        if (!boxed)
            root.fail("box", "belongs to the meshes box and waves only");
        read_box(root, p);
    }

    if (twisted)
        p.elements = {1, 1, 1};
    if (root.has("elements")) {
        const std::vector<double> n = root.numbers("elements", 1, 3);
        if (n.size() == 2)
            root.fail("elements", "must be one number or three");
        for (std::size_t d = 0; d < 3; ++d)
            p.elements[d] = root.whole("elements", n[n.size() == 1 ? 0 : d], 1, max_elements_per_direction);
        if (twisted && p.elements != std::array<std::uint32_t, 3>{1, 1, 1})
            root.fail("elements", "the twisted tetrahedron is one element");
        if (12.0 * p.elements[0] * p.elements[1] * p.elements[2] > max_elements)
            root.fail("elements", "asks for more than 1e11 elements");
    }
    if (p.split == Split::mixed && boxed && p.elements[0] < 4)
        root.fail("elements", "a mixed box needs at least 4 cells along x, one slab for each shape");
    if (p.mesh == MeshKind::torus && p.elements[2] < 3)
        root.fail("elements", "a torus needs at least 3 cells around");

    p.layers = std::max(2u, (p.elements[0] + 1) / 2);
    if (root.has("layers")) {
        if (boxed || twisted)
            root.fail("layers", "belongs to the meshes ball, hemisphere, shell and torus only");
        p.layers = root.whole("layers", root.number("layers"), 1, max_elements_per_direction);
    }
    if (p.split == Split::mixed && !boxed && p.layers < 2)
        root.fail("layers", "a mixed mesh needs at least 2 layers");

    p.geometry_order = p.mesh == MeshKind::box ? 1 : 2;
    if (root.has("geometry_order"))
        p.geometry_order = root.whole("geometry_order", root.number("geometry_order"), 1, max_geometry_order);
    if (twisted && p.geometry_order < 2)
        root.fail("geometry_order", "the twisted tetrahedron is quadratic: at least 2");
}

void read_lengths(const JsonObject& root, Parameters& p) {
    const auto length = [&root](const std::string& key, double& value, bool belongs) {
        if (!root.has(key))
            return;
        if (!belongs)
            root.fail(key, "does not belong to this mesh");
        value = root.number(key);
        if (!std::isfinite(value) || value < 0)
            root.fail(key, "must not be negative");
    };
    const bool round = p.mesh == MeshKind::ball || p.mesh == MeshKind::hemisphere || p.mesh == MeshKind::shell;
    length("radius", p.radius, round || p.mesh == MeshKind::torus);
    p.inner_radius = 0.5 * p.radius;
    length("inner_radius", p.inner_radius, p.mesh == MeshKind::shell);
    p.tube_radius = 0.4 * p.radius;
    length("tube_radius", p.tube_radius, p.mesh == MeshKind::torus);
    length("amplitude", p.amplitude, p.mesh == MeshKind::waves);
    if (p.radius == 0)
        root.fail("radius", "must be positive");
    if (p.inner_radius == 0 || p.inner_radius >= p.radius)
        root.fail("inner_radius", "must lie between 0 and radius");
    if (p.tube_radius == 0 || p.tube_radius >= p.radius)
        root.fail("tube_radius", "must lie between 0 and radius");
}

json parse(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw elvis::api::Error(ELVIS_ERROR_FILE, path, "cannot be opened");
    try {
        return json::parse(file);
    } catch (const json::exception& error) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path, std::string("is not valid JSON: ") + error.what());
    } catch (const std::ios_base::failure&) {
        throw elvis::api::Error(ELVIS_ERROR_FILE, path, "cannot be read; is it a folder?");
    }
}

} // namespace

Parameters read_parameters(const std::string& path) {
    const json text = parse(path);
    if (!text.is_object())
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path, "must hold a JSON object");
    const JsonObject root(text, path, "",
                          {"generator", "mesh", "shape", "box", "elements", "layers", "radius", "inner_radius", "tube_radius",
                           "amplitude", "geometry_order", "field", "fields", "order", "degree", "coefficients", "continuity",
                           "time_steps"});
    if (root.whole("generator", root.number("generator"), 0, highest_order) != 1)
        root.fail("generator", "version 1 is the only one known");
    Parameters p;
    read_mesh(root, p);
    read_lengths(root, p);
    if (root.has("time_steps"))
        p.time_steps = root.whole("time_steps", root.number("time_steps"), 1, 1000000);
    p.fields = read_fields(root);
    for (const FieldParameters& field : p.fields)
        if (field.order && p.split != Split::hexahedron && std::set(field.order->begin(), field.order->end()).size() > 1)
            root.fail("order", "different orders by direction are for hexahedra only");
    return p;
}

bool is_description(const std::string& path) noexcept {
    try {
        // The first bytes decide, so that a probe of some huge file stays cheap.
        std::ifstream file(path, std::ios::binary);
        std::string head(4096, '\0');
        file.read(head.data(), static_cast<std::streamsize>(head.size()));
        head.resize(static_cast<std::size_t>(file.gcount()));
        const std::size_t first = head.find_first_not_of(" \t\r\n");
        return first != std::string::npos && head[first] == '{' && head.find("\"generator\"") != std::string::npos;
    } catch (const std::exception&) {
        return false;
    }
}

} // namespace generator
