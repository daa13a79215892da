#include <core/plugin_host/selection_table.hpp>

#include <core/base/error.hpp>

#include <algorithm>
#include <cstdint>

namespace elvis {

namespace {

constexpr std::uint64_t faces_at_once = 65536;

/** What the whole throws, as plugins do: it has named plugin and function. */
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

[[noreturn]] const elvis::RuntimeVolume& no_file(const std::string& path) {
    throw api::Error(ELVIS_ERROR_UNSUPPORTED, path, "a selection of elements is no file");
}

} // namespace

SelectionTable::SelectionTable(const api::Host& host, const std::string& path, const std::string&)
    : SelectionTable(host, no_file(path), {}, SelectedFaces::none) {}

SelectionTable::SelectionTable(const api::Host& host, const elvis::RuntimeVolume& whole, std::vector<std::uint64_t> elements,
                               SelectedFaces faces)
    : RuntimeVolume(host), m_whole(whole), m_elements(std::move(elements)) {
    for (const ClassInfo& info : whole.classes()) {
        const auto first = std::ranges::lower_bound(m_elements, info.first_element);
        m_first_of_class.push_back(static_cast<std::uint64_t>(first - m_elements.begin()));
    }
    m_first_of_class.push_back(m_elements.size());
    if (faces == SelectedFaces::of_elements) {
        hand_on([this] { read_faces(); });
    }
}

/** Calls read(first element of the whole, count, first of what is asked for) for elements that follow each other there, too. */
template <class Read> void SelectionTable::for_each_run(std::uint64_t first, std::uint64_t count, Read read) const {
    hand_on([&] {
        for (std::uint64_t done = 0; done < count;) {
            std::uint64_t n = 1;
            while (done + n < count && m_elements[first + done + n] == m_elements[first + done] + n) {
                ++n;
            }
            read(m_elements[first + done], n, done);
            done += n;
        }
    });
}

std::int64_t SelectionTable::position(std::int64_t element) const {
    if (element < 0) {
        return element;
    }
    const auto found = std::ranges::lower_bound(m_elements, static_cast<std::uint64_t>(element));
    const bool is_there = found != m_elements.end() && *found == static_cast<std::uint64_t>(element);
    return is_there ? found - m_elements.begin() : std::int64_t{ELVIS_NEIGHBOUR_UNKNOWN};
}

void SelectionTable::read_faces() {
    std::vector<elvis_face> read;
    for (std::uint64_t first = 0; first < m_whole.n_faces(); first += faces_at_once) {
        host().check_cancelled();
        read.resize(std::min(faces_at_once, m_whole.n_faces() - first));
        m_whole.faces(first, read.size(), read);
        for (elvis_face face : read) {
            const bool has_neighbour = face.neighbour >= 0;
            face.element = position(face.element);
            face.neighbour = position(face.neighbour);
            if (face.element < 0 && has_neighbour && face.neighbour >= 0) {
                std::swap(face.element, face.neighbour);
                std::swap(face.local_face, face.neighbour_local_face);
            }
            if (face.element < 0) {
                continue;
            }
            face.neighbour_local_face = face.neighbour < 0 ? -1 : face.neighbour_local_face;
            m_faces.push_back(face);
        }
    }
}

void SelectionTable::get_info(elvis_volume_info& info) {
    info.dimension = m_whole.dimension();
    info.n_elements = m_elements.size();
    info.n_faces = m_faces.size();
    info.n_classes = static_cast<std::uint32_t>(m_whole.classes().size());
    info.n_boundary_groups = static_cast<std::uint32_t>(m_whole.boundary_groups().size());
    info.n_fields = static_cast<std::uint32_t>(m_whole.fields().size());
    info.n_time_steps = static_cast<std::uint32_t>(m_whole.times().size());
    info.n_buffers = m_whole.n_buffers();
}

void SelectionTable::get_class(std::uint32_t element_class, elvis_element_class& out) {
    const ClassInfo& info = m_whole.classes().at(element_class);
    out.shape = info.shape;
    out.n_elements = m_first_of_class[element_class + 1] - m_first_of_class[element_class];
    std::ranges::copy(info.geometry_order, out.geometry_order);
    out.is_affine = info.is_affine ? 1 : 0;
}

void SelectionTable::get_field(std::uint32_t field, elvis_field& out) {
    const FieldInfo& info = m_whole.fields().at(field);
    out.n_components = info.n_components;
    out.name = info.name.c_str();
    out.unit = info.unit.empty() ? nullptr : info.unit.c_str();
    out.continuity = info.continuity;
    out.transform = info.transform;
    out.max_jump = info.max_jump;
}

void SelectionTable::get_class_field(std::uint32_t element_class, std::uint32_t field, elvis_class_field& out) {
    auto found = m_class_fields.find({element_class, field});
    if (found == m_class_fields.end()) {
        ClassField own;
        own.info = hand_on([&] { return m_whole.class_field(element_class, field); });
        found = m_class_fields.try_emplace({element_class, field}, std::move(own)).first;
        for (const auto& [name, value] : found->second.info.constants) {
            found->second.constants.push_back(api::constant(name.c_str(), value));
        }
    }
    out.n_constants = static_cast<std::uint32_t>(found->second.constants.size());
    out.constants = found->second.constants.data();
    std::ranges::copy(found->second.info.order, out.order);
}

double SelectionTable::get_time(std::uint32_t time_step) { return m_whole.times().at(time_step); }

const BufferInfo& SelectionTable::buffer_info(std::uint32_t buffer, std::uint32_t field) {
    auto found = m_buffers.find({buffer, field});
    if (found == m_buffers.end()) {
        found = m_buffers.try_emplace({buffer, field}, hand_on([&] { return m_whole.buffer(buffer, field); })).first;
    }
    return found->second;
}

void SelectionTable::get_buffer(std::uint32_t buffer, std::uint32_t field, elvis_buffer& out) {
    const BufferInfo& info = buffer_info(buffer, field);
    out.kind = info.kind;
    out.name = info.name.c_str();
    out.element_class = info.element_class;
    out.depends = info.depends;
    out.n_records = info.n_records;
    out.record_size = info.record_size;
    if (info.element_class != ELVIS_ALL_CLASSES) {
        const std::uint64_t n_elements = m_whole.classes().at(info.element_class).n_elements;
        if (info.n_records != n_elements) {
            throw api::Error(ELVIS_ERROR_FAILED, m_whole.path(),
                             "the plugin is at fault: records belong to elements, as it says, but buffer '" + info.name +
                                 "' has " + std::to_string(info.n_records) + " records for " + std::to_string(n_elements) +
                                 " elements");
        }
        out.n_records = m_first_of_class[info.element_class + 1] - m_first_of_class[info.element_class];
    }
}

void SelectionTable::get_snippet(std::uint32_t element_class, elvis_snippet& out) {
    auto found = m_snippets.find(element_class);
    if (found == m_snippets.end()) {
        ClassSnippet own{hand_on([&] { return m_whole.snippet(element_class); }), {}};
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

elvis_certainty SelectionTable::get_bounds(std::uint64_t first, std::uint64_t count, std::span<double> bounds) {
    elvis_certainty certainty = ELVIS_CERTIFIED;
    for_each_run(first, count, [&](std::uint64_t element, std::uint64_t n, std::uint64_t at) {
        certainty = worse(certainty, m_whole.bounds(element, n, bounds.subspan(6 * at, 6 * n)));
    });
    return certainty;
}

void SelectionTable::fill_buffer(const elvis_fill_request& asked, void* destination) {
    // Known since get_buffer, which comes first: the map does not change here.
    const BufferInfo& info = buffer_info(asked.buffer, asked.field);
    elvis_fill_request request = asked;
    if (info.element_class == ELVIS_ALL_CLASSES) {
        request.origins = nullptr;
        hand_on([&] { m_whole.fill_buffer(request, destination); });
        return;
    }
    const std::uint64_t first_selected = m_first_of_class[info.element_class];
    const std::uint64_t first_of_whole = m_whole.classes()[info.element_class].first_element;
    const std::size_t record_bytes =
        info.record_size * (info.kind == ELVIS_BUFFER_REAL ? sizeof(double) : sizeof(std::uint32_t));
    for_each_run(first_selected + asked.first, asked.count, [&](std::uint64_t element, std::uint64_t n, std::uint64_t at) {
        request.first = element - first_of_whole;
        request.count = n;
        if (asked.origins != nullptr) {
            // The plugin finds element e at 3e: these are the ones of this run, and no others are to be read.
            const auto own = reinterpret_cast<std::uintptr_t>(asked.origins + 3 * (first_selected + asked.first + at));
            request.origins = reinterpret_cast<const double*>(own - 3 * sizeof(double) * element);
        }
        m_whole.fill_buffer(request, static_cast<std::byte*>(destination) + at * record_bytes);
    });
}

void SelectionTable::get_element_numbers(std::uint64_t first, std::span<std::int64_t> numbers) {
    for_each_run(first, numbers.size(), [&](std::uint64_t element, std::uint64_t n, std::uint64_t at) {
        m_whole.element_numbers(element, n, numbers.subspan(at, n));
    });
}

void SelectionTable::get_faces(std::uint64_t first, api::StructArray<elvis_face> faces) {
    for (std::uint64_t i = 0; i < faces.size(); ++i) {
        faces.set(i, m_faces.at(first + i));
    }
}

elvis_string SelectionTable::get_boundary_group(std::uint32_t group) { return m_whole.boundary_groups().at(group).c_str(); }

elvis_certainty SelectionTable::get_field_ranges(std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
                                                 std::uint64_t count, std::span<double> ranges) {
    const std::size_t n_components = m_whole.fields().at(field).n_components;
    std::vector<FieldRange> read(count * n_components);
    elvis_certainty certainty = ELVIS_CERTIFIED;
    for_each_run(first, count, [&](std::uint64_t element, std::uint64_t n, std::uint64_t at) {
        certainty = worse(certainty, m_whole.field_ranges(field, time_step, element, n,
                                                          std::span(read).subspan(at * n_components, n * n_components)));
    });
    for (std::size_t i = 0; i < read.size(); ++i) {
        ranges[2 * i] = read[i].lower;
        ranges[2 * i + 1] = read[i].upper;
    }
    return certainty;
}

void SelectionTable::evaluate_mapping(std::uint64_t element, std::span<const double> xi, double* positions, double* jacobians) {
    hand_on([&] {
        m_whole.evaluate_mapping(m_elements.at(element), xi, wanted(positions, xi.size()), wanted(jacobians, 3 * xi.size()));
    });
}

void SelectionTable::evaluate_field(std::uint32_t field, std::uint32_t time_step, std::uint64_t element,
                                    std::span<const double> xi, double* values, double* gradients) {
    const std::size_t n_values = m_whole.fields().at(field).n_components * xi.size() / 3;
    hand_on([&] {
        m_whole.evaluate_field(field, time_step, m_elements.at(element), xi, wanted(values, n_values),
                               wanted(gradients, 3 * n_values));
    });
}

elvis_certainty SelectionTable::get_field_derivative_bounds(std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
                                                            std::uint64_t count, std::span<double> bounds) {
    return bound_derivatives(&elvis::RuntimeVolume::derivative_bounds, field, time_step, first, count, bounds);
}

elvis_certainty SelectionTable::get_field_apex_bounds(std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
                                                      std::uint64_t count, std::span<double> bounds) {
    return bound_derivatives(&elvis::RuntimeVolume::apex_bounds, field, time_step, first, count, bounds);
}

elvis_certainty SelectionTable::bound_derivatives(DerivativeBounder bounder, std::uint32_t field, std::uint32_t time_step,
                                                  std::uint64_t first, std::uint64_t count, std::span<double> bounds) const {
    const std::size_t n_components = m_whole.fields().at(field).n_components;
    std::vector<DerivativeBounds> read(count * n_components);
    elvis_certainty certainty = ELVIS_CERTIFIED;
    for_each_run(first, count, [&](std::uint64_t element, std::uint64_t n, std::uint64_t at) {
        certainty = worse(certainty, (m_whole.*bounder)(field, time_step, element, n,
                                                        std::span(read).subspan(at * n_components, n * n_components)));
    });
    for (std::size_t i = 0; i < read.size(); ++i) {
        bounds[2 * i] = read[i].first;
        bounds[2 * i + 1] = read[i].second;
    }
    return certainty;
}

elvis_certainty SelectionTable::check_jacobians(std::uint64_t first, double tolerance,
                                                api::StructArray<elvis_jacobian_check> checks) {
    std::vector<JacobianCheck> read(checks.size());
    elvis_certainty certainty = ELVIS_CERTIFIED;
    for_each_run(first, read.size(), [&](std::uint64_t element, std::uint64_t n, std::uint64_t at) {
        certainty = worse(certainty, m_whole.check_jacobians(element, tolerance, std::span(read).subspan(at, n)));
    });
    for (std::size_t i = 0; i < read.size(); ++i) {
        const JacobianCheck& from = read[i];
        checks.set(
            i, {sizeof(elvis_jacobian_check), from.sign, {from.xi[0], from.xi[1], from.xi[2]}, from.determinant, from.lower});
    }
    return certainty;
}

} // namespace elvis
