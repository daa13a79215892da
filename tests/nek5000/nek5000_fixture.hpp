/**
 * @file nek5000_fixture.hpp
 * What the tests of Nek5000's files share.
 */
#pragma once

#include "fixture.hpp"

#include <string>
#include <vector>

using elvis::test::read_file;

/** Opens with the plugin under test. */
elvis::SourceVolume open_nek5000(const std::vector<std::string>& paths);

/** A file of tests/data/nek5000. */
std::string sample_file(const std::string& name);

/** What opening, or sampling all elements at all times, says is wrong; "no failure" if it says nothing. */
std::string failure(const std::vector<std::string>& paths);

/** All fields at a point. */
std::vector<double> sample(const elvis::SourceVolume& source, std::size_t step, std::uint64_t element,
                           const elvis::native::Point& xi);
elvis::native::Point position(const elvis::SourceVolume& source, std::uint64_t element, const elvis::native::Point& xi);

/** Index of the field of that name; a failure if there is none. */
std::size_t field_index(const elvis::SourceVolume& source, const std::string& name);
