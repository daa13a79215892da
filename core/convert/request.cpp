#include <core/convert/request.hpp>

#include <core/base/error.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/unknown_file.hpp>

#include <memory>

namespace elvis {

namespace {

std::shared_ptr<const Plugin> converter_of(const PluginRegistry& registry, const ConvertRequest& request) {
    if (!request.plugin.empty()) {
        return registry.find(request.plugin);
    }
    try {
        return registry.converter_for(request.inputs.front());
    } catch (const Error& error) {
        throw unknown_file(registry, request.inputs.front(), error);
    }
}

} // namespace

ConvertReport convert(const ConvertRequest& request, const TaskControl& control, Team* team) {
    control.progress(-1, "finding the plugin");
    const PluginRegistry registry;
    const std::shared_ptr<const Plugin> plugin = converter_of(registry, request);
    control.progress(-1, "opening the files");
    const SourceVolume source(plugin, request.inputs, request.plugin_options, &control);
    OneProcess alone;
    return convert(source, request.output, request.options, control, team != nullptr ? *team : static_cast<Team&>(alone));
}

} // namespace elvis
