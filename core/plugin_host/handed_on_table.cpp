#include <core/plugin_host/handed_on_table.hpp>

#include <core/base/error.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

namespace elvis {

namespace {

constexpr std::uint64_t faces_at_once = 65536;
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/** What a volume throws, as plugins do: it has named plugin and function. */
template <class Call> auto hand_on(Call call) {
    try {
        return call();
    } catch (const Cancelled&) {
        throw api::Cancelled();
    } catch (const Error& error) {
        throw api::Error(ELVIS_ERROR_FAILED, error.place(), error.cause().substr(0, error.cause().rfind(" [plugin ")));
    }
}

elvis_certainty worse(elvis_certainty a, elvis_certainty b) { return std::max(a, b); }

std::span<double> wanted(double* numbers, std::size_t size) {
    return numbers == nullptr ? std::span<double>() : std::span(numbers, size);
}

} // namespace

HandedOnTable::HandedOnTable(const api::Host& host, const elvis::RuntimeVolume& asked,
                             const std::vector<std::uint64_t>& n_elements)
    : RuntimeVolume(host), m_asked(asked), m_first_of_class{0} {
    for (const std::uint64_t n : n_elements) {
        m_first_of_class.push_back(m_first_of_class.back() + n);
    }
}

void HandedOnTable::read_runs(std::uint64_t first, std::uint64_t count, const Read& read) const {
    hand_on([&] { for_each_run(first, count, read); });
}

std::uint64_t HandedOnTable::place_there(std::uint64_t element) const {
    std::uint64_t place = 0;
    for_each_run(element, 1, [&](std::uint64_t there, std::uint64_t, std::uint64_t) { place = there; });
    return place;
}

void HandedOnTable::read_faces(const std::function<void(elvis_face)>& take) const {
    std::vector<elvis_face> read;
    for (std::uint64_t first = 0; first < m_asked.n_faces(); first += faces_at_once) {
        host().check_cancelled();
        read.resize(std::min(faces_at_once, m_asked.n_faces() - first));
        hand_on([&] { m_asked.faces(first, read.size(), read); });
        std::ranges::for_each(read, take);
    }
}

void HandedOnTable::get_info(elvis_volume_info& info) {
    info.dimension = m_asked.dimension();
    info.n_elements = m_first_of_class.back();
    info.n_faces = m_faces.size();
    info.n_classes = static_cast<std::uint32_t>(m_asked.classes().size());
    info.n_boundary_groups = static_cast<std::uint32_t>(m_asked.boundary_groups().size());
    info.n_fields = static_cast<std::uint32_t>(m_asked.fields().size());
    info.n_time_steps = static_cast<std::uint32_t>(m_asked.times().size());
    info.n_buffers = m_asked.n_buffers();
}

void HandedOnTable::get_class(std::uint32_t element_class, elvis_element_class& out) {
    const ClassInfo& info = m_asked.classes().at(element_class);
    out.shape = info.shape;
    out.n_elements = m_first_of_class[element_class + 1] - m_first_of_class[element_class];
    std::ranges::copy(info.geometry_order, out.geometry_order);
    out.is_affine = info.is_affine ? 1 : 0;
}

void HandedOnTable::get_field(std::uint32_t field, elvis_field& out) {
    const FieldInfo& info = m_asked.fields().at(field);
    out.n_components = info.n_components;
    out.name = info.name.c_str();
    out.unit = info.unit.empty() ? nullptr : info.unit.c_str();
    out.continuity = info.continuity;
    out.transform = info.transform;
    out.max_jump = info.max_jump;
}

void HandedOnTable::get_class_field(std::uint32_t element_class, std::uint32_t field, elvis_class_field& out) {
    auto found = m_class_fields.find({element_class, field});
    if (found == m_class_fields.end()) {
        ClassField own;
        own.info = hand_on([&] { return m_asked.class_field(element_class, field); });
        found = m_class_fields.try_emplace({element_class, field}, std::move(own)).first;
        for (const auto& [name, value] : found->second.info.constants) {
            found->second.constants.push_back(api::constant(name.c_str(), value));
        }
    }
    out.n_constants = static_cast<std::uint32_t>(found->second.constants.size());
    out.constants = found->second.constants.data();
    std::ranges::copy(found->second.info.order, out.order);
}

double HandedOnTable::get_time(std::uint32_t time_step) { return m_asked.times().at(time_step); }

const BufferInfo& HandedOnTable::buffer_info(std::uint32_t buffer, std::uint32_t field) {
    auto found = m_buffers.find({buffer, field});
    if (found == m_buffers.end()) {
        found = m_buffers.try_emplace({buffer, field}, hand_on([&] { return m_asked.buffer(buffer, field); })).first;
    }
    return found->second;
}

void HandedOnTable::get_buffer(std::uint32_t buffer, std::uint32_t field, elvis_buffer& out) {
    const BufferInfo& info = buffer_info(buffer, field);
    out.kind = info.kind;
    out.name = info.name.c_str();
    out.element_class = info.element_class;
    out.depends = info.depends;
    out.n_records = info.n_records;
    out.record_size = info.record_size;
    if (info.element_class != ELVIS_ALL_CLASSES) {
        const std::uint64_t n_elements = m_asked.classes().at(info.element_class).n_elements;
        if (info.n_records != n_elements) {
            throw api::Error(ELVIS_ERROR_FAILED, m_asked.path(),
                             "the plugin is at fault: records belong to elements, as it says, but buffer '" + info.name +
                                 "' has " + std::to_string(info.n_records) + " records for " + std::to_string(n_elements) +
                                 " elements");
        }
        out.n_records = m_first_of_class[info.element_class + 1] - m_first_of_class[info.element_class];
    }
}

void HandedOnTable::get_snippet(std::uint32_t element_class, elvis_snippet& out) {
    auto found = m_snippets.find(element_class);
    if (found == m_snippets.end()) {
        ClassSnippet own{hand_on([&] { return m_asked.snippet(element_class); }), {}};
        found = m_snippets.try_emplace(element_class, std::move(own)).first;
        for (const SnippetText& source : found->second.snippet.sources) {
            found->second.sources.push_back(api::text(source.name.c_str(), source.text.c_str()));
        }
    }
    const ClassSnippet& own = found->second;
    out.capabilities = own.snippet.capabilities;
    out.prefix = own.snippet.prefix.c_str();
    out.n_sources = static_cast<std::uint32_t>(own.sources.size());
    out.sources = own.sources.data();
}

elvis_certainty HandedOnTable::get_bounds(std::uint64_t first, std::uint64_t count, std::span<double> bounds) {
    elvis_certainty certainty = ELVIS_CERTIFIED;
    read_runs(first, count, [&](std::uint64_t element, std::uint64_t n, std::uint64_t at) {
        certainty = worse(certainty, m_asked.bounds(element, n, bounds.subspan(6 * at, 6 * n)));
    });
    return certainty;
}

void HandedOnTable::fill_buffer(const elvis_fill_request& request, void* destination) {
    // Known since get_buffer, which comes first: the map does not change here.
    const BufferInfo& info = buffer_info(request.buffer, request.field);
    elvis_fill_request there = request;
    if (info.element_class == ELVIS_ALL_CLASSES) {
        there.origins = nullptr;
        hand_on([&] { m_asked.fill_buffer(there, destination); });
        return;
    }
    const std::uint64_t first_here = m_first_of_class[info.element_class];
    const std::uint64_t first_there = m_asked.classes()[info.element_class].first_element;
    const std::size_t record_bytes =
        info.record_size * (info.kind == ELVIS_BUFFER_REAL ? sizeof(double) : sizeof(std::uint32_t));
    read_runs(first_here + request.first, request.count, [&](std::uint64_t element, std::uint64_t n, std::uint64_t at) {
        there.first = element - first_there;
        there.count = n;
        if (request.origins != nullptr) {
            // The plugin finds element e at 3e: these are the ones of this run, and no others are to be read.
            const auto own = reinterpret_cast<std::uintptr_t>(request.origins + 3 * (first_here + request.first + at));
            there.origins = reinterpret_cast<const double*>(own - 3 * sizeof(double) * element);
        }
        m_asked.fill_buffer(there, static_cast<std::byte*>(destination) + at * record_bytes);
    });
}

void HandedOnTable::get_element_numbers(std::uint64_t first, std::span<std::int64_t> numbers) {
    read_runs(first, numbers.size(), [&](std::uint64_t element, std::uint64_t n, std::uint64_t at) {
        m_asked.element_numbers(element, n, numbers.subspan(at, n));
    });
}

void HandedOnTable::get_faces(std::uint64_t first, api::StructArray<elvis_face> faces) {
    for (std::uint64_t i = 0; i < faces.size(); ++i) {
        faces.set(i, m_faces.at(first + i));
    }
}

elvis_string HandedOnTable::get_boundary_group(std::uint32_t group) { return m_asked.boundary_groups().at(group).c_str(); }

elvis_certainty HandedOnTable::get_field_ranges(std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
                                                std::uint64_t count, std::span<double> ranges) {
    const std::size_t n_components = m_asked.fields().at(field).n_components;
    std::vector<FieldRange> read(count * n_components);
    elvis_certainty certainty = ELVIS_CERTIFIED;
    read_runs(first, count, [&](std::uint64_t element, std::uint64_t n, std::uint64_t at) {
        certainty = worse(certainty, m_asked.field_ranges(field, time_step, element, n,
                                                          std::span(read).subspan(at * n_components, n * n_components)));
    });
    for (std::size_t i = 0; i < read.size(); ++i) {
        ranges[2 * i] = read[i].lower;
        ranges[2 * i + 1] = read[i].upper;
    }
    return certainty;
}

void HandedOnTable::evaluate_mapping(std::uint64_t element, std::span<const double> xi, double* positions, double* jacobians) {
    const std::span<double> x = wanted(positions, xi.size()), dx = wanted(jacobians, 3 * xi.size());
    if (!is_known(element)) {
        std::ranges::fill(x, not_known);
        std::ranges::fill(dx, not_known);
        return;
    }
    hand_on([&] { m_asked.evaluate_mapping(place_there(element), xi, x, dx); });
}

void HandedOnTable::evaluate_field(std::uint32_t field, std::uint32_t time_step, std::uint64_t element,
                                   std::span<const double> xi, double* values, double* gradients) {
    const std::size_t n_values = m_asked.fields().at(field).n_components * xi.size() / 3;
    const std::span<double> u = wanted(values, n_values), du = wanted(gradients, 3 * n_values);
    if (!is_known(element)) {
        std::ranges::fill(u, not_known);
        std::ranges::fill(du, not_known);
        return;
    }
    hand_on([&] { m_asked.evaluate_field(field, time_step, place_there(element), xi, u, du); });
}

elvis_certainty HandedOnTable::get_field_derivative_bounds(std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
                                                           std::uint64_t count, std::span<double> bounds) {
    return bound_derivatives(&elvis::RuntimeVolume::derivative_bounds, field, time_step, first, count, bounds);
}

elvis_certainty HandedOnTable::get_field_apex_bounds(std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
                                                     std::uint64_t count, std::span<double> bounds) {
    return bound_derivatives(&elvis::RuntimeVolume::apex_bounds, field, time_step, first, count, bounds);
}

elvis_certainty HandedOnTable::bound_derivatives(DerivativeBounder bounder, std::uint32_t field, std::uint32_t time_step,
                                                 std::uint64_t first, std::uint64_t count, std::span<double> bounds) const {
    const std::size_t n_components = m_asked.fields().at(field).n_components;
    std::vector<DerivativeBounds> read(count * n_components);
    elvis_certainty certainty = ELVIS_CERTIFIED;
    read_runs(first, count, [&](std::uint64_t element, std::uint64_t n, std::uint64_t at) {
        certainty = worse(certainty, (m_asked.*bounder)(field, time_step, element, n,
                                                        std::span(read).subspan(at * n_components, n * n_components)));
    });
    for (std::size_t i = 0; i < read.size(); ++i) {
        bounds[2 * i] = read[i].first;
        bounds[2 * i + 1] = read[i].second;
    }
    return certainty;
}

elvis_certainty HandedOnTable::check_jacobians(std::uint64_t first, double tolerance,
                                               api::StructArray<elvis_jacobian_check> checks) {
    std::vector<JacobianCheck> read(checks.size());
    elvis_certainty certainty = ELVIS_CERTIFIED;
    read_runs(first, read.size(), [&](std::uint64_t element, std::uint64_t n, std::uint64_t at) {
        certainty = worse(certainty, m_asked.check_jacobians(element, tolerance, std::span(read).subspan(at, n)));
    });
    for (std::size_t i = 0; i < read.size(); ++i) {
        const JacobianCheck& from = read[i];
        checks.set(
            i, {sizeof(elvis_jacobian_check), from.sign, {from.xi[0], from.xi[1], from.xi[2]}, from.determinant, from.lower});
    }
    return certainty;
}

} // namespace elvis
