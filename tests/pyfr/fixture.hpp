/**
 * @file fixture.hpp
 * What the tests of the PyFR plugin share.
 */
#pragma once

#include <core/convert/convert.hpp>
#include <core/oracle/element/volume.hpp>
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
elvis::SourceVolume open_pyfr(const std::vector<std::string>& paths);

/** A file of tests/data/pyfr. */
std::string pyfr_data(const std::string& name);

/** The message with which files are refused. */
std::string failure(const std::vector<std::string>& paths);

std::vector<std::string> field_names(const elvis::SourceVolume& source);

/** ElVis's reference point of one in PyFR's kind of element. */
std::array<double, 3> from_pyfr(const std::string& kind, const std::array<double, 3>& x);
