#include <core/vulkan/device_summary.hpp>

#include <core/vulkan/compute_device.hpp>

#include <core/vulkan/instance.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <span>
#include <vector>

namespace elvis {

namespace {

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

/** Empty for zeros, which drivers give that have none. */
std::string uuid_text(std::span<const std::uint8_t, VK_UUID_SIZE> uuid) {
    if (std::ranges::all_of(uuid, [](std::uint8_t byte) { return byte == 0; })) {
        return {};
    }
    std::string text;
    for (std::size_t i = 0; i < uuid.size(); ++i) {
        std::array<char, 4> digits{};
        std::snprintf(digits.data(), digits.size(), "%02x", static_cast<unsigned>(uuid[i]));
        if (i == 4 || i == 6 || i == 8 || i == 10) {
            text += '-';
        }
        text += digits.data();
    }
    return text;
}

/** Empty if the driver does not say. */
std::string pci_bus_id(VkPhysicalDevice device) {
    if (!has_extension(device, VK_EXT_PCI_BUS_INFO_EXTENSION_NAME)) {
        return {};
    }
    VkPhysicalDevicePCIBusInfoPropertiesEXT bus{};
    bus.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PCI_BUS_INFO_PROPERTIES_EXT;
    VkPhysicalDeviceProperties2 all{};
    all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    all.pNext = &bus;
    vkGetPhysicalDeviceProperties2(device, &all);
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%04x:%02x:%02x.%x", bus.pciDomain, bus.pciBus, bus.pciDevice, bus.pciFunction);
    return text.data();
}

} // namespace

bool has_extension(VkPhysicalDevice device, const char* name) {
    std::uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data());
    return std::ranges::any_of(
        extensions, [&](const VkExtensionProperties& extension) { return std::strcmp(extension.extensionName, name) == 0; });
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
        VkPhysicalDeviceIDProperties ids{};
        ids.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES;
        VkPhysicalDeviceDriverProperties driver{};
        driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
        driver.pNext = &ids;
        VkPhysicalDeviceProperties2 all{};
        all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
        all.pNext = &driver;
        vkGetPhysicalDeviceProperties2(device, &all);
        summary.driver = std::string(driver.driverName) + " " + driver.driverInfo;
        summary.uuid = uuid_text(ids.deviceUUID);
    }

    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(device, &memory);
    summary.only_compiles = memory.memoryTypeCount == 0;
    if (!summary.only_compiles) {
        summary.pci_bus_id = pci_bus_id(device);
    }
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
    } else if (summary.only_compiles) {
        summary.unusable_because = "it only compiles: its driver stands in for hardware that is not there, and has no memory";
    }
    return summary;
}

} // namespace elvis
