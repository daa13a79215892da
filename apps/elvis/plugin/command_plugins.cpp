#include <apps/elvis/commands.hpp>

#include <core/plugin_host/plugin.hpp>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace elvis::commands {

namespace {

std::string capabilities(const Plugin& plugin) {
    return plugin.runtime() && plugin.converter() ? "runtime, converter" : plugin.runtime() ? "runtime" : "converter";
}

void print_json(const PluginRegistry& registry) {
    nlohmann::ordered_json root;
    root["plugins"] = nlohmann::ordered_json::array();
    for (const auto& plugin : registry.plugins()) {
        nlohmann::ordered_json interfaces = nlohmann::ordered_json::array();
        if (plugin->runtime()) {
            interfaces.push_back(ELVIS_RUNTIME_INTERFACE);
        }
        if (plugin->converter()) {
            interfaces.push_back(ELVIS_CONVERTER_INTERFACE);
        }
        nlohmann::ordered_json formats = nlohmann::ordered_json::array();
        for (const FileFormat& format : plugin->formats()) {
            formats.push_back({{"name", format.name}, {"endings", format.endings}});
        }
        root["plugins"].push_back({{"id", plugin->id()},
                                   {"name", plugin->name()},
                                   {"version", plugin->version()},
                                   {"vendor", plugin->vendor()},
                                   {"description", plugin->description()},
                                   {"abi_version", abi_version_text(plugin->abi_version())},
                                   {"interfaces", interfaces},
                                   {"formats", formats},
                                   {"library", plugin->library().string()}});
    }
    root["refused"] = nlohmann::ordered_json::array();
    for (const RefusedPlugin& refused : registry.refused()) {
        root["refused"].push_back({{"library", refused.library.string()}, {"reason", refused.reason}});
    }
    std::printf("%s\n", root.dump(2).c_str());
}

/** "*.nek5000, *.f#####": '#' is a digit. */
std::string endings_text(const FileFormat& format) {
    std::string text;
    for (const std::string& ending : format.endings) {
        text += (text.empty() ? "*" : ", *") + ending;
    }
    return text.empty() ? "any name" : text;
}

void print_table(const PluginRegistry& registry) {
    for (const auto& plugin : registry.plugins()) {
        std::printf("%s %s (%s)\n", plugin->id().c_str(), plugin->version().c_str(), capabilities(*plugin).c_str());
        const std::string vendor = plugin->vendor().empty() ? "" : ", by " + plugin->vendor();
        std::printf("    %s%s, plugin interface %s\n", plugin->name().c_str(), vendor.c_str(),
                    abi_version_text(plugin->abi_version()).c_str());
        if (!plugin->description().empty()) {
            std::printf("    %s\n", plugin->description().c_str());
        }
        for (const FileFormat& format : plugin->formats()) {
            std::printf("    reads %s: %s\n", format.name.c_str(), endings_text(format).c_str());
        }
        std::printf("    %s\n", plugin->library().c_str());
    }
    for (const RefusedPlugin& refused : registry.refused()) {
        std::printf("refused: %s\n    %s\n", refused.library.c_str(), refused.reason.c_str());
    }
    if (registry.plugins().empty() && registry.refused().empty()) {
        std::printf("no plugins found in:\n");
        for (const auto& folder : PluginRegistry::search_path()) {
            std::printf("    %s\n", folder.c_str());
        }
    }
}

} // namespace

void add_plugins(CLI::App& app) {
    CLI::App* command = app.add_subcommand("plugins", "List the plugins found, and those refused with the reason");
    auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "Answer in JSON");
    command->callback([json] {
        const PluginRegistry registry;
        *json ? print_json(registry) : print_table(registry);
    });
}

} // namespace elvis::commands
