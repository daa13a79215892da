/**
 * @file fixture.hpp
 * What the conversion tests share.
 */
#pragma once

#include <core/plugin_host/source_volume.hpp>

#include <filesystem>
#include <string>

/** A folder of its own that goes when the test ends. */
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::string path(const std::string& name) const { return (m_path / name).string(); }
    /** Writes a file and returns its path. */
    std::string write(const std::string& name, const std::string& content) const;
    std::size_t n_files() const;

private:
    std::filesystem::path m_path;
};

/** The data set that a description stands for; the generator reads it when it is opened. */
elvis::SourceVolume generate(const std::string& description);

/** A file of the original ElVis. */
elvis::SourceVolume open_dat(const std::string& path);

/** A file below the folder of real data sets; a failure if it is missing. */
std::string test_data(const std::string& name);
