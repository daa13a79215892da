/**
 * @file table_volume.hpp
 * A solver's volume that its own functions serve, on one rank.
 */
#pragma once

#include "insitu_volume.hpp"

#include <elvis/runtime.h>

#include <string>

namespace elvis::library {

class TableVolume final : public InsituVolume {
public:
    /** `name` stands for the volume in messages. Throws Error. */
    TableVolume(const elvis_runtime& table, elvis_volume* volume, const std::string& name);

    const RuntimeVolume& whole() const override { return m_volume; }
    const RuntimeVolume* own() const override { return &m_volume; }
    void set_values(std::uint32_t field, std::uint32_t element_class, const double* values) override;
    /** Nothing: the functions are asked when values are needed. */
    std::uint64_t read_values() override { return 0; }
    /** All: the functions do not tell. */
    std::vector<std::uint32_t> share_values() override;

private:
    RuntimeVolume m_volume;
};

} // namespace elvis::library
