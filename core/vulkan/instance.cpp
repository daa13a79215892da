#include <core/vulkan/instance.hpp>

#include <core/base/error.hpp>
#include <core/base/host.hpp>
#include <core/base/log.hpp>
#include <core/vulkan/check.hpp>
#include <core/vulkan/device_summary.hpp>
#include <core/vulkan/vulkan_library.hpp>

#include <algorithm>
#include <cstring>

namespace elvis {

namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

bool has_validation_layer() {
    std::uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    return std::any_of(layers.begin(), layers.end(),
                       [](const VkLayerProperties& layer) { return std::strcmp(layer.layerName, validation_layer) == 0; });
}

VKAPI_ATTR VkBool32 VKAPI_CALL keep_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                            const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    log_warning("Vulkan validation: {}", data->pMessage);
    auto* log = static_cast<ValidationLog*>(user);
    const std::lock_guard lock(log->mutex);
    log->messages.emplace_back(data->pMessage);
    return VK_FALSE;
}

} // namespace

Instance::Instance(bool validation, std::span<const char* const> extensions) {
    if (!vulkan_library().is_there()) {
        return; // An instance without devices.
    }
    if (validation && !has_validation_layer()) {
        throw Error("Vulkan",
                    "the layer VK_LAYER_KHRONOS_validation is not installed (Debian package vulkan-validationlayers)");
    }
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "ElVis";
    application.pEngineName = "ElVis";
    application.apiVersion = VK_API_VERSION_1_3;

    VkDebugUtilsMessengerCreateInfoEXT messenger{};
    messenger.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    // Not the "general" type: with it, the loader reports on other people's drivers and layers.
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    messenger.pfnUserCallback = keep_message;
    messenger.pUserData = &m_log;

    const VkValidationFeatureEnableEXT enabled = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.pNext = &messenger;
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &enabled;

    std::vector<const char*> enabled_extensions(extensions.begin(), extensions.end());
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    if (validation) {
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &validation_layer;
        enabled_extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        enabled_extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    }
    info.enabledExtensionCount = static_cast<std::uint32_t>(enabled_extensions.size());
    info.ppEnabledExtensionNames = enabled_extensions.data();
    const VkResult created = vkCreateInstance(&info, nullptr, &m_instance);
    if (created == VK_ERROR_INCOMPATIBLE_DRIVER) {
        m_instance = VK_NULL_HANDLE; // No driver at all: an instance without devices.
        return;
    }
    check_vulkan(created, "Vulkan", "creating the instance");
    if (validation) {
        const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(m_instance, "vkCreateDebugUtilsMessengerEXT"));
        const VkResult result = create(m_instance, &messenger, nullptr, &m_messenger);
        if (result != VK_SUCCESS) {
            vkDestroyInstance(m_instance, nullptr);
        }
        check_vulkan(result, "Vulkan", "creating the debug messenger");
    }
}

Instance::~Instance() {
    if (m_messenger != VK_NULL_HANDLE) {
        const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(m_instance, "vkDestroyDebugUtilsMessengerEXT"));
        destroy(m_instance, m_messenger, nullptr);
    }
    if (m_instance != VK_NULL_HANDLE) {
        vkDestroyInstance(m_instance, nullptr);
    }
}

std::vector<VkPhysicalDevice> Instance::physical_devices() const {
    if (m_instance == VK_NULL_HANDLE) {
        return {};
    }
    std::uint32_t count = 0;
    vkEnumeratePhysicalDevices(m_instance, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    vkEnumeratePhysicalDevices(m_instance, &count, devices.data());
    devices.resize(count);
    return devices;
}

std::vector<DeviceSummary> Instance::summaries() const {
    std::vector<DeviceSummary> summaries;
    for (const VkPhysicalDevice device : physical_devices()) {
        summaries.push_back(summarize(device, static_cast<std::uint32_t>(summaries.size())));
    }
    return summaries;
}

} // namespace elvis
