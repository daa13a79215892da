#include <core/conformance/check.hpp>

#include <core/base/error.hpp>
#include <core/plugin_host/host_services.hpp>

namespace elvis::conformance {

namespace {

using Probe = elvis_result (*)(const elvis_host*, const char*, std::uint32_t*);

bool claims(const Plugin& plugin, Probe probe, const std::string& path) {
    const HostServices services(plugin.id(), nullptr);
    std::uint32_t confidence = 0;
    return probe(services.table(), path.c_str(), &confidence) == ELVIS_OK && confidence > 0;
}

} // namespace

const std::shared_ptr<const Plugin>& Context::plugin() {
    if (!m_plugin) {
        try {
            m_plugin = Plugin::load(m_subject.library);
        } catch (const Error& error) {
            throw Skipped("the library does not load: see the check 'descriptor'");
        }
    }
    return m_plugin;
}

void Context::need_files() const {
    if (m_subject.files.empty()) {
        throw Skipped("needs a file: --volume FILE");
    }
}

bool Context::claims_runtime() {
    return plugin()->runtime() && !m_subject.files.empty() &&
           claims(*plugin(), plugin()->runtime()->probe, m_subject.files.front());
}

bool Context::claims_source() {
    return plugin()->converter() && !m_subject.files.empty() &&
           claims(*plugin(), plugin()->converter()->probe, m_subject.files.front());
}

void Context::need_runtime_volume() {
    if (!plugin()->runtime()) {
        throw NotApplicable("the plugin serves no volumes for rendering");
    }
    need_files();
    if (!claims_runtime()) {
        throw Skipped("the runtime interface does not claim " + m_subject.files.front());
    }
}

RuntimeVolume open_volume(Context& context) {
    context.need_runtime_volume();
    context.progress("open");
    return RuntimeVolume(context.plugin(), context.subject().files.front(), context.subject().options);
}

void Context::need_source() {
    if (!plugin()->converter()) {
        throw NotApplicable("the plugin converts no files");
    }
    need_files();
    if (!claims_source()) {
        throw Skipped("the converter interface does not claim " + m_subject.files.front());
    }
}

const std::vector<Check>& all_checks() {
    static const std::vector<Check> checks = [] {
        std::vector<Check> all;
        for (const auto group : {library_checks, file_checks, table_checks, volume_checks, geometry_checks, order_checks,
                                 device_checks, own_shape_checks, behaviour_checks, source_checks}) {
            const std::vector<Check> some = group();
            all.insert(all.end(), some.begin(), some.end());
        }
        return all;
    }();
    return checks;
}

} // namespace elvis::conformance
