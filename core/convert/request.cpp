#include <core/convert/request.hpp>

#include <core/plugin_host/plugin.hpp>

#include <memory>

namespace elvis {

ConvertReport convert(const ConvertRequest& request, const TaskControl& control,
                      const std::function<void(const std::string& id)>& on_plugin) {
    control.progress(-1, "finding the plugin");
    const PluginRegistry registry;
    const std::shared_ptr<const Plugin> plugin =
        request.plugin.empty() ? registry.converter_for(request.inputs.front()) : registry.find(request.plugin);
    if (on_plugin) {
        on_plugin(plugin->id());
    }
    control.progress(-1, "opening the files");
    const SourceVolume source(plugin, request.inputs, request.plugin_options, &control);
    return convert(source, request.output, request.options, control);
}

} // namespace elvis
