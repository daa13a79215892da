#include <core/vulkan/device_choice.hpp>

#include <core/base/error.hpp>
#include <core/base/host.hpp>
#include <core/vulkan/instance.hpp>
#include <core/vulkan/vulkan_library.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <regex>

namespace elvis {

namespace {

/** Lower is better. */
std::size_t type_rank(const std::string& type) {
    constexpr std::array<const char*, 4> order{"discrete", "integrated", "virtual", "cpu"};
    return static_cast<std::size_t>(std::find(order.begin(), order.end(), type) - order.begin());
}

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::string without_dashes(std::string text) {
    std::erase(text, '-');
    return text;
}

/** "; the devices are: 0 NVIDIA ... (PCI 0000:01:00.0, UUID ...), 1 llvmpipe ..." for messages. */
std::string list_text(const std::vector<DeviceSummary>& devices) {
    std::string text = "; the devices are: ";
    for (const auto& device : devices) {
        text += (device.index == 0 ? "" : ", ") + std::to_string(device.index) + " " + device.name;
        const std::string pci = device.pci_bus_id.empty() ? "" : "PCI " + device.pci_bus_id;
        const std::string uuid = device.uuid.empty() ? "" : "UUID " + device.uuid;
        if (!pci.empty() || !uuid.empty()) {
            text += " (" + pci + (!pci.empty() && !uuid.empty() ? ", " : "") + uuid + ")";
        }
        if (!device.unusable_because.empty()) {
            text += " (unusable: " + device.unusable_because + ")";
        }
    }
    return text;
}

bool serves(const DeviceSummary& device, DeviceUse use) {
    return device.unusable_because.empty() || (use == DeviceUse::compiling && device.only_compiles);
}

/** The first for which `is_meant` holds, one that serves before one that does not; none: null. */
template <class Meant>
const DeviceSummary* find_device(const std::vector<DeviceSummary>& devices, DeviceUse use, const Meant& is_meant) {
    const DeviceSummary* found = nullptr;
    for (const DeviceSummary& device : devices) {
        if (is_meant(device) && (found == nullptr || (!serves(*found, use) && serves(device, use)))) {
            found = &device;
        }
    }
    return found;
}

/** Null if there is none; `what` says then what is missing. */
const DeviceSummary* find_named(const std::vector<DeviceSummary>& devices, DeviceUse use, const std::string& wanted,
                                std::string& what) {
    static const std::regex pci_pattern("([0-9a-f]{4,8}:)?[0-9a-f]{2}:[0-9a-f]{2}\\.[0-7]");
    static const std::regex uuid_pattern("[0-9a-f]{32}");
    const std::string name = lower_case(wanted), plain = without_dashes(name);
    if (std::regex_match(plain, uuid_pattern)) {
        what = "device of this UUID";
        return find_device(devices, use, [&](const DeviceSummary& device) { return without_dashes(device.uuid) == plain; });
    }
    if (std::regex_match(name, pci_pattern)) {
        const std::string with_domain = name.find(':') == 2 ? "0000:" + name : name;
        what = "device at this PCI bus id";
        return find_device(devices, use, [&](const DeviceSummary& device) { return device.pci_bus_id == with_domain; });
    }
    what = "such device";
    std::uint32_t index = 0;
    const auto [end, failure] = std::from_chars(name.data(), name.data() + name.size(), index);
    if (failure == std::errc() && end == name.data() + name.size()) {
        return find_device(devices, use, [&](const DeviceSummary& device) { return device.index == index; });
    }
    return find_device(devices, use,
                       [&](const DeviceSummary& device) { return lower_case(device.name).find(name) != std::string::npos; });
}

} // namespace

DeviceSummary choose_among(const std::vector<DeviceSummary>& devices, const std::string& wanted, DeviceUse use) {
    if (devices.empty()) {
        throw Error("Vulkan", why_no_devices());
    }
    std::string name = wanted;
    std::string place = "device '" + wanted + "'";
    if (name.empty()) {
        name = environment_variable("ELVIS_DEVICE").value_or("");
        place = "$ELVIS_DEVICE '" + name + "'";
    }
    if (name.empty()) {
        // One that draws, whatever it is for: where hardware is stood in for, that is said.
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
    std::string what;
    const DeviceSummary* found = find_named(devices, use, name, what);
    if (found == nullptr) {
        throw Error(place, "there is no " + what + list_text(devices));
    }
    if (!serves(*found, use)) {
        throw Error(place, "it cannot be used: " + found->unusable_because + list_text(devices));
    }
    return *found;
}

std::vector<std::string> named_devices(const std::string& list) {
    const std::vector<DeviceSummary> devices = list_devices();
    std::vector<std::string> indices;
    if (list == "all") {
        const std::string type = choose_among(devices, {}).type;
        for (const DeviceSummary& device : devices) {
            if (device.unusable_because.empty() && device.type == type) {
                indices.push_back(std::to_string(device.index));
            }
        }
        return indices;
    }
    for (std::size_t first = 0; first <= list.size();) {
        const std::size_t end = std::min(list.find(',', first), list.size());
        const std::string name = list.substr(first, end - first);
        if (name.empty()) {
            throw Error("devices '" + list + "'", "is neither 'all' nor a list of names, with ',' between them");
        }
        indices.push_back(std::to_string(choose_among(devices, name).index));
        first = end + 1;
    }
    return indices;
}

std::vector<DeviceSummary> list_devices() { return Instance(false).summaries(); }

DeviceSummary choose_device(const std::string& wanted) { return choose_among(list_devices(), wanted); }

} // namespace elvis
