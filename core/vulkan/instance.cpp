#include <core/vulkan/instance.hpp>

#include <core/base/error.hpp>
#include <core/base/host.hpp>
#include <core/base/log.hpp>
#include <core/vulkan/check.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdlib>
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

std::string type_name(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return "cpu";
    default:
        return "other";
    }
}

/** Lower is better. */
std::size_t type_rank(const std::string& type) {
    constexpr std::array<const char*, 4> order{"discrete", "integrated", "virtual", "cpu"};
    return static_cast<std::size_t>(std::find(order.begin(), order.end(), type) - order.begin());
}

DeviceSummary summarize(VkPhysicalDevice device, std::uint32_t index) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(device, &properties);
    DeviceSummary summary;
    summary.index = index;
    summary.name = properties.deviceName;
    summary.type = type_name(properties.deviceType);

    // The driver's name came with Vulkan 1.2: asking a device for more than its own version is not allowed.
    if (properties.apiVersion >= VK_API_VERSION_1_2) {
        VkPhysicalDeviceDriverProperties driver{};
        driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
        VkPhysicalDeviceProperties2 all{};
        all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
        all.pNext = &driver;
        vkGetPhysicalDeviceProperties2(device, &all);
        summary.driver = std::string(driver.driverName) + " " + driver.driverInfo;
    }

    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(device, &memory);
    for (std::uint32_t heap = 0; heap < memory.memoryHeapCount; ++heap) {
        if ((memory.memoryHeaps[heap].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0) {
            summary.memory_bytes += memory.memoryHeaps[heap].size;
        }
    }
    VkPhysicalDeviceFeatures features{};
    vkGetPhysicalDeviceFeatures(device, &features);
    summary.has_float64 = features.shaderFloat64 == VK_TRUE;

    if (properties.apiVersion < VK_API_VERSION_1_3) {
        summary.unusable_because = "its driver offers Vulkan " + std::to_string(VK_API_VERSION_MAJOR(properties.apiVersion)) +
                                   "." + std::to_string(VK_API_VERSION_MINOR(properties.apiVersion)) + ", below 1.3";
    } else if (compute_queue_family(device) == UINT32_MAX) {
        summary.unusable_because = "it has no compute queue";
    }
    return summary;
}

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/** "; the devices are: 0 NVIDIA ..., 1 llvmpipe ..." for messages. */
std::string list_text(const std::vector<DeviceSummary>& devices) {
    std::string text = "; the devices are: ";
    for (const auto& device : devices) {
        text += (device.index == 0 ? "" : ", ") + std::to_string(device.index) + " " + device.name;
        if (!device.unusable_because.empty()) {
            text += " (unusable: " + device.unusable_because + ")";
        }
    }
    return text;
}

} // namespace

std::uint32_t compute_queue_family(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    std::uint32_t found = UINT32_MAX;
    for (std::uint32_t family = 0; family < count; ++family) {
        const VkQueueFlags flags = families[family].queueFlags;
        if ((flags & VK_QUEUE_COMPUTE_BIT) == 0) {
            continue;
        }
        if ((flags & VK_QUEUE_GRAPHICS_BIT) == 0) {
            return family;
        }
        found = std::min(found, family);
    }
    return found;
}

Instance::Instance(bool validation, std::span<const char* const> extensions) {
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

DeviceSummary choose_among(const std::vector<DeviceSummary>& devices, const std::string& wanted) {
    if (devices.empty()) {
        throw Error("Vulkan", "this machine has no Vulkan driver; without a GPU, install a driver for the CPU (Debian package "
                              "mesa-vulkan-drivers)");
    }
    std::string name = wanted;
    std::string place = "device '" + wanted + "'";
    if (name.empty()) {
        name = environment_variable("ELVIS_DEVICE").value_or("");
        place = "$ELVIS_DEVICE '" + name + "'";
    }
    if (name.empty()) {
        const DeviceSummary* best = nullptr;
        for (const auto& device : devices) {
            if (device.unusable_because.empty() && (best == nullptr || type_rank(device.type) < type_rank(best->type))) {
                best = &device;
            }
        }
        if (best == nullptr) {
            throw Error("Vulkan", "no device can be used" + list_text(devices));
        }
        return *best;
    }

    const DeviceSummary* found = nullptr;
    std::uint32_t index = 0;
    const auto [end, failure] = std::from_chars(name.data(), name.data() + name.size(), index);
    if (failure == std::errc() && end == name.data() + name.size()) {
        found = index < devices.size() ? &devices[index] : nullptr;
    } else {
        for (const auto& device : devices) {
            // A usable device is preferred over one of the same name that is not.
            if (lower_case(device.name).find(lower_case(name)) != std::string::npos &&
                (found == nullptr || (!found->unusable_because.empty() && device.unusable_because.empty()))) {
                found = &device;
            }
        }
    }
    if (found == nullptr) {
        throw Error(place, "there is no such device" + list_text(devices));
    }
    if (!found->unusable_because.empty()) {
        throw Error(place, "it cannot be used: " + found->unusable_because + list_text(devices));
    }
    return *found;
}

std::vector<DeviceSummary> list_devices() { return Instance(false).summaries(); }

DeviceSummary choose_device(const std::string& wanted) { return choose_among(list_devices(), wanted); }

} // namespace elvis
