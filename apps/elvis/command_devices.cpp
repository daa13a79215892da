#include "commands.hpp"

#include <core/base/error.hpp>
#include <core/vulkan/device.hpp>
#include <core/vulkan/vulkan_library.hpp>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <optional>

namespace elvis::commands {

namespace {

void print_json(const std::vector<DeviceSummary>& devices, std::optional<std::uint32_t> chosen) {
    nlohmann::ordered_json root;
    root["devices"] = nlohmann::ordered_json::array();
    for (const DeviceSummary& device : devices) {
        root["devices"].push_back({{"index", device.index},
                                   {"name", device.name},
                                   {"driver", device.driver},
                                   {"type", device.type},
                                   {"memory_bytes", device.memory_bytes},
                                   {"float64", device.has_float64},
                                   {"pci_bus_id", device.pci_bus_id},
                                   {"uuid", device.uuid},
                                   {"only_compiles", device.only_compiles},
                                   {"usable", device.unusable_because.empty()},
                                   {"unusable_because", device.unusable_because},
                                   {"chosen", device.index == chosen}});
    }
    std::printf("%s\n", root.dump(2).c_str());
}

void print_table(const std::vector<DeviceSummary>& devices, std::optional<std::uint32_t> chosen) {
    if (devices.empty()) {
        std::printf("%s\n", why_no_devices().c_str());
    }
    for (const DeviceSummary& device : devices) {
        std::printf("%c %u  %s  (%s, %s, %.1f GiB, float64: %s)%s%s\n", device.index == chosen ? '*' : ' ', device.index,
                    device.name.c_str(), device.type.c_str(), device.driver.c_str(),
                    static_cast<double>(device.memory_bytes) / (1024.0 * 1024 * 1024), device.has_float64 ? "yes" : "no",
                    device.unusable_because.empty() ? ""
                    : device.only_compiles          ? " compiles only"
                                                    : " cannot be used: ",
                    device.only_compiles ? "" : device.unusable_because.c_str());
        const bool has_bus = !device.pci_bus_id.empty(), has_uuid = !device.uuid.empty();
        if (has_bus || has_uuid) {
            std::printf("     %s%s%s%s%s\n", has_bus ? "PCI " : "", device.pci_bus_id.c_str(), has_bus && has_uuid ? "  " : "",
                        has_uuid ? "UUID " : "", device.uuid.c_str());
        }
    }
}

} // namespace

void add_devices(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("devices", "List Vulkan devices; * marks the one that is used unless told otherwise");
    auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "Answer in JSON");
    command->callback([json] {
        const std::vector<DeviceSummary> devices = list_devices();
        // A choice that fails ($ELVIS_DEVICE names nothing) is told after the list, in which no device is marked then.
        std::optional<std::uint32_t> chosen;
        std::optional<Error> failure;
        if (!devices.empty()) {
            try {
                chosen = choose_device({}).index;
            } catch (const Error& error) {
                failure = error;
            }
        }
        *json ? print_json(devices, chosen) : print_table(devices, chosen);
        if (failure) {
            throw *failure;
        }
    });
}

} // namespace elvis::commands
