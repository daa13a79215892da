#include <core/plugin_host/runtime_volume_impl.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

namespace elvis {

void RuntimeVolume::Impl::read() {
    read_info();
    read_classes();
    read_fields();
    read_texts();
}

void RuntimeVolume::Impl::read_info() {
    info = sized<elvis_volume_info>();
    call("get_info", table->get_info, &info);
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
        call("get_class", table->get_class, index, &theirs);
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
        call("get_field", table->get_field, index, &theirs);
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
                          theirs.max_jump, false});
    }
}

void RuntimeVolume::Impl::read_texts() {
    times.assign(info.n_time_steps, 0.0);
    for (std::uint32_t step = 0; step < info.n_time_steps; ++step) {
        call("get_time", table->get_time, step, &times[step]);
    }
    if (info.n_boundary_groups > 0 && !table->get_boundary_group) {
        refuse("get_info", "boundary groups, but get_boundary_group is missing");
    }
    for (std::uint32_t group = 0; group < info.n_boundary_groups; ++group) {
        elvis_string name = nullptr;
        call("get_boundary_group", table->get_boundary_group, group, &name);
        groups.emplace_back(name ? name : "");
    }
    if (info.n_notes > 0 && !table->get_note) {
        refuse("get_info", "notes, but get_note is missing");
    }
    for (std::uint32_t note = 0; note < info.n_notes; ++note) {
        elvis_string key = nullptr;
        elvis_string value = nullptr;
        call("get_note", table->get_note, note, &key, &value);
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
    m_impl->read();
}

RuntimeVolume::RuntimeVolume(std::shared_ptr<const Plugin> plugin, elvis_volume* volume, const std::string& name)
    : m_impl(std::make_unique<Impl>()) {
    assert(plugin && plugin->runtime());
    m_impl->table = plugin->runtime();
    m_impl->services = std::make_unique<HostServices>(plugin->id(), nullptr);
    m_impl->plugin = std::move(plugin);
    m_impl->path = name;
    m_impl->volume = volume;
    m_impl->is_closed_here = false;
    m_impl->read();
}

RuntimeVolume::RuntimeVolume(std::shared_ptr<const Plugin> plugin, const std::string& name,
                             const std::function<elvis_volume*(const elvis_host*)>& open, const TaskControl* control)
    : m_impl(std::make_unique<Impl>()) {
    assert(plugin && plugin->runtime());
    m_impl->table = plugin->runtime();
    m_impl->services = std::make_unique<HostServices>(plugin->id(), control);
    m_impl->plugin = std::move(plugin);
    m_impl->path = name;
    m_impl->volume = open(m_impl->services->table());
    m_impl->read();
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

const RuntimeVolume* RuntimeVolume::undeformed() const {
    if (!m_impl->undeformed && m_impl->open_undeformed) {
        m_impl->undeformed.emplace(m_impl->open_undeformed());
    }
    return m_impl->undeformed ? &*m_impl->undeformed : nullptr;
}

void RuntimeVolume::set_undeformed(std::function<RuntimeVolume()> open) { m_impl->open_undeformed = std::move(open); }

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

} // namespace elvis
