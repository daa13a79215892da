/**
 * @file fixture.hpp
 * What the tests of the Nektar++ plugin share.
 */
#pragma once

#include <core/convert/convert.hpp>
#include <core/oracle/element/volume.hpp>
#include <core/plugin_host/source_volume.hpp>
#include <tests/support/files.hpp>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

using elvis::test::read_file;
using elvis::test::TemporaryFolder;

elvis::SourceVolume open_nektar(const std::vector<std::string>& paths);

/** What the plugin says of files that it refuses. */
std::string failure(const std::vector<std::string>& paths);

/** A file of the real data sets; a failure if it is missing. */
std::string sample_file(const std::string& name);

/** A native volume written by the conversion and read by the oracle, one field at one time step. */
class Converted {
public:
    explicit Converted(const elvis::SourceVolume& source, std::size_t field = 0, std::size_t time_step = 0);

    const elvis::ConvertReport& report() const { return m_report; }
    std::array<double, 3> position(std::uint64_t number, const std::array<double, 3>& xi) const;
    double value(std::uint64_t number, const std::array<double, 3>& xi) const;

private:
    elvis::ConvertReport m_report;
    std::unique_ptr<elvis::oracle::Volume> m_volume;
    /** By element number. */
    std::vector<std::size_t> m_place;
};

/** Value of a field, and position, of the source at one point. */
double value_at(const elvis::SourceVolume& source, std::uint64_t element, const std::array<double, 3>& xi,
                std::size_t field = 0, std::uint32_t time_step = 0);
std::array<double, 3> position_at(const elvis::SourceVolume& source, std::uint64_t element, const std::array<double, 3>& xi);
