#include <core/base/float_rounding.hpp>
#include <core/volume/derivative_bounds.hpp>
#include <core/volume/device_volume.hpp>
#include <core/volume/element_records.hpp>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstring>
#include <limits>

namespace elvis {

namespace {

/** Numbers fetched from the plugin at once: bounded host memory, whatever the volume's size. */
constexpr std::uint64_t block_numbers = 4u << 20;

using Clock = std::chrono::steady_clock;
double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

} // namespace

DeviceVolume::DeviceVolume(const Device& device, const RuntimeVolume& volume, Precision precision, const TaskControl* control)
    : m_device(device), m_volume(volume), m_precision(precision), m_control(control), m_buffers(volume.n_buffers()) {
    read_bounds();
}

bool DeviceVolume::has_capability(std::uint32_t element_class, std::uint32_t capability) const {
    // A buffer for all classes follows the first one.
    const std::size_t index = element_class == ELVIS_ALL_CLASSES ? 0 : element_class;
    return (m_classes[index].snippet.capabilities & capability) != 0;
}

void DeviceVolume::read_bounds() {
    const Clock::time_point start = Clock::now();
    const std::uint64_t n_elements = m_volume.n_elements();
    std::vector<double> boxes(6 * n_elements);
    constexpr std::uint64_t block = block_numbers / 64;
    for (std::uint64_t first = 0; first < n_elements; first += block) {
        if (m_control) {
            m_control->check();
        }
        const std::uint64_t count = std::min(block, n_elements - first);
        m_volume.bounds(first, count, std::span<double>(boxes).subspan(6 * first, 6 * count));
    }
    std::fill_n(m_bounds.begin(), 3, std::numeric_limits<double>::infinity());
    std::fill_n(m_bounds.begin() + 3, 3, -std::numeric_limits<double>::infinity());
    m_origins.resize(3 * n_elements);
    for (std::uint64_t element = 0; element < n_elements; ++element) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double lower = boxes[6 * element + axis], upper = boxes[6 * element + 3 + axis];
            m_bounds[axis] = std::min(m_bounds[axis], lower);
            m_bounds[axis + 3] = std::max(m_bounds[axis + 3], upper);
            m_origins[3 * element + axis] = exact_in_float(0.5 * (lower + upper));
        }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        m_centre[axis] = exact_in_float(0.5 * (m_bounds[axis] + m_bounds[axis + 3]));
    }
    for (std::uint32_t element_class = 0; element_class < m_volume.classes().size(); ++element_class) {
        build_class(element_class, boxes);
    }
    m_hierarchy_milliseconds = milliseconds_since(start);
}

void DeviceVolume::build_class(std::uint32_t element_class, const std::vector<double>& boxes) {
    const ClassInfo& info = m_volume.classes()[element_class];
    ClassData data;
    data.snippet = m_volume.snippet(element_class);
    if (info.n_elements > 0) {
        const Hierarchy hierarchy(std::span<const double>(boxes).subspan(6 * info.first_element, 6 * info.n_elements),
                                  m_centre);
        const std::span<const HierarchyNode> nodes = hierarchy.nodes();
        data.nodes = std::make_unique<RecordBuffer>(m_device, RecordKind::uint, m_precision, nodes.size(), 8);
        std::vector<std::uint32_t> words(8 * nodes.size());
        std::memcpy(words.data(), nodes.data(), nodes.size_bytes());
        data.nodes->write_uints(0, words);

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

bool DeviceVolume::select(std::uint32_t field, std::uint32_t time_step, const std::vector<double>& offset) {
    const Clock::time_point start = Clock::now();
    bool can_subtract = true;
    for (const ClassData& data : m_classes) {
        can_subtract = can_subtract && (data.snippet.capabilities & ELVIS_SNIPPET_FIELD_OFFSET) != 0;
    }
    const std::vector<double> new_offset = can_subtract ? offset : std::vector<double>(offset.size(), 0.0);
    if (field != m_field || time_step != m_time_step || new_offset != m_offset) {
        for (ClassData& data : m_classes) {
            data.derivative_bounds.reset();
        }
    }
    m_offset = new_offset;
    m_field = field;
    m_time_step = time_step;
    bool is_changed = false;
    bool is_geometry_changed = false;
    for (std::uint32_t index = 0; index < m_buffers.size(); ++index) {
        PluginBuffer& buffer = m_buffers[index];
        const bool depends_on_field = (buffer.info.depends & ELVIS_DEPENDS_ON_FIELD) != 0;
        const bool depends_on_time = (buffer.info.depends & ELVIS_DEPENDS_ON_TIME) != 0;
        const bool is_stale = !buffer.records || (depends_on_field && (buffer.field != field || buffer.offset != m_offset)) ||
                              (depends_on_time && buffer.time_step != time_step);
        if (is_stale) {
            fill(index, buffer);
            is_changed = true;
            is_geometry_changed = is_geometry_changed || (buffer.info.depends & ELVIS_DEPENDS_ON_FIELD) == 0;
        }
    }
    if (is_geometry_changed || !m_has_elements) {
        for (std::uint32_t element_class = 0; element_class < m_classes.size(); ++element_class) {
            if (m_classes[element_class].elements) {
                write_elements(m_device, m_volume, element_class, instance(element_class), m_precision,
                               *m_classes[element_class].elements);
            }
        }
        m_has_elements = true;
    }
    m_upload_milliseconds = is_changed ? milliseconds_since(start) : m_upload_milliseconds;
    return is_changed;
}

void DeviceVolume::fill(std::uint32_t index, PluginBuffer& buffer) {
    buffer.records.reset();
    buffer.info = m_volume.buffer(index, m_field);
    buffer.field = m_field;
    buffer.time_step = m_time_step;
    buffer.offset = m_offset;
    const BufferInfo& info = buffer.info;
    const bool is_real = info.kind == ELVIS_BUFFER_REAL;
    buffer.records = std::make_unique<RecordBuffer>(m_device, is_real ? RecordKind::real : RecordKind::uint, m_precision,
                                                    info.n_records, info.record_size);
    elvis_fill_request request{};
    request.struct_size = sizeof request;
    request.buffer = index;
    request.field = m_field;
    request.time_step = m_time_step;
    request.field_offset = m_offset.data();
    request.origins = has_capability(info.element_class, ELVIS_SNIPPET_LOCAL_ORIGIN) ? m_origins.data() : nullptr;
    const std::uint64_t block = std::max<std::uint64_t>(1, block_numbers / info.record_size);
    std::vector<double> reals;
    std::vector<std::uint32_t> uints;
    for (request.first = 0; request.first < info.n_records; request.first += block) {
        if (m_control) {
            m_control->check();
        }
        request.count = std::min(block, info.n_records - request.first);
        if (is_real) {
            reals.resize(request.count * info.record_size);
            m_volume.fill_buffer(request, reals.data());
            buffer.records->write_reals(request.first, reals);
        } else {
            uints.resize(request.count * info.record_size);
            m_volume.fill_buffer(request, uints.data());
            buffer.records->write_uints(request.first, uints);
        }
    }
}

SnippetInstance DeviceVolume::instance(std::uint32_t element_class) const {
    SnippetInstance instance;
    instance.snippet = m_classes[element_class].snippet;
    instance.shape = m_volume.classes()[element_class].shape;
    instance.n_components = m_volume.fields()[m_field].n_components;
    instance.constants = m_volume.class_field(element_class, m_field).constants;
    for (const PluginBuffer& buffer : m_buffers) {
        if (buffer.records && (buffer.info.element_class == element_class || buffer.info.element_class == ELVIS_ALL_CLASSES)) {
            instance.buffers.push_back({buffer.info.name, buffer.records.get()});
        }
    }
    instance.origins = m_classes[element_class].origins.get();
    return instance;
}

std::vector<FetchBuffer> DeviceVolume::host_buffers(std::uint32_t element_class) const {
    return {{"core_nodes", m_classes[element_class].nodes.get()}, {"core_elements", m_classes[element_class].elements.get()}};
}

void DeviceVolume::provide_derivative_bounds() {
    for (std::uint32_t index = 0; index < m_classes.size(); ++index) {
        if (!m_classes[index].derivative_bounds && m_volume.classes()[index].n_elements > 0) {
            m_classes[index].derivative_bounds = make_derivative_bounds(
                m_device, m_volume, index, {m_field, m_time_step, m_offset}, instance(index), m_precision, m_control);
        }
    }
}

FetchBuffer DeviceVolume::derivative_bounds(std::uint32_t element_class) const {
    assert(m_classes[element_class].derivative_bounds);
    return {"core_bounds", m_classes[element_class].derivative_bounds.get()};
}

std::uint64_t DeviceVolume::field_bytes() const {
    std::uint64_t sum = 0;
    for (const ClassData& data : m_classes) {
        sum += data.derivative_bounds ? data.derivative_bounds->bytes() : 0;
    }
    for (const PluginBuffer& buffer : m_buffers) {
        sum += buffer.records && (buffer.info.depends & ELVIS_DEPENDS_ON_FIELD) ? buffer.records->bytes() : 0;
    }
    return sum;
}

std::uint64_t DeviceVolume::geometry_bytes() const {
    std::uint64_t sum = 0;
    for (const PluginBuffer& buffer : m_buffers) {
        sum += buffer.records && !(buffer.info.depends & ELVIS_DEPENDS_ON_FIELD) ? buffer.records->bytes() : 0;
    }
    return sum;
}

std::uint64_t DeviceVolume::hierarchy_bytes() const {
    std::uint64_t sum = 0;
    for (const ClassData& data : m_classes) {
        for (const auto* records : {&data.nodes, &data.origins, &data.elements}) {
            sum += *records ? (*records)->bytes() : 0;
        }
    }
    return sum;
}

} // namespace elvis
