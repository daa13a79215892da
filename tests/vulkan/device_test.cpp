#include <core/base/error.hpp>
#include <core/vulkan/device_choice.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cctype>
#include <cstdlib>

using namespace elvis;
using Catch::Contains;

namespace {

/** Sets a variable while it lives. */
class Variable {
public:
    Variable(const char* name, const char* value) : m_name(name) {
        if (const char* before = std::getenv(name)) {
            m_before = before;
            m_was_set = true;
        }
        setenv(name, value, 1);
    }
    ~Variable() {
        if (m_was_set) {
            setenv(m_name, m_before.c_str(), 1);
        } else {
            unsetenv(m_name);
        }
    }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

private:
    const char* m_name;
    std::string m_before;
    bool m_was_set = false;
};

} // namespace

TEST_CASE("A device is chosen by index, by part of its name and by the environment") {
    const Variable none("ELVIS_DEVICE", "");
    const auto devices = list_devices();
    REQUIRE_FALSE(devices.empty());
    const DeviceSummary best = choose_device("");
    CHECK(choose_device(std::to_string(best.index)).name == best.name);
    std::string part = best.name.substr(1, 5);
    for (char& c : part) {
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    CHECK(choose_device(part).name.find(best.name.substr(1, 5)) != std::string::npos);
    const Variable variable("ELVIS_DEVICE", best.name.c_str());
    CHECK(choose_device("").name == best.name);
    CHECK(Device().summary().name == best.name);
}

TEST_CASE("An unknown device is an error that lists those there are") {
    REQUIRE_FALSE(list_devices().empty());
    const std::string name = list_devices().front().name;
    CHECK_THROWS_WITH(choose_device("no such device"), Contains("no such device") && Contains(name));
    CHECK_THROWS_WITH(choose_device("99"), Contains("99") && Contains(name));
    CHECK_THROWS_WITH(Device("no such device"), Contains(name));
    const Variable variable("ELVIS_DEVICE", "nonsense");
    CHECK_THROWS_WITH(Device(), Contains("$ELVIS_DEVICE 'nonsense'") && Contains(name));
}

TEST_CASE("A device is chosen by UUID, with dashes or without, in any case") {
    const Variable none("ELVIS_DEVICE", "");
    const DeviceSummary best = choose_device("");
    if (best.uuid.empty()) {
        WARN("skipped: the driver of " << best.name << " tells no UUID");
        return;
    }
    CHECK(best.uuid.size() == 36);
    CHECK(Device(best.uuid).summary().index == best.index);
    std::string plain = best.uuid;
    std::erase(plain, '-');
    CHECK(choose_device(plain).index == best.index);
    std::ranges::transform(plain, plain.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    CHECK(choose_device(plain).index == best.index);
    // Another digit is another device.
    plain.back() = plain.back() == '0' ? '1' : '0';
    CHECK_THROWS_WITH(choose_device(plain), Contains("no device of this UUID") && Contains(best.uuid));
}

TEST_CASE("A device is chosen by its PCI bus id") {
    const auto at = [](std::uint32_t index, const char* bus) {
        DeviceSummary device;
        device.index = index;
        device.name = "card";
        device.type = "discrete";
        device.pci_bus_id = bus;
        return device;
    };
    const std::vector<DeviceSummary> twins{at(0, "0000:01:00.0"), at(1, "0000:c1:00.0"), at(2, "0001:01:00.0")};
    CHECK(choose_among(twins, "0000:01:00.0").index == 0);
    CHECK(choose_among(twins, "C1:00.0").index == 1);
    CHECK(choose_among(twins, "01:00.0").index == 0);
    CHECK(choose_among(twins, "0001:01:00.0").index == 2);
    CHECK_THROWS_WITH(choose_among(twins, "0000:02:00.0"),
                      Contains("no device at this PCI bus id") && Contains("0000:c1:00.0"));
    // What is neither an index nor an id is a part of a name.
    CHECK_THROWS_WITH(choose_among(twins, "01:00"), Contains("no such device"));
}

TEST_CASE("Options that mean nothing are errors that name the variable") {
    {
        const Variable variable("ELVIS_DATA_BUFFERS", "images");
        CHECK_THROWS_WITH(Device(), Contains("ELVIS_DATA_BUFFERS") && Contains("images"));
    }
    {
        const Variable variable("ELVIS_MAX_BINDING_BYTES", "12k");
        CHECK_THROWS_WITH(Device(), Contains("ELVIS_MAX_BINDING_BYTES") && Contains("12k"));
    }
    {
        const Variable variable("ELVIS_VALIDATION", "yes");
        CHECK_THROWS_WITH(Device(), Contains("ELVIS_VALIDATION"));
    }
}

TEST_CASE("Data buffers are texel buffers on CPU drivers, storage buffers elsewhere, and can be chosen") {
    const Variable none("ELVIS_DATA_BUFFERS", "");
    const Device device;
    CHECK(device.uses_texel_buffers() == (device.summary().type == "cpu"));
    CHECK(device.max_binding_bytes() >= 128u << 20u);
    const Variable storage("ELVIS_DATA_BUFFERS", "storage");
    const Variable limit("ELVIS_MAX_BINDING_BYTES", "4096");
    const Device other;
    CHECK_FALSE(other.uses_texel_buffers());
    CHECK(other.max_binding_bytes() == 4096);
}

TEST_CASE("The validation layer's messages are kept") {
    DeviceOptions options;
    options.validation = true;
    const Device device(options);
    CHECK(device.validation_messages().empty());
    // A buffer of no bytes: wrong on purpose.
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = 0;
    info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    VkBuffer buffer = VK_NULL_HANDLE;
    vkCreateBuffer(device.handle(), &info, nullptr, &buffer);
    vkDestroyBuffer(device.handle(), buffer, nullptr);
    const auto messages = device.validation_messages();
    REQUIRE(messages.size() == 1);
    CHECK_THAT(messages.front(), Contains("VUID-VkBufferCreateInfo-size"));
}
