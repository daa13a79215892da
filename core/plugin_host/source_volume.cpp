#include <core/base/error.hpp>
#include <core/plugin_host/host_services.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/source_volume.hpp>
#include <core/plugin_host/table_copy.hpp>
#include <elvis/native/space.hpp>

#include <cassert>
#include <cmath>

namespace elvis {

namespace {

constexpr std::uint32_t max_order = 30;

} // namespace

struct SourceVolume::Impl {
    std::shared_ptr<const Plugin> plugin;
    const elvis_converter* table = nullptr;
    std::unique_ptr<HostServices> services;
    std::vector<std::string> paths;
    elvis_source_volume* source = nullptr;
    elvis_source_info info{};
    std::vector<SourceField> fields;
    std::vector<double> times;
    std::vector<std::string> groups;
    std::size_t n_values = 0;
    std::uint32_t n_parts = 0;

    ~Impl() {
        if (source) {
            services->begin("close");
            table->close(source);
            services->check(ELVIS_OK, "close", {});
        }
    }

    void check(elvis_result result, const char* function) const { services->check(result, function, paths.front()); }
    /** Calls a function of the table by its name; throws what comes of it. */
    template <class Function, class... Arguments> void call(const char* name, Function function, Arguments... arguments) const {
        services->begin(name);
        check(function(source, arguments...), name);
    }
    [[noreturn]] void refuse(const char* function, const std::string& what) const {
        services->refuse(function, paths.front(), what);
    }

    void read_description();
    void read_n_parts();
};

void SourceVolume::Impl::read_description() {
    info = sized<elvis_source_info>();
    call("get_info", table->get_info, &info);
    if (info.dimension != 2 && info.dimension != 3) {
        refuse("get_info", "dimension " + std::to_string(info.dimension));
    }
    if (info.n_elements == 0) {
        throw Error(paths.front(), "holds no elements");
    }
    if (info.n_time_steps == 0) {
        refuse("get_info", "no time step");
    }
    if (info.n_fields > 4096 || info.n_time_steps > 10000000 || info.n_boundary_groups > 1000000) {
        refuse("get_info", "an absurd number of fields, time steps or boundary groups");
    }
    for (std::uint32_t index = 0; index < info.n_fields; ++index) {
        auto field = sized<elvis_source_field>();
        call("get_field", table->get_field, index, &field);
        if (!field.name || !*field.name || field.n_components == 0 || field.n_components > 1024) {
            refuse("get_field", "a field without name or with " + std::to_string(field.n_components) + " components");
        }
        if (field.transform > ELVIS_TRANSFORM_CONTRAVARIANT || field.continuity > ELVIS_CONTINUITY_DISCONTINUOUS) {
            refuse("get_field", "an unknown transform or continuity");
        }
        for (const SourceField& other : fields) {
            if (other.name == field.name) {
                refuse("get_field", "two fields named '" + other.name + "'");
            }
        }
        fields.push_back({field.name, field.unit ? field.unit : "", field.n_components, field.continuity, field.transform});
        n_values += field.n_components;
    }
    times.assign(info.n_time_steps, 0.0);
    if (info.n_time_steps > 1 && !table->get_time) {
        refuse("get_info", "several time steps, but get_time is missing");
    }
    for (std::uint32_t step = 0; table->get_time && step < info.n_time_steps; ++step) {
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
}

void SourceVolume::Impl::read_n_parts() {
    constexpr std::uint32_t most_parts = 1000000;
    if (const elvis_parts* const of_parts = plugin->parts()) {
        call("get_n_parts", of_parts->get_n_parts, &n_parts);
        if (n_parts > most_parts) {
            refuse("get_n_parts", std::to_string(n_parts) + " parts");
        }
    }
}

SourceVolume::SourceVolume(std::shared_ptr<const Plugin> plugin, const std::vector<std::string>& paths,
                           const std::string& options, const TaskControl* control)
    : m_impl(std::make_unique<Impl>()) {
    assert(plugin && !paths.empty());
    m_impl->table = plugin->converter();
    if (!m_impl->table) {
        throw Error(paths.front(), "plugin " + plugin->id() + " converts no files");
    }
    m_impl->services = std::make_unique<HostServices>(plugin->id(), control);
    m_impl->plugin = std::move(plugin);
    m_impl->paths = paths;
    std::vector<const char*> names;
    for (const std::string& path : paths) {
        names.push_back(path.c_str());
    }
    elvis_source_volume* source = nullptr;
    m_impl->services->begin("open");
    m_impl->check(m_impl->table->open(m_impl->services->table(), names.data(), static_cast<std::uint32_t>(names.size()),
                                      options.empty() ? nullptr : options.c_str(), &source),
                  "open");
    if (!source) {
        m_impl->refuse("open", "success and no source");
    }
    m_impl->source = source;
    m_impl->read_description();
    m_impl->read_n_parts();
}

SourceVolume::SourceVolume(std::shared_ptr<const Plugin> plugin, const std::string& name,
                           const std::function<elvis_source_volume*(const elvis_host*)>& open, const TaskControl* control)
    : m_impl(std::make_unique<Impl>()) {
    assert(plugin && plugin->converter());
    m_impl->table = plugin->converter();
    m_impl->services = std::make_unique<HostServices>(plugin->id(), control);
    m_impl->plugin = std::move(plugin);
    m_impl->paths = {name};
    m_impl->source = open(m_impl->services->table());
    m_impl->read_description();
}

SourceVolume::~SourceVolume() = default;
SourceVolume::SourceVolume(SourceVolume&&) noexcept = default;
SourceVolume& SourceVolume::operator=(SourceVolume&&) noexcept = default;

const Plugin& SourceVolume::plugin() const { return *m_impl->plugin; }
const std::vector<std::string>& SourceVolume::paths() const { return m_impl->paths; }
const elvis_source_info& SourceVolume::info() const { return m_impl->info; }
const std::vector<SourceField>& SourceVolume::fields() const { return m_impl->fields; }
const std::vector<double>& SourceVolume::times() const { return m_impl->times; }
const std::vector<std::string>& SourceVolume::boundary_groups() const { return m_impl->groups; }
std::uint32_t SourceVolume::n_parts() const { return m_impl->n_parts; }

void SourceVolume::parts(std::uint64_t first, std::span<std::uint32_t> out) const {
    assert(m_impl->n_parts > 0 && first + out.size() <= m_impl->info.n_elements);
    const elvis_parts& table = *m_impl->plugin->parts();
    m_impl->call("get_parts", table.get_parts, first, std::uint64_t{out.size()}, out.data());
    for (const std::uint32_t part : out) {
        if (part >= m_impl->n_parts) {
            m_impl->refuse("get_parts", "part " + std::to_string(part) + " of " + std::to_string(m_impl->n_parts));
        }
    }
}

std::size_t SourceVolume::n_values() const { return m_impl->n_values; }

void SourceVolume::elements(std::uint64_t first, std::uint64_t count, std::span<elvis_source_element> out) const {
    assert(out.size() == count && first + count <= m_impl->info.n_elements);
    for (elvis_source_element& element : out) {
        element = sized<elvis_source_element>();
    }
    m_impl->call("get_elements", m_impl->table->get_elements, first, count, out.data());
    for (std::uint64_t index = 0; index < count; ++index) {
        const elvis_source_element& element = out[index];
        const std::string which = " for element " + std::to_string(first + index);
        if (element.shape > ELVIS_SHAPE_TRIANGLE ||
            (element.shape >= ELVIS_SHAPE_QUADRILATERAL) != (m_impl->info.dimension == 2)) {
            m_impl->refuse("get_elements", "shape " + std::to_string(element.shape) + which);
        }
        for (std::uint32_t direction = 0; direction < m_impl->info.dimension; ++direction) {
            if (element.geometry_order[direction] < 1 || element.geometry_order[direction] > max_order) {
                m_impl->refuse("get_elements", "geometry order " + std::to_string(element.geometry_order[direction]) + which);
            }
        }
        const native::Shape shape{element.shape};
        for (int corner = 0; m_impl->info.n_corner_ids > 0 && corner < native::n_corners(shape); ++corner) {
            const std::int64_t id = element.corners[corner];
            if (id < 0 || static_cast<std::uint64_t>(id) >= m_impl->info.n_corner_ids) {
                m_impl->refuse("get_elements", "corner id " + std::to_string(id) + which);
            }
        }
        for (int face = 0; face < native::n_faces(shape); ++face) {
            const std::int32_t group = element.face_groups[face];
            if (group < ELVIS_GROUP_NONE || group >= static_cast<std::int32_t>(m_impl->info.n_boundary_groups)) {
                m_impl->refuse("get_elements", "boundary group " + std::to_string(group) + which);
            }
        }
    }
}

void SourceVolume::spaces(std::uint32_t field, std::uint64_t first, std::uint64_t count,
                          std::span<elvis_source_space> out) const {
    assert(out.size() == count && field < m_impl->fields.size());
    for (elvis_source_space& space : out) {
        space = sized<elvis_source_space>();
    }
    m_impl->call("get_spaces", m_impl->table->get_spaces, field, first, count, out.data());
    for (std::uint64_t index = 0; index < count; ++index) {
        for (const std::uint32_t order : out[index].order) {
            if (order > max_order) {
                m_impl->refuse("get_spaces", "order " + std::to_string(order) + " for element " +
                                                 std::to_string(first + index) + " (at most " + std::to_string(max_order) +
                                                 ")");
            }
        }
    }
}

void SourceVolume::evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) const {
    assert(xi.size() % 3 == 0 && positions.size() == xi.size());
    m_impl->call("evaluate_mapping", m_impl->table->evaluate_mapping, element, xi.size() / 3, xi.data(), positions.data());
    for (const double coordinate : positions) {
        if (!std::isfinite(coordinate)) {
            m_impl->refuse("evaluate_mapping", "a position that is not finite in element " + std::to_string(element));
        }
    }
}

void SourceVolume::sample(std::uint32_t time_step, std::uint64_t element, std::span<const double> xi,
                          std::span<double> values) const {
    const std::size_t n_points = xi.size() / 3;
    assert(values.size() == n_points * m_impl->n_values);
    if (m_impl->table->sample) {
        m_impl->call("sample", m_impl->table->sample, time_step, element, n_points, xi.data(), values.data());
        return;
    }
    std::vector<double> positions(xi.size());
    evaluate_mapping(element, xi, positions);
    m_impl->call("sample_world", m_impl->table->sample_world, time_step, element, n_points, positions.data(), values.data());
}

} // namespace elvis
