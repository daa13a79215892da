/**
 * @file device_class.hpp
 * One element class with one field on the device in double precision, for probing.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/shader/composer.hpp>

#include <memory>
#include <string>
#include <vector>

namespace elvis {

class DeviceClass {
public:
    /** Uploads what the snippet reads of this class, field and time step. Positions are in world coordinates. */
    DeviceClass(const Device& device, const RuntimeVolume& volume, std::uint32_t element_class, std::uint32_t field,
                std::uint32_t time_step);

    /**
     * Runs a kernel with two storage buffers, input and output, over n_items invocations in groups of 32; its push constants
     * end with n_items (uint).
     */
    void run(const std::string& kernel, std::span<const std::byte> parameters, const Buffer& input, const Buffer& output,
             std::uint32_t n_items) const;

private:
    const Device* m_device;
    std::string m_name;
    SnippetInstance m_instance;
    std::vector<std::unique_ptr<RecordBuffer>> m_buffers;
};

} // namespace elvis
