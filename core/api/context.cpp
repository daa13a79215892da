#include "call.hpp"

#include <core/base/log.hpp>
#include <core/plugin_host/unknown_file.hpp>
#include <core/vulkan/device_choice.hpp>
#include <core/vulkan/memory/memory_limit.hpp>

#include <iterator>

namespace elvis::library {

namespace {

nlohmann::ordered_json plugin_json(const Plugin& plugin) {
    nlohmann::ordered_json kinds = nlohmann::ordered_json::array();
    if (plugin.runtime() != nullptr) {
        kinds.push_back("runtime");
    }
    if (plugin.converter() != nullptr) {
        kinds.push_back("converter");
    }
    nlohmann::ordered_json formats = nlohmann::ordered_json::array();
    for (const FileFormat& format : plugin.formats()) {
        formats.push_back({{"name", format.name}, {"endings", format.endings}});
    }
    return {{"id", plugin.id()}, {"name", plugin.name()}, {"version", plugin.version()}, {"library", plugin.library().string()},
            {"kinds", kinds},    {"formats", formats}};
}

/** What elvis_context_describe_file says. */
nlohmann::ordered_json file_json(const PluginRegistry& plugins, const std::string& path) {
    if (is_scene(path)) {
        return {{"kind", "scene"}, {"plugin", ""}};
    }
    std::shared_ptr<const Plugin> plugin;
    try {
        plugin = plugins.runtime_for(path);
    } catch (const Error&) {
        try {
            return {{"kind", "foreign"}, {"plugin", plugins.converter_for(path)->id()}};
        } catch (const Error& error) {
            throw unknown_file(plugins, path, error);
        }
    }
    return {{"kind", "volume"}, {"plugin", plugin->id()}};
}

} // namespace

Context::Context(const elvis_context_options& options)
    : wanted_device(text_or_empty(options.device)), is_validated((options.flags & ELVIS_CONTEXT_VALIDATION) != 0) {
    host.reads_environment = (options.flags & ELVIS_CONTEXT_NO_ENVIRONMENT) == 0;
    if (options.log != nullptr) {
        host.log = [log = options.log, user = options.user](LogLevel level, std::string_view line) {
            log(user, static_cast<elvis_log_level>(level), std::string(line).c_str());
        };
    }
    if (options.cache_folder != nullptr) {
        host.cache_folder = options.cache_folder;
    }
    if (options.plugin_path != nullptr) {
        host.plugin_folders = split_folders(options.plugin_path);
    }
    const HostScope scope(host);
    if ((options.flags & ELVIS_CONTEXT_SEVERAL_DEVICES) != 0) {
        const std::vector<std::string> devices = named_devices(wanted_device);
        wanted_device = devices.front();
        m_wanted_others.assign(devices.begin() + 1, devices.end());
    }
    plugins.emplace();
}

Context::~Context() {
    // The device writes its cache when it goes.
    const HostScope scope(host);
    m_others.clear();
    m_device.reset();
    plugins.reset();
}

const Device& Context::device() {
    const std::lock_guard lock(m_mutex);
    if (!m_device) {
        m_device.emplace(wanted_device, is_validated);
        limit_process_memory(*m_device, m_most_bytes);
        log_debug("device: {}", m_device->summary().name);
    }
    return *m_device;
}

const std::vector<std::unique_ptr<Device>>& Context::other_devices() {
    const std::lock_guard lock(m_mutex);
    for (std::size_t i = m_others.size(); i < m_wanted_others.size(); ++i) {
        m_others.push_back(std::make_unique<Device>(m_wanted_others[i], is_validated));
        limit_process_memory(*m_others.back(), m_most_bytes);
        log_debug("device: {}", m_others.back()->summary().name);
    }
    return m_others;
}

void Context::limit_memory(std::uint64_t bytes) {
    const std::lock_guard lock(m_mutex);
    m_most_bytes = bytes;
    if (m_device) {
        limit_process_memory(*m_device, bytes);
    }
    for (const auto& other : m_others) {
        limit_process_memory(*other, bytes);
    }
}

void Context::forget_kernels() {
    const std::lock_guard lock(m_mutex);
    if (m_device) {
        forget_pipelines(*m_device);
    }
    for (const auto& other : m_others) {
        forget_pipelines(*other);
    }
}

} // namespace elvis::library

using namespace elvis;
using namespace elvis::library;

uint32_t elvis_library_version(void) { return ELVIS_LIBRARY_VERSION; }

elvis_result elvis_context_create(const elvis_context_options* options, elvis_context** context) {
    try {
        need(context, "context");
        *context = nullptr;
        elvis_context_options known{};
        if (options != nullptr) {
            known = known_part(options, "options");
        }
        *context = new elvis_context{std::make_shared<Context>(known)};
        return ELVIS_OK;
    } catch (...) {
        return result_of_exception(nullptr);
    }
}

void elvis_context_release(elvis_context* context) { delete context; }

elvis_string elvis_context_error(const elvis_context* context) {
    return error_of(context != nullptr ? context->state.get() : nullptr);
}

elvis_result elvis_context_list_devices(elvis_context* context, char** text) {
    return call(context, [&] {
        need(text, "text");
        nlohmann::ordered_json list = nlohmann::ordered_json::array();
        for (const DeviceSummary& device : list_devices()) {
            list.push_back({{"index", device.index},
                            {"name", device.name},
                            {"type", device.type},
                            {"driver", device.driver},
                            {"memory_bytes", device.memory_bytes},
                            {"float64", device.has_float64},
                            {"unusable_because", device.unusable_because}});
        }
        *text = text_for_caller(list.dump(2));
    });
}

elvis_result elvis_context_describe_device(elvis_context* context, char** text) {
    return call(context, [&] {
        need(text, "text");
        const Device& device = context->state->device();
        std::vector<std::string> messages = device.validation_messages();
        nlohmann::ordered_json others = nlohmann::ordered_json::array();
        for (const auto& other : context->state->other_devices()) {
            others.push_back(other->summary().name);
            std::ranges::move(other->validation_messages(), std::back_inserter(messages));
        }
        const nlohmann::ordered_json root = {{"name", device.summary().name},     {"type", device.summary().type},
                                             {"driver", device.summary().driver}, {"allocated_bytes", device.allocated_bytes()},
                                             {"n_buffers", device.n_buffers()},   {"n_kernels", device.n_kernels()},
                                             {"validation_messages", messages},   {"others", others}};
        *text = text_for_caller(root.dump(2));
    });
}

elvis_result elvis_context_describe_file(elvis_context* context, elvis_string path, char** text) {
    return call(context, [&] {
        need(path, "path");
        need(text, "text");
        *text = text_for_caller(file_json(*context->state->plugins, path).dump());
    });
}

elvis_result elvis_context_list_plugins(elvis_context* context, char** text) {
    return call(context, [&] {
        need(text, "text");
        nlohmann::ordered_json root = {{"plugins", nlohmann::ordered_json::array()},
                                       {"refused", nlohmann::ordered_json::array()}};
        for (const auto& plugin : context->state->plugins->plugins()) {
            root["plugins"].push_back(plugin_json(*plugin));
        }
        for (const RefusedPlugin& refused : context->state->plugins->refused()) {
            root["refused"].push_back({{"library", refused.library.string()}, {"reason", refused.reason}});
        }
        *text = text_for_caller(root.dump(2));
    });
}
