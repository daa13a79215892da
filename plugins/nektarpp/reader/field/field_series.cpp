#include "field_series.hpp"

#include <algorithm>
#include <numeric>

namespace nektarpp {

FieldSeries::FieldSeries(const elvis::api::Host& host, std::vector<FieldPaths> steps, const Mesh& mesh, FieldContent content)
    : m_mesh(mesh) {
    bool all_have_time = true;
    for (FieldPaths& paths : steps) {
        host.check_cancelled();
        host.report_progress(static_cast<double>(m_steps.size()) / static_cast<double>(steps.size()), "reading fields");
        // The last file goes before the next is read.
        m_current.reset();
        m_current = std::make_shared<const FieldFile>(paths, mesh, content);
        check_fields(*m_current, paths);
        include_orders(*m_current);
        include_modes(*m_current);
        all_have_time = all_have_time && m_current->time().has_value();
        m_steps.push_back({std::move(paths), m_current->time().value_or(0)});
    }
    m_current_step = m_steps.empty() ? 0 : m_steps.size() - 1;
    if (content != FieldContent::everything) {
        m_current.reset();
    }
    if (m_steps.size() > 1 && all_have_time) {
        const bool is_sorted = std::ranges::is_sorted(m_steps, {}, &Step::time);
        if (!is_sorted) {
            host.log(ELVIS_LOG_INFO, "time steps are put in the order of their times");
            std::ranges::stable_sort(m_steps, {}, &Step::time);
            m_current.reset();
        }
    } else if (m_steps.size() > 1) {
        host.log(ELVIS_LOG_WARNING, "not every file says its time: time steps are numbered as given");
        for (std::size_t index = 0; index < m_steps.size(); ++index) {
            m_steps[index].time = static_cast<double>(index);
        }
    }
}

void FieldSeries::check_fields(const FieldFile& file, const FieldPaths& paths) {
    if (m_fields.empty()) {
        m_fields = file.fields();
        m_orders.assign(m_fields.size(), std::vector<std::array<std::uint8_t, 3>>(m_mesh.elements().size()));
        m_modes.assign(m_fields.size(), std::vector<std::uint16_t>(m_mesh.elements().size(), no_modes));
        return;
    }
    if (file.fields() != m_fields) {
        const auto list = [](const std::vector<std::string>& names) {
            return std::accumulate(names.begin(), names.end(), std::string(),
                                   [](const std::string& text, const std::string& name) { return text + " " + name; });
        };
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, paths.path,
                                "holds the fields" + list(file.fields()) + ", the first time step" + list(m_fields));
    }
}

void FieldSeries::include_orders(const FieldFile& file) {
    for (std::size_t field = 0; field < m_fields.size(); ++field) {
        for (std::uint64_t element = 0; element < m_mesh.elements().size(); ++element) {
            if (const ModeSet* modes = file.modes(field, element)) {
                const std::array<std::uint32_t, 3> order = target_order(*modes);
                for (std::size_t direction = 0; direction < 3; ++direction) {
                    std::uint8_t& most = m_orders[field][element][direction];
                    most = std::max(most, static_cast<std::uint8_t>(order[direction]));
                }
            }
        }
    }
}

void FieldSeries::include_modes(const FieldFile& file) {
    for (std::size_t field = 0; field < m_fields.size(); ++field) {
        const ModeSet* before = nullptr;
        std::uint16_t number_before = no_modes;
        for (std::uint64_t element = 0; element < m_mesh.elements().size(); ++element) {
            const ModeSet* of_file = file.modes(field, element);
            std::uint16_t& number = m_modes[field][element];
            if (!of_file || number == different_bases) {
                continue;
            }
            // Neighbours in the file mostly have the same modes.
            if (number == no_modes && of_file == before) {
                number = number_before;
                continue;
            }
            ModeSet modes = *of_file;
            if (number != no_modes) {
                const ModeSet& known = m_sets[number];
                if (known == modes) {
                    continue;
                }
                if (known.basis != modes.basis || !is_hierarchical(modes.basis)) {
                    number = different_bases;
                    continue;
                }
                std::ranges::transform(known.n_modes, modes.n_modes, modes.n_modes.begin(),
                                       [](std::uint32_t a, std::uint32_t b) { return std::max(a, b); });
            }
            const auto found = std::ranges::find(m_sets, modes);
            if (found == m_sets.end()) {
                if (m_sets.size() == different_bases) {
                    throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, m_mesh.path(), "more than 65534 different sets of modes");
                }
                m_sets.push_back(modes);
                number = static_cast<std::uint16_t>(m_sets.size() - 1);
            } else {
                number = static_cast<std::uint16_t>(found - m_sets.begin());
            }
            if (*of_file == modes) {
                before = of_file;
                number_before = number;
            }
        }
    }
}

const ModeSet* FieldSeries::modes(std::size_t field, std::uint64_t element) const {
    const std::uint16_t number = m_modes[field][element];
    if (number == different_bases) {
        const MeshElement& of_mesh = m_mesh.elements()[element];
        throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, m_steps.front().paths.path,
                                std::string(elvis::native::name(of_mesh.shape)) + " " + std::to_string(of_mesh.id) +
                                    ": field " + m_fields[field] +
                                    " changes its basis from one time step to another, which cannot be drawn as it is. Convert "
                                    "the data instead: elvis convert MESH FIELDS -o volume.h5");
    }
    return number == no_modes ? nullptr : &m_sets[number];
}

elvis_source_space FieldSeries::space(std::size_t field, std::uint64_t element) const {
    elvis_source_space space{};
    space.is_contained = 1;
    for (std::size_t direction = 0; direction < 3; ++direction) {
        const std::uint32_t order = m_orders[field][element][direction];
        space.order[direction] = std::min(order, elvis::native::max_order);
        if (order > elvis::native::max_order) {
            space.is_contained = 0;
        }
    }
    return space;
}

std::shared_ptr<const FieldFile> FieldSeries::step(std::size_t step) {
    const std::lock_guard lock(m_mutex);
    if (!m_current || m_current_step != step) {
        m_current.reset();
        m_current = std::make_shared<const FieldFile>(m_steps[step].paths, m_mesh);
        if (m_current->fields() != m_fields) {
            m_current.reset();
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, m_steps[step].paths.path, "has changed since it was opened");
        }
        m_current_step = step;
    }
    return m_current;
}

} // namespace nektarpp
