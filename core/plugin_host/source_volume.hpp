/**
 * @file source_volume.hpp
 * A data set opened by a conversion plugin, seen from the core. Checked like RuntimeVolume.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <elvis/converter.h>

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace elvis {

class Plugin;

struct SourceField {
    std::string name;
    std::string unit;
    std::uint32_t n_components = 1;
    elvis_continuity continuity = ELVIS_CONTINUITY_UNKNOWN;
    elvis_transform transform = ELVIS_TRANSFORM_NONE;
};

class SourceVolume {
public:
    SourceVolume(std::shared_ptr<const Plugin> plugin, const std::vector<std::string>& paths, const std::string& options = {},
                 const TaskControl* control = nullptr);
    /** One that `open` makes with the host's services; it is closed by the plugin's table. */
    SourceVolume(std::shared_ptr<const Plugin> plugin, const std::string& name,
                 const std::function<elvis_source_volume*(const elvis_host*)>& open, const TaskControl* control = nullptr);
    ~SourceVolume();
    SourceVolume(SourceVolume&&) noexcept;
    SourceVolume& operator=(SourceVolume&&) noexcept;

    const Plugin& plugin() const;
    const std::vector<std::string>& paths() const;
    const elvis_source_info& info() const;
    const std::vector<SourceField>& fields() const;
    const std::vector<double>& times() const;
    const std::vector<std::string>& boundary_groups() const;
    /** 0 if the data are in one piece, or the plugin does not tell (elvis/parts.h). */
    std::uint32_t n_parts() const;
    /** Of elements, each below n_parts. */
    void parts(std::uint64_t first, std::span<std::uint32_t> out) const;
    /** Sum of the components of all fields: numbers a point in sample(). */
    std::size_t n_values() const;

    /** Checked: known shape, orders in 1..max, corner ids in range. */
    void elements(std::uint64_t first, std::uint64_t count, std::span<elvis_source_element> out) const;
    void spaces(std::uint32_t field, std::uint64_t first, std::uint64_t count, std::span<elvis_source_space> out) const;
    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) const;
    /** Values of all fields; maps to world positions itself if the plugin can only be asked there. */
    void sample(std::uint32_t time_step, std::uint64_t element, std::span<const double> xi, std::span<double> values) const;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace elvis
