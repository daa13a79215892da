#include <core/base/error.hpp>
#include <core/plugin_host/host_services.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/plugin_host/table_copy.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

namespace elvis {

namespace {

constexpr std::uint32_t max_record_size = 1u << 24;
constexpr std::uint32_t known_dependences = ELVIS_DEPENDS_ON_FIELD | ELVIS_DEPENDS_ON_TIME;

std::string hexadecimal(std::uint32_t bits) {
    std::array<char, 12> text{};
    std::snprintf(text.data(), text.size(), "0x%x", bits);
    return text.data();
}

bool is_identifier(const std::string& name, bool upper_case) {
    if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front()))) {
        return false;
    }
    for (const char c : name) {
        const auto letter = static_cast<unsigned char>(c);
        if (!(std::isdigit(letter) || c == '_' || (upper_case ? std::isupper(letter) : std::islower(letter)))) {
            return false;
        }
    }
    return true;
}

} // namespace

struct RuntimeVolume::Impl {
    std::shared_ptr<const Plugin> plugin;
    const elvis_runtime* table = nullptr;
    std::unique_ptr<HostServices> services;
    std::string path;
    elvis_volume* volume = nullptr;
    elvis_volume_info info{};
    std::vector<ClassInfo> classes;
    std::vector<FieldInfo> fields;
    std::vector<double> times;
    std::vector<std::string> groups;
    std::vector<std::pair<std::string, std::string>> notes;

    ~Impl() {
        if (volume) {
            services->begin("close");
            table->close(volume);
            services->check(ELVIS_OK, "close", {});
        }
    }

    void check(elvis_result result, const char* function) const { services->check(result, function, path); }
    [[noreturn]] void refuse(const char* function, const std::string& what) const { services->refuse(function, path, what); }

    /** What this version cannot pass over: the picture would be wrong. */
    [[noreturn]] void refuse_newer(const std::string& what) const {
        throw Error(path,
                    "plugin " + plugin->id() + " needs a later version of ElVis: " + what + ", which this one does not know");
    }

    void check_certainty(elvis_certainty certainty, const char* function) const {
        if (certainty != ELVIS_CERTIFIED && certainty != ELVIS_ESTIMATED) {
            refuse(function, "the unknown certainty " + std::to_string(certainty));
        }
    }

    void read_info();
    void read_classes();
    void read_fields();
    void read_texts();
};

void RuntimeVolume::Impl::read_info() {
    info = sized<elvis_volume_info>();
    services->begin("get_info");
    check(table->get_info(volume, &info), "get_info");
    if (info.dimension != 2 && info.dimension != 3) {
        refuse("get_info", "dimension " + std::to_string(info.dimension));
    }
    // The device counts elements with 32 bits.
    if (info.n_elements >= 0xffffffffu) {
        refuse("get_info", std::to_string(info.n_elements) + " elements, which is more than can be drawn");
    }
    if (info.n_elements == 0 || info.n_classes == 0) {
        throw Error(path, "holds no elements");
    }
    if (info.n_classes > 65536 || info.n_fields > 4096 || info.n_time_steps > 10000000 || info.n_buffers > 1048576 ||
        info.n_notes > 65536 || info.n_boundary_groups > 1000000) {
        refuse("get_info", "an absurd count of classes, fields, time steps, buffers, notes or boundary groups");
    }
    if (info.n_time_steps == 0) {
        refuse("get_info", "no time step");
    }
    if (info.n_faces > 0 && !table->get_faces) {
        refuse("get_info", "faces, but get_faces is missing");
    }
    if (info.n_faces > 6 * info.n_elements) {
        refuse("get_info", std::to_string(info.n_faces) + " faces, which is more than the elements have");
    }
}

void RuntimeVolume::Impl::read_classes() {
    std::uint64_t n_elements = 0;
    for (std::uint32_t index = 0; index < info.n_classes; ++index) {
        auto theirs = sized<elvis_element_class>();
        services->begin("get_class");
        check(table->get_class(volume, index, &theirs), "get_class");
        if (theirs.shape > ELVIS_SHAPE_TRIANGLE || (theirs.shape >= ELVIS_SHAPE_QUADRILATERAL) != (info.dimension == 2)) {
            refuse("get_class", "shape " + std::to_string(theirs.shape) + " for class " + std::to_string(index));
        }
        if (theirs.n_elements > info.n_elements - n_elements) {
            refuse("get_class", "more elements than get_info counts");
        }
        ClassInfo ours;
        ours.shape = theirs.shape;
        ours.n_elements = theirs.n_elements;
        ours.first_element = n_elements;
        std::copy_n(theirs.geometry_order, 3, ours.geometry_order);
        ours.is_affine = theirs.is_affine != 0;
        classes.push_back(ours);
        n_elements += theirs.n_elements;
    }
    if (n_elements != info.n_elements) {
        refuse("get_class", "classes with " + std::to_string(n_elements) + " elements together, where get_info counts " +
                                std::to_string(info.n_elements));
    }
}

void RuntimeVolume::Impl::read_fields() {
    for (std::uint32_t index = 0; index < info.n_fields; ++index) {
        auto theirs = sized<elvis_field>();
        theirs.max_jump = std::nan("");
        services->begin("get_field");
        check(table->get_field(volume, index, &theirs), "get_field");
        if (!theirs.name || !*theirs.name || theirs.n_components == 0 || theirs.n_components > 1024) {
            refuse("get_field", "a field without name or with " + std::to_string(theirs.n_components) + " components");
        }
        if (theirs.transform > ELVIS_TRANSFORM_CONTRAVARIANT || theirs.continuity > ELVIS_CONTINUITY_DISCONTINUOUS) {
            refuse("get_field", "an unknown transform or continuity");
        }
        for (const FieldInfo& other : fields) {
            if (other.name == theirs.name) {
                refuse("get_field", "two fields named '" + other.name + "'");
            }
        }
        fields.push_back({theirs.name, theirs.unit ? theirs.unit : "", theirs.n_components, theirs.continuity, theirs.transform,
                          theirs.max_jump});
    }
}

void RuntimeVolume::Impl::read_texts() {
    times.assign(info.n_time_steps, 0.0);
    for (std::uint32_t step = 0; step < info.n_time_steps; ++step) {
        services->begin("get_time");
        check(table->get_time(volume, step, &times[step]), "get_time");
    }
    if (info.n_boundary_groups > 0 && !table->get_boundary_group) {
        refuse("get_info", "boundary groups, but get_boundary_group is missing");
    }
    for (std::uint32_t group = 0; group < info.n_boundary_groups; ++group) {
        elvis_string name = nullptr;
        services->begin("get_boundary_group");
        check(table->get_boundary_group(volume, group, &name), "get_boundary_group");
        groups.emplace_back(name ? name : "");
    }
    if (info.n_notes > 0 && !table->get_note) {
        refuse("get_info", "notes, but get_note is missing");
    }
    for (std::uint32_t note = 0; note < info.n_notes; ++note) {
        elvis_string key = nullptr;
        elvis_string value = nullptr;
        services->begin("get_note");
        check(table->get_note(volume, note, &key, &value), "get_note");
        notes.emplace_back(key ? key : "", value ? value : "");
    }
}

RuntimeVolume::RuntimeVolume(std::shared_ptr<const Plugin> plugin, const std::string& path, const std::string& options,
                             const TaskControl* control)
    : m_impl(std::make_unique<Impl>()) {
    assert(plugin);
    m_impl->table = plugin->runtime();
    if (!m_impl->table) {
        throw Error(path, "plugin " + plugin->id() + " serves no volumes for rendering");
    }
    m_impl->services = std::make_unique<HostServices>(plugin->id(), control);
    m_impl->plugin = std::move(plugin);
    m_impl->path = path;
    elvis_volume* volume = nullptr;
    m_impl->services->begin("open");
    m_impl->check(
        m_impl->table->open(m_impl->services->table(), path.c_str(), options.empty() ? nullptr : options.c_str(), &volume),
        "open");
    if (!volume) {
        m_impl->refuse("open", "success and no volume");
    }
    m_impl->volume = volume;
    m_impl->read_info();
    m_impl->read_classes();
    m_impl->read_fields();
    m_impl->read_texts();
}

RuntimeVolume::~RuntimeVolume() = default;
RuntimeVolume::RuntimeVolume(RuntimeVolume&&) noexcept = default;
RuntimeVolume& RuntimeVolume::operator=(RuntimeVolume&&) noexcept = default;

const std::string& RuntimeVolume::path() const { return m_impl->path; }
const Plugin& RuntimeVolume::plugin() const { return *m_impl->plugin; }
std::uint32_t RuntimeVolume::dimension() const { return m_impl->info.dimension; }
std::uint64_t RuntimeVolume::n_elements() const { return m_impl->info.n_elements; }
std::uint64_t RuntimeVolume::n_faces() const { return m_impl->info.n_faces; }
const std::vector<ClassInfo>& RuntimeVolume::classes() const { return m_impl->classes; }
const std::vector<FieldInfo>& RuntimeVolume::fields() const { return m_impl->fields; }
const std::vector<double>& RuntimeVolume::times() const { return m_impl->times; }
const std::vector<std::string>& RuntimeVolume::boundary_groups() const { return m_impl->groups; }
const std::vector<std::pair<std::string, std::string>>& RuntimeVolume::notes() const { return m_impl->notes; }
std::uint32_t RuntimeVolume::n_buffers() const { return m_impl->info.n_buffers; }

std::uint32_t RuntimeVolume::field_index(const std::string& name) const {
    std::string known;
    for (std::uint32_t index = 0; index < m_impl->fields.size(); ++index) {
        if (m_impl->fields[index].name == name) {
            return index;
        }
        known += (known.empty() ? "" : ", ") + m_impl->fields[index].name;
    }
    throw Error(m_impl->path, "has no field '" + name + "'; its fields are: " + (known.empty() ? "none" : known));
}

ClassFieldInfo RuntimeVolume::class_field(std::uint32_t element_class, std::uint32_t field) const {
    auto theirs = sized<elvis_class_field>();
    m_impl->services->begin("get_class_field");
    m_impl->check(m_impl->table->get_class_field(m_impl->volume, element_class, field, &theirs), "get_class_field");
    if (theirs.n_constants > 4096 || (theirs.n_constants > 0 && !theirs.constants)) {
        m_impl->refuse("get_class_field", std::to_string(theirs.n_constants) + " constants or no array of them");
    }
    ClassFieldInfo ours;
    std::copy_n(theirs.order, 3, ours.order);
    for (std::uint32_t index = 0; index < theirs.n_constants; ++index) {
        const elvis_constant constant = copy_entry(theirs.constants, index);
        if (!constant.name || !is_identifier(constant.name, true)) {
            m_impl->refuse("get_class_field", "a constant whose name is not an upper-case identifier");
        }
        ours.constants.emplace_back(constant.name, constant.value);
    }
    return ours;
}

BufferInfo RuntimeVolume::buffer(std::uint32_t buffer, std::uint32_t field) const {
    auto theirs = sized<elvis_buffer>();
    m_impl->services->begin("get_buffer");
    m_impl->check(m_impl->table->get_buffer(m_impl->volume, buffer, field, &theirs), "get_buffer");
    if (!theirs.name || !is_identifier(theirs.name, false)) {
        m_impl->refuse("get_buffer", "a name that is not a lower-case identifier");
    }
    if (theirs.kind > ELVIS_BUFFER_UINT ||
        (theirs.element_class != ELVIS_ALL_CLASSES && theirs.element_class >= m_impl->info.n_classes)) {
        m_impl->refuse("get_buffer", "an unknown kind or element class for buffer '" + std::string(theirs.name) + "'");
    }
    if (theirs.record_size == 0 || theirs.record_size > max_record_size || theirs.n_records >= 0xffffffffu) {
        m_impl->refuse("get_buffer", "an impossible record size or count for buffer '" + std::string(theirs.name) + "'");
    }
    if ((theirs.depends & ~known_dependences) != 0) {
        m_impl->refuse_newer("buffer '" + std::string(theirs.name) + "' depends on bits " +
                             hexadecimal(theirs.depends & ~known_dependences));
    }
    return {theirs.name, theirs.kind, theirs.element_class, theirs.depends, theirs.n_records, theirs.record_size};
}

Snippet RuntimeVolume::snippet(std::uint32_t element_class) const {
    auto theirs = sized<elvis_snippet>();
    m_impl->services->begin("get_snippet");
    m_impl->check(m_impl->table->get_snippet(m_impl->volume, element_class, &theirs), "get_snippet");
    if (!theirs.prefix || !is_identifier(theirs.prefix, false)) {
        m_impl->refuse("get_snippet", "a prefix that is not a lower-case identifier");
    }
    if (std::string prefix = theirs.prefix; prefix == "elvis" || prefix == "core") {
        m_impl->refuse("get_snippet", "the prefix '" + prefix + "', which is the host's own");
    }
    // There is none yet.
    if ((theirs.capabilities & ELVIS_SNIPPET_REQUIRED) != 0) {
        m_impl->refuse_newer("its snippet has the capabilities " + hexadecimal(theirs.capabilities & ELVIS_SNIPPET_REQUIRED));
    }
    if (theirs.n_sources == 0 || theirs.n_sources > 4096 || !theirs.sources) {
        m_impl->refuse("get_snippet", "no sources");
    }
    Snippet ours{theirs.capabilities, theirs.prefix, {}};
    for (std::uint32_t index = 0; index < theirs.n_sources; ++index) {
        const elvis_text source = copy_entry(theirs.sources, index);
        if (!source.name || !source.text) {
            m_impl->refuse("get_snippet", "a source without name or text");
        }
        ours.sources.push_back({source.name, source.text});
    }
    return ours;
}

bool RuntimeVolume::is_cut(std::uint32_t element_class) const {
    return (snippet(element_class).capabilities & ELVIS_SNIPPET_INSIDE) != 0;
}

bool RuntimeVolume::is_cut() const {
    bool is_any = false;
    for (std::uint32_t element_class = 0; element_class < classes().size(); ++element_class) {
        is_any = is_any || is_cut(element_class);
    }
    return is_any;
}

elvis_certainty RuntimeVolume::bounds(std::uint64_t first, std::uint64_t count, std::span<double> out) const {
    assert(out.size() == 6 * count && first + count <= n_elements());
    elvis_certainty certainty = ELVIS_ESTIMATED;
    m_impl->services->begin("get_bounds");
    m_impl->check(m_impl->table->get_bounds(m_impl->volume, first, count, out.data(), &certainty), "get_bounds");
    m_impl->check_certainty(certainty, "get_bounds");
    for (std::uint64_t element = 0; element < count; ++element) {
        for (std::uint64_t axis = 0; axis < 3; ++axis) {
            const double lower = out[6 * element + axis];
            const double upper = out[6 * element + 3 + axis];
            if (!std::isfinite(lower) || !std::isfinite(upper) || lower > upper) {
                m_impl->refuse("get_bounds", "bounds [" + std::to_string(lower) + ", " + std::to_string(upper) +
                                                 "] for element " + std::to_string(first + element));
            }
        }
    }
    return certainty;
}

bool RuntimeVolume::numbers_are_positions() const { return !m_impl->table->get_element_numbers; }

void RuntimeVolume::element_numbers(std::uint64_t first, std::uint64_t count, std::span<std::int64_t> out) const {
    assert(out.size() == count && first + count <= n_elements());
    if (numbers_are_positions()) {
        for (std::uint64_t index = 0; index < count; ++index) {
            out[index] = static_cast<std::int64_t>(first + index);
        }
        return;
    }
    m_impl->services->begin("get_element_numbers");
    m_impl->check(m_impl->table->get_element_numbers(m_impl->volume, first, count, out.data()), "get_element_numbers");
    for (const std::int64_t number : out) {
        if (number < 0 || number >= 0xffffffffll) {
            m_impl->refuse("get_element_numbers", "the number " + std::to_string(number));
        }
    }
}

void RuntimeVolume::faces(std::uint64_t first, std::uint64_t count, std::span<elvis_face> out) const {
    assert(out.size() == count && first + count <= n_faces());
    for (elvis_face& face : out) {
        face = sized<elvis_face>();
    }
    m_impl->services->begin("get_faces");
    m_impl->check(m_impl->table->get_faces(m_impl->volume, first, count, out.data()), "get_faces");
    const auto n = static_cast<std::int64_t>(n_elements());
    for (const elvis_face& face : out) {
        if (face.element < 0 || face.element >= n || face.neighbour >= n || face.neighbour < ELVIS_NEIGHBOUR_UNKNOWN ||
            face.local_face < 0 || face.local_face > 5 || face.neighbour_local_face < -1 || face.neighbour_local_face > 5 ||
            face.group < ELVIS_GROUP_NONE || face.group >= static_cast<std::int32_t>(m_impl->info.n_boundary_groups)) {
            m_impl->refuse("get_faces", "a face of element " + std::to_string(face.element) + " with numbers out of range");
        }
    }
}

bool RuntimeVolume::has_field_ranges() const { return m_impl->table->get_field_ranges != nullptr; }

elvis_certainty RuntimeVolume::field_ranges(std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
                                            std::uint64_t count, std::span<FieldRange> out) const {
    static_assert(sizeof(FieldRange) == 2 * sizeof(double));
    assert(has_field_ranges() && out.size() == count * m_impl->fields[field].n_components);
    elvis_certainty certainty = ELVIS_ESTIMATED;
    m_impl->services->begin("get_field_ranges");
    m_impl->check(m_impl->table->get_field_ranges(m_impl->volume, field, time_step, first, count,
                                                  reinterpret_cast<double*>(out.data()), &certainty),
                  "get_field_ranges");
    m_impl->check_certainty(certainty, "get_field_ranges");
    for (const FieldRange& range : out) {
        if (!(range.lower <= range.upper)) {
            m_impl->refuse("get_field_ranges", "a range whose ends are in the wrong order or NaN");
        }
    }
    return certainty;
}

std::optional<FieldExtrema> RuntimeVolume::extrema(std::uint32_t field, int component, std::uint32_t time_step) const {
    const elvis_extrema* table = m_impl->plugin->extrema();
    if (!table) {
        return {};
    }
    constexpr const char* function = "get_field_extrema";
    auto minimum = sized<elvis_extremum>(), maximum = sized<elvis_extremum>();
    elvis_certainty certainty = ELVIS_ESTIMATED;
    m_impl->services->begin(function);
    m_impl->check(table->get_field_extrema(m_impl->volume, field,
                                           component < 0 ? ELVIS_MAGNITUDE : static_cast<std::uint32_t>(component), time_step,
                                           &minimum, &maximum, &certainty),
                  function);
    m_impl->check_certainty(certainty, function);
    if (certainty != ELVIS_CERTIFIED) {
        return {};
    }
    const bool has_values = !std::isnan(minimum.value) || !std::isnan(maximum.value);
    if (has_values && !(minimum.bound <= minimum.value && minimum.value <= maximum.value && maximum.value <= maximum.bound)) {
        m_impl->refuse(function, "values and bounds in the wrong order, or NaN");
    }
    if (minimum.element >= n_elements() || maximum.element >= n_elements()) {
        m_impl->refuse(function, "an element that is not there");
    }
    const auto read = [](const elvis_extremum& from) {
        return FieldExtremum{from.value, from.bound, from.element, {from.xi[0], from.xi[1], from.xi[2]}};
    };
    return FieldExtrema{read(minimum), read(maximum), certainty};
}

bool RuntimeVolume::has_derivative_bounds() const { return m_impl->table->get_field_derivative_bounds != nullptr; }

elvis_certainty RuntimeVolume::derivative_bounds(std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
                                                 std::uint64_t count, std::span<DerivativeBounds> out) const {
    static_assert(sizeof(DerivativeBounds) == 2 * sizeof(double));
    assert(has_derivative_bounds() && out.size() == count * m_impl->fields[field].n_components);
    constexpr const char* function = "get_field_derivative_bounds";
    elvis_certainty certainty = ELVIS_ESTIMATED;
    m_impl->services->begin("get_field_derivative_bounds");
    m_impl->check(m_impl->table->get_field_derivative_bounds(m_impl->volume, field, time_step, first, count,
                                                             reinterpret_cast<double*>(out.data()), &certainty),
                  function);
    m_impl->check_certainty(certainty, function);
    for (std::size_t index = 0; index < out.size(); ++index) {
        for (const double bound : {out[index].first, out[index].second}) {
            if (bound < 0 || std::isinf(bound)) {
                m_impl->refuse(function, "the bound " + std::to_string(bound) + " for element " +
                                             std::to_string(first + index / m_impl->fields[field].n_components));
            }
        }
    }
    return certainty;
}

void RuntimeVolume::fill_buffer(const elvis_fill_request& request, void* destination) const {
    elvis_fill_request copy = request;
    copy.struct_size = sizeof copy;
    m_impl->services->begin("fill_buffer");
    m_impl->check(m_impl->table->fill_buffer(m_impl->volume, &copy, destination), "fill_buffer");
}

bool RuntimeVolume::has_evaluation() const { return m_impl->table->evaluate_mapping && m_impl->table->evaluate_field; }

void RuntimeVolume::evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions,
                                     std::span<double> jacobians) const {
    const std::size_t n_points = xi.size() / 3;
    assert(positions.empty() || positions.size() == 3 * n_points);
    assert(jacobians.empty() || jacobians.size() == 9 * n_points);
    m_impl->services->begin("evaluate_mapping");
    m_impl->check(m_impl->table->evaluate_mapping(m_impl->volume, element, n_points, xi.data(),
                                                  positions.empty() ? nullptr : positions.data(),
                                                  jacobians.empty() ? nullptr : jacobians.data()),
                  "evaluate_mapping");
}

void RuntimeVolume::evaluate_field(std::uint32_t field, std::uint32_t time_step, std::uint64_t element,
                                   std::span<const double> xi, std::span<double> values, std::span<double> gradients) const {
    [[maybe_unused]] const std::size_t n_numbers = xi.size() / 3 * m_impl->fields[field].n_components;
    assert(values.empty() || values.size() == n_numbers);
    assert(gradients.empty() || gradients.size() == 3 * n_numbers);
    m_impl->services->begin("evaluate_field");
    m_impl->check(m_impl->table->evaluate_field(m_impl->volume, field, time_step, element, xi.size() / 3, xi.data(),
                                                values.empty() ? nullptr : values.data(),
                                                gradients.empty() ? nullptr : gradients.data()),
                  "evaluate_field");
}

bool RuntimeVolume::has_jacobian_checks() const { return m_impl->table->check_jacobians != nullptr; }

elvis_certainty RuntimeVolume::check_jacobians(std::uint64_t first, double tolerance, std::span<JacobianCheck> out) const {
    assert(has_jacobian_checks() && dimension() == 3 && first + out.size() <= n_elements());
    auto unknown = sized<elvis_jacobian_check>();
    unknown.sign = ELVIS_JACOBIAN_UNDECIDED;
    unknown.lower = -std::numeric_limits<double>::infinity();
    std::vector<elvis_jacobian_check> theirs(out.size(), unknown);
    elvis_certainty certainty = ELVIS_ESTIMATED;
    m_impl->services->begin("check_jacobians");
    m_impl->check(m_impl->table->check_jacobians(m_impl->volume, first, out.size(), tolerance, theirs.data(), &certainty),
                  "check_jacobians");
    m_impl->check_certainty(certainty, "check_jacobians");
    for (std::size_t index = 0; index < out.size(); ++index) {
        const elvis_jacobian_check& check = theirs[index];
        const auto element = [&] { return " for element " + std::to_string(first + index); };
        if (check.sign > ELVIS_JACOBIAN_UNDECIDED) {
            m_impl->refuse("check_jacobians", "the unknown sign " + std::to_string(check.sign) + element());
        }
        if (check.sign == ELVIS_JACOBIAN_NEGATIVE) {
            for (const double x : check.xi) {
                // All shapes lie in this cube.
                if (!(x >= -1 && x <= 1)) {
                    m_impl->refuse("check_jacobians", "a point outside the reference shape" + element());
                }
            }
            if (!(check.determinant <= 0)) {
                m_impl->refuse("check_jacobians", "a negative sign and a determinant that is not" + element());
            }
        } else if (std::isnan(check.lower) || (check.sign == ELVIS_JACOBIAN_POSITIVE && check.lower < 0)) {
            m_impl->refuse("check_jacobians", "a lower bound of " + std::to_string(check.lower) + element());
        }
        out[index] = {check.sign, {check.xi[0], check.xi[1], check.xi[2]}, check.determinant, check.lower};
    }
    return certainty;
}

} // namespace elvis
