/**
 * @file fixture.hpp
 * What the tests of the CGNS plugin share.
 */
#pragma once

#include "closed_forms.hpp"

#include <core/convert/convert.hpp>
#include <core/oracle/element/volume.hpp>
#include <core/plugin_host/source_volume.hpp>
#include <tests/support/asked_source.hpp>
#include <tests/support/files.hpp>

#include <random>
#include <string>
#include <vector>

using cgns_test::Point;
using elvis::test::all_elements;
using elvis::test::position;
using elvis::test::sample;
using elvis::test::TemporaryFolder;

/** Opens files with the plugin. */
elvis::SourceVolume open_cgns(const std::vector<std::string>& paths);

/** Has a file written by the CGNS library; `linked` is the name of another one in the folder. Returns its path. */
std::string write_cgns(const TemporaryFolder& folder, const std::string& kind, const std::string& container,
                       const std::string& linked = "");

/** The message with which a file is refused; "no failure" if it is not. */
std::string failure(const std::string& path);

std::vector<std::string> field_names(const elvis::SourceVolume& source);

/** A point in a reference shape; the sequence is the same in every run. */
Point random_point(elvis::native::Shape shape);

/** "Inflow 3, Outflow 2": how many faces the groups have, by name. */
std::string n_faces_by_group(const elvis::SourceVolume& source);
