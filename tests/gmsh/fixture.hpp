/**
 * @file fixture.hpp
 * What the tests of Gmsh's files share.
 */
#pragma once

#include <core/convert/convert.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/plugin_host/source_volume.hpp>
#include <elvis/native/space.hpp>
#include <tests/support/files.hpp>

#include <array>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

using elvis::native::Point;

using elvis::test::read_file;
using elvis::test::TemporaryFolder;

/** Runs the gmsh program in a folder on a script with so many options; fails with its output if it fails. */
void run_gmsh(const TemporaryFolder& folder, const std::string& script, const std::string& options);

elvis::SourceVolume open_msh(const std::vector<std::string>& paths);

/** Why a file is refused; "no failure" if it is not. */
std::string failure(const std::vector<std::string>& paths);

/** All fields at one point. */
std::vector<double> sample(const elvis::SourceVolume& source, std::uint64_t element, const Point& xi, std::uint32_t step = 0);
Point position(const elvis::SourceVolume& source, std::uint64_t element, const Point& xi);

/** The converted file, as the program draws it. Elements by their number in the source. */
class Converted {
public:
    explicit Converted(const elvis::SourceVolume& source);

    const elvis::ConvertReport& report() const { return m_report; }
    Point position(std::uint64_t element, const Point& xi) const;
    std::vector<double> value(std::uint32_t field, std::uint64_t element, const Point& xi, std::uint32_t step = 0) const;
    const elvis::RuntimeVolume& volume() const { return *m_volume; }

private:
    TemporaryFolder m_folder;
    elvis::ConvertReport m_report;
    std::unique_ptr<elvis::RuntimeVolume> m_volume;
    /** Element of the runtime volume by number. */
    std::vector<std::uint64_t> m_element;
};

/** A point in a reference shape; the sequence is the same in every run. */
Point random_point(elvis::native::Shape shape);
elvis::native::Shape shape_of(const elvis::SourceVolume& source, std::uint64_t element);

std::mt19937& random_numbers();
