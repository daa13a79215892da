/**
 * @file fixture.hpp
 * What the tests of the HOPR plugin share.
 */
#pragma once

#include <core/convert/convert.hpp>
#include <core/plugin_host/source_volume.hpp>
#include <tests/support/asked_source.hpp>
#include <tests/support/files.hpp>

#include <array>
#include <string>
#include <vector>

using elvis::test::all_elements;
using elvis::test::position;
using elvis::test::sample;
using elvis::test::TemporaryFolder;

/** Opens files with the plugin. */
elvis::SourceVolume open_hopr(const std::vector<std::string>& paths);

/** A file of tests/data/hopr. */
std::string hopr_data(const std::string& name);

/** The message with which files are refused, when they are opened or when elements are asked for. */
std::string failure(const std::vector<std::string>& paths);
