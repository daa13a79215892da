/**
 * @file fixture.hpp
 * What the tests of the HOPR plugin share.
 */
#pragma once

#include <core/convert/convert.hpp>
#include <core/plugin_host/source_volume.hpp>
#include <tests/support/files.hpp>

#include <array>
#include <string>
#include <vector>

using elvis::test::TemporaryFolder;

/** Opens files with the plugin. */
elvis::SourceVolume open_hopr(const std::vector<std::string>& paths);

/** A file of tests/data/hopr. */
std::string hopr_data(const std::string& name);

/** The message with which files are refused, when they are opened or when elements are asked for. */
std::string failure(const std::vector<std::string>& paths);

std::vector<elvis_source_element> all_elements(const elvis::SourceVolume& source);
std::array<double, 3> position(const elvis::SourceVolume& source, std::uint64_t element, const std::array<double, 3>& xi);
std::vector<double> sample(const elvis::SourceVolume& source, std::uint64_t element, const std::array<double, 3>& xi,
                           std::uint32_t step = 0);
