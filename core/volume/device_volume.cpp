#include <core/base/float_rounding.hpp>
#include <core/base/in_parts.hpp>
#include <core/base/milliseconds.hpp>
#include <core/base/vector3.hpp>
#include <core/expression/glsl.hpp>
#include <core/volume/device_volume.hpp>
#include <core/volume/element/element_records.hpp>
#include <core/volume/field/derivative_bounds.hpp>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace elvis {

namespace {

/** Numbers that a thread fetches from the plugin at once (2 MiB): bounded host memory, whatever the volume's size, and not more
 * than processors keep at hand. */
constexpr std::uint64_t block_numbers = 1u << 18;
/** Elements whose bounds a thread fetches at once. */
constexpr std::uint64_t block_elements = 16384;

using Clock = std::chrono::steady_clock;

/** Throws Cancelled if either is to stop. */
void check_tasks(const Device& device, const TaskControl* control) {
    if (control) {
        control->check();
    }
    device.check_task();
}

/** Relative to the middle of the volume. `origins`: of the class's elements, three numbers each; none if positions are the
 * world's. */
ElementBoxes said_boxes(const Hierarchy& hierarchy, std::uint64_t n_elements, std::span<const double> origins,
                        const Vector3& centre) {
    ElementBoxes said;
    said.boxes.resize(6 * n_elements);
    said.origins.resize(3 * n_elements);
    for (const HierarchyNode& node : hierarchy.nodes()) {
        for (std::size_t axis = 0; node.is_leaf() && axis < 3; ++axis) {
            said.boxes[6 * std::size_t{node.child} + axis] = node.lower[axis];
            said.boxes[6 * std::size_t{node.child} + axis + 3] = node.upper[axis];
        }
    }
    for (std::size_t index = 0; index < said.origins.size(); ++index) {
        said.origins[index] = static_cast<float>((origins.empty() ? 0.0 : origins[index]) - centre[index % 3]);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        said.world_origin[axis] = static_cast<float>(-centre[axis]);
    }
    return said;
}

} // namespace

FieldSelection selection_of(const std::shared_ptr<const Expression>& expression, const RuntimeVolume& volume,
                            std::uint32_t time_step) {
    FieldSelection selection{{}, time_step, expression, false};
    std::vector<std::uint32_t> fields = expression->fields();
    if (fields.empty()) {
        fields.push_back(0);
    }
    for (const std::uint32_t field : fields) {
        selection.slots.push_back({field, std::vector<double>(volume.fields()[field].n_components, 0.0)});
    }
    return selection;
}

DeviceVolume::DeviceVolume(const Device& device, const RuntimeVolume& volume, Precision precision, const TaskControl* control,
                           const std::optional<std::array<double, 6>>& bounds_of_whole)
    : m_device(device), m_volume(volume), m_precision(precision), m_control(control), m_buffers(volume.n_buffers()) {
    read_bounds(bounds_of_whole);
}

bool DeviceVolume::has_capability(std::uint32_t element_class, std::uint32_t capability) const {
    // A buffer for all classes follows the first one.
    const std::size_t index = element_class == ELVIS_ALL_CLASSES ? 0 : element_class;
    return (m_classes[index].snippet.capabilities & capability) != 0;
}

void DeviceVolume::read_bounds(const std::optional<std::array<double, 6>>& bounds_of_whole) {
    const Clock::time_point start = Clock::now();
    const std::uint64_t n_elements = m_volume.n_elements();
    m_boxes.resize(6 * n_elements);
    in_parts(
        m_device.background(), n_elements, block_elements,
        [&](std::uint64_t first, std::uint64_t count) {
            m_volume.bounds(first, count, std::span<double>(m_boxes).subspan(6 * first, 6 * count));
        },
        [&] { check_tasks(m_device, m_control); });
    std::fill_n(m_bounds.begin(), 3, std::numeric_limits<double>::infinity());
    std::fill_n(m_bounds.begin() + 3, 3, -std::numeric_limits<double>::infinity());
    m_origins.resize(3 * n_elements);
    for (std::uint64_t element = 0; element < n_elements; ++element) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double lower = m_boxes[6 * element + axis], upper = m_boxes[6 * element + 3 + axis];
            m_bounds[axis] = std::min(m_bounds[axis], lower);
            m_bounds[axis + 3] = std::max(m_bounds[axis + 3], upper);
            m_origins[3 * element + axis] = exact_in_float(0.5 * (lower + upper));
        }
    }
    m_bounds = bounds_of_whole.value_or(m_bounds);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        m_centre[axis] = exact_in_float(0.5 * (m_bounds[axis] + m_bounds[axis + 3]));
    }
    for (std::uint32_t element_class = 0; element_class < m_volume.classes().size(); ++element_class) {
        build_class(element_class);
    }
    m_hierarchy_milliseconds = milliseconds_since(start);
}

void DeviceVolume::build_class(std::uint32_t element_class) {
    const ClassInfo& info = m_volume.classes()[element_class];
    ClassData data;
    data.snippet = m_volume.snippet(element_class);
    if (info.n_elements > 0) {
        data.hierarchy =
            Hierarchy(std::span<const double>(m_boxes).subspan(6 * info.first_element, 6 * info.n_elements), m_centre);
        const std::span<const HierarchyNode> nodes = data.hierarchy.nodes();
        data.nodes = std::make_unique<RecordBuffer>(m_device, RecordKind::uint, m_precision, nodes.size(), node_size);
        data.nodes->write_uints(0, node_words(nodes));

        const bool is_local = (data.snippet.capabilities & ELVIS_SNIPPET_LOCAL_ORIGIN) != 0;
        if (is_local) {
            data.origins = std::make_unique<RecordBuffer>(m_device, RecordKind::real, m_precision, info.n_elements, 3);
            data.origins->write_reals(0,
                                      std::span<const double>(m_origins).subspan(3 * info.first_element, 3 * info.n_elements));
        }
        data.elements =
            std::make_unique<RecordBuffer>(m_device, RecordKind::uint, m_precision, info.n_elements, element_record_size);
    }
    m_classes.push_back(std::move(data));
}

std::vector<double> DeviceVolume::possible_offset(const std::vector<double>& offset) const {
    const bool can_subtract = std::all_of(m_classes.begin(), m_classes.end(), [](const ClassData& data) {
        return (data.snippet.capabilities & ELVIS_SNIPPET_FIELD_OFFSET) != 0;
    });
    return can_subtract ? offset : std::vector<double>(offset.size(), 0.0);
}

bool DeviceVolume::is_slot(const Slot& slot, const FieldSlot& wanted) const {
    return slot.field == wanted.field && slot.offset == possible_offset(wanted.offset);
}

void DeviceVolume::keep(std::span<const FieldSelection> selections) {
    const auto is_unused = [&](const std::unique_ptr<Slot>& slot) {
        return std::none_of(selections.begin(), selections.end(), [&](const FieldSelection& selection) {
            return std::any_of(selection.slots.begin(), selection.slots.end(),
                               [&](const FieldSlot& wanted) { return is_slot(*slot, wanted); });
        });
    };
    std::erase_if(m_slots, is_unused);
    m_selected.clear();
}

void DeviceVolume::forget_fields(std::optional<std::uint32_t> only) {
    for (const std::unique_ptr<Slot>& slot : m_slots) {
        if (only && slot->field != *only) {
            continue;
        }
        for (PluginBuffer& buffer : slot->buffers) {
            buffer.is_filled = false;
        }
        slot->derivative_bounds.clear();
    }
}

void DeviceVolume::exclude_overlaps() {
    assert(m_boxes.size() == 6 * m_volume.n_elements());
    double largest = 0;
    for (std::size_t at = 0; at < m_boxes.size(); at += 6) {
        largest = std::max(largest, std::hypot(m_boxes[at + 3] - m_boxes[at], m_boxes[at + 4] - m_boxes[at + 1],
                                               m_boxes[at + 5] - m_boxes[at + 2]));
    }
    m_overlap_length = static_cast<float>(largest);
}

float DeviceVolume::overlap_length() const {
    const bool has_moved =
        m_geometry_version > 1 || std::ranges::any_of(m_buffers, [](const PluginBuffer& buffer) {
            return (buffer.info.depends & ELVIS_DEPENDS_ON_FIELD) == 0 && (buffer.info.depends & ELVIS_DEPENDS_ON_TIME) != 0;
        });
    return m_overlap_length && !has_moved ? *m_overlap_length : std::numeric_limits<float>::max();
}

void DeviceVolume::select(std::uint32_t field, std::uint32_t time_step, const std::vector<double>& offset) {
    const FieldSelection selection{{{field, offset}}, time_step, nullptr, false};
    keep(std::span(&selection, 1));
    select(selection);
}

void DeviceVolume::select(const FieldSelection& selection) {
    assert(!selection.slots.empty());
    const Clock::time_point start = Clock::now();
    m_boxes = {};
    m_time_step = selection.time_step;
    m_expression = selection.expression;
    m_is_own_boundary = selection.is_own_boundary;
    m_selected.clear();
    bool is_changed = false;
    for (const FieldSlot& wanted : selection.slots) {
        auto found = std::find_if(m_slots.begin(), m_slots.end(),
                                  [&](const std::unique_ptr<Slot>& slot) { return is_slot(*slot, wanted); });
        if (found == m_slots.end()) {
            found = m_slots.insert(m_slots.end(), std::make_unique<Slot>());
        }
        is_changed = provide(wanted, **found) || is_changed;
        m_selected.push_back(found->get());
    }
    // If this is cancelled, what follows from the geometry is still to be made.
    bool is_geometry_changed = !std::exchange(m_has_elements, false);
    for (std::uint32_t index = 0; index < m_buffers.size(); ++index) {
        PluginBuffer& buffer = m_buffers[index];
        buffer.info = m_volume.buffer(index, slot(0).field);
        if ((buffer.info.depends & ELVIS_DEPENDS_ON_FIELD) == 0) {
            is_geometry_changed = provide(index, slot(0), buffer) || is_geometry_changed;
        }
    }
    if (is_geometry_changed) {
        write_elements();
        ++m_geometry_version;
    }
    m_has_elements = true;
    m_upload_milliseconds = is_changed || is_geometry_changed ? milliseconds_since(start) : m_upload_milliseconds;
}

void DeviceVolume::write_elements() {
    std::vector<std::unique_ptr<ElementWriter>> writers(m_classes.size());
    for (std::uint32_t element_class = 0; element_class < m_classes.size(); ++element_class) {
        if (m_classes[element_class].elements) {
            writers[element_class] =
                std::make_unique<ElementWriter>(m_device, m_volume, element_class, instance(element_class), m_precision);
        }
    }
    KernelResults started;
    for (const std::unique_ptr<ElementWriter>& writer : writers) {
        if (writer) {
            writer->start(started);
        }
    }
    started.read();
    for (std::uint32_t element_class = 0; element_class < m_classes.size(); ++element_class) {
        if (!writers[element_class]) {
            continue;
        }
        ClassData& data = m_classes[element_class];
        const ClassInfo& info = m_volume.classes()[element_class];
        const std::size_t n_origins = data.origins ? 3 * info.n_elements : 0;
        const ElementBoxes said =
            said_boxes(data.hierarchy, info.n_elements,
                       std::span<const double>(m_origins).subspan(3 * info.first_element, n_origins), m_centre);
        ElementCurvatures curvatures = writers[element_class]->write(said, *data.elements, started);
        data.curvature_records.write(m_device, m_precision, curvatures);
        data.curvatures = std::move(curvatures.numbers);
    }
}

/** Fills what the slot lacks; returns whether there was something. */
bool DeviceVolume::provide(const FieldSlot& wanted, Slot& slot) {
    slot.field = wanted.field;
    slot.offset = possible_offset(wanted.offset);
    slot.buffers.resize(m_buffers.size());
    slot.derivative_bounds.resize(m_classes.size());
    bool is_changed = false;
    for (std::uint32_t index = 0; index < m_buffers.size(); ++index) {
        slot.buffers[index].info = m_volume.buffer(index, slot.field);
        if ((slot.buffers[index].info.depends & ELVIS_DEPENDS_ON_FIELD) != 0) {
            is_changed = provide(index, slot, slot.buffers[index]) || is_changed;
        }
    }
    return is_changed;
}

bool DeviceVolume::provide(std::uint32_t index, const Slot& slot, PluginBuffer& buffer) {
    const bool depends_on_time = (buffer.info.depends & ELVIS_DEPENDS_ON_TIME) != 0;
    const bool is_stale = !buffer.is_filled || (depends_on_time && buffer.time_step != m_time_step);
    if (is_stale) {
        fill(index, slot, buffer);
    }
    return is_stale;
}

void DeviceVolume::fill(std::uint32_t index, const Slot& slot, PluginBuffer& buffer) {
    const BufferInfo& info = buffer.info;
    const bool is_real = info.kind == ELVIS_BUFFER_REAL;
    // Another time step takes the same room: kernels composed with the buffer stay valid.
    if (!buffer.records) {
        buffer.records = std::make_unique<RecordBuffer>(m_device, is_real ? RecordKind::real : RecordKind::uint, m_precision,
                                                        info.n_records, info.record_size);
    }
    buffer.is_filled = false;
    elvis_fill_request all{};
    all.struct_size = sizeof all;
    all.buffer = index;
    all.field = slot.field;
    all.time_step = m_time_step;
    all.field_offset = slot.offset.data();
    all.origins = has_capability(info.element_class, ELVIS_SNIPPET_LOCAL_ORIGIN) ? m_origins.data() : nullptr;
    const auto fill_part = [&](std::uint64_t first, std::uint64_t count) {
        elvis_fill_request request = all;
        request.first = first;
        request.count = count;
        if (is_real) {
            std::vector<double> reals(count * info.record_size);
            m_volume.fill_buffer(request, reals.data());
            buffer.records->write_reals(first, reals);
        } else {
            std::vector<std::uint32_t> uints(count * info.record_size);
            m_volume.fill_buffer(request, uints.data());
            buffer.records->write_uints(first, uints);
        }
    };
    in_parts(m_device.background(), info.n_records, std::max<std::uint64_t>(1, block_numbers / info.record_size), fill_part,
             [&] { check_tasks(m_device, m_control); });
    buffer.time_step = m_time_step;
    buffer.is_filled = true;
}

Vector3 DeviceVolume::origin(std::uint64_t element) const {
    for (std::uint32_t index = 0; index < m_classes.size(); ++index) {
        const ClassInfo& info = m_volume.classes()[index];
        if (element < info.first_element + info.n_elements) {
            return m_classes[index].origins
                       ? std::array{m_origins[3 * element], m_origins[3 * element + 1], m_origins[3 * element + 2]}
                       : std::array{0.0, 0.0, 0.0};
        }
    }
    return {};
}

SnippetInstance DeviceVolume::instance(std::uint32_t element_class, std::size_t index) const {
    const Slot& of = slot(index);
    SnippetInstance instance;
    instance.snippet = m_classes[element_class].snippet;
    instance.shape = m_volume.classes()[element_class].shape;
    instance.n_components = m_volume.fields()[of.field].n_components;
    instance.constants = m_volume.class_field(element_class, of.field).constants;
    for (std::size_t i = 0; i < m_buffers.size(); ++i) {
        const PluginBuffer& buffer = m_buffers[i].records ? m_buffers[i] : of.buffers[i];
        if (buffer.records && (buffer.info.element_class == element_class || buffer.info.element_class == ELVIS_ALL_CLASSES)) {
            instance.buffers.push_back({buffer.info.name, buffer.records.get()});
        }
    }
    instance.origins = m_classes[element_class].origins.get();
    return instance;
}

ExpressionClass DeviceVolume::about_class(std::uint32_t element_class) const {
    ExpressionClass about = expression_class(m_volume, element_class);
    for (const Slot* of : m_selected) {
        about.offsets.push_back(of->offset);
    }
    return about;
}

void DeviceVolume::add_field(KernelRequest& request, std::uint32_t element_class, bool with_bounds) const {
    request.instances.clear();
    for (std::size_t index = 0; index < m_selected.size(); ++index) {
        request.instances.push_back(instance(element_class, index));
        if (with_bounds) {
            request.buffers.push_back(derivative_bounds(element_class, index));
        }
    }
    const auto add_once = [&](const FetchBuffer& wanted) {
        const auto is_it = [&](const FetchBuffer& buffer) { return buffer.name == wanted.name; };
        if (std::ranges::none_of(request.buffers, is_it)) {
            request.buffers.push_back(wanted);
        }
    };
    if (with_bounds) {
        std::ranges::for_each(curvature_records(element_class).buffers(), add_once);
        std::ranges::for_each(curvature_records(element_class).forms(), add_once);
    }
    if (m_is_own_boundary) {
        request.text = "#include \"field/own_boundary.glsl\"\n";
    }
    if (m_expression) {
        // For the element's number.
        add_once(elements(element_class));
        const ExpressionClass info = about_class(element_class);
        request.text = value_glsl(*m_expression, info);
        if (with_bounds) {
            request.text += model_glsl(*m_expression, info);
        }
        request.with_second_derivatives =
            m_expression->needs_second_derivatives() || (with_bounds && m_expression->gradient_needs_second_derivatives());
    }
}

FetchBuffer DeviceVolume::elements(std::uint32_t element_class) const {
    return {"core_elements", m_classes[element_class].elements.get()};
}

std::pair<std::string, std::string> DeviceVolume::strongly_bent_define(std::uint32_t element_class) const {
    const bool is_bent = std::ranges::any_of(m_classes[element_class].curvatures,
                                             [](float curvature) { return curvature > most_measured_curvature; });
    return {"CORE_STRONGLY_BENT", is_bent ? "1" : "0"};
}

std::vector<FetchBuffer> DeviceVolume::host_buffers(std::uint32_t element_class) const {
    return {{"core_nodes", m_classes[element_class].nodes.get()}, elements(element_class)};
}

void DeviceVolume::provide_derivative_bounds() {
    for (std::size_t index = 0; index < m_selected.size(); ++index) {
        Slot& of = *m_selected[index];
        for (std::uint32_t element_class = 0; element_class < m_classes.size(); ++element_class) {
            std::unique_ptr<RecordBuffer>& bounds = of.derivative_bounds[element_class];
            if ((!bounds || of.bounds_time_step != m_time_step) && m_volume.classes()[element_class].n_elements > 0) {
                bounds = make_derivative_bounds(m_device, m_volume, element_class, {of.field, m_time_step, of.offset},
                                                instance(element_class, index), m_precision, m_control);
            }
        }
        of.bounds_time_step = m_time_step;
    }
}

FetchBuffer DeviceVolume::derivative_bounds(std::uint32_t element_class, std::size_t index) const {
    assert(slot(index).derivative_bounds[element_class]);
    std::string name = "core_bounds";
    if (index > 0) {
        name.append("_").append(std::to_string(index));
    }
    return {name, slot(index).derivative_bounds[element_class].get()};
}

std::uint64_t DeviceVolume::field_bytes() const {
    std::uint64_t sum = 0;
    for (const std::unique_ptr<Slot>& slot : m_slots) {
        for (const PluginBuffer& buffer : slot->buffers) {
            sum += buffer.records ? buffer.records->bytes() : 0;
        }
        for (const std::unique_ptr<RecordBuffer>& bounds : slot->derivative_bounds) {
            sum += bounds ? bounds->bytes() : 0;
        }
    }
    return sum;
}

std::uint64_t DeviceVolume::geometry_bytes() const {
    std::uint64_t sum = 0;
    for (const PluginBuffer& buffer : m_buffers) {
        sum += buffer.records ? buffer.records->bytes() : 0;
    }
    return sum;
}

std::uint64_t DeviceVolume::hierarchy_bytes() const {
    std::uint64_t sum = 0;
    for (const ClassData& data : m_classes) {
        for (const auto* records : {&data.nodes, &data.origins, &data.elements}) {
            sum += *records ? (*records)->bytes() : 0;
        }
        sum += data.curvature_records.bytes();
    }
    return sum;
}

} // namespace elvis
