/**
 * @file temporary_folder.hpp
 * Folders and files that last as long as an object.
 */
#pragma once

#include <filesystem>
#include <string>

namespace elvis {

/** An empty folder of its own; it goes with this object, and with it all that it holds. */
class TemporaryFolder {
public:
    /** Its name is the prefix and six more characters; throws Error if it cannot be made. */
    explicit TemporaryFolder(const std::filesystem::path& prefix = std::filesystem::temp_directory_path() / "elvis-");
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return m_path; }
    std::string path(const std::string& name) const { return (m_path / name).string(); }
    /** Writes a file, folders above it included, and returns its path. */
    std::string write(const std::string& name, const std::string& content) const;

private:
    std::filesystem::path m_path;
};

/** A place for one file of this name. */
class TemporaryFile {
public:
    explicit TemporaryFile(const std::string& name) : m_path(m_folder.path(name)) {}

    const std::string& path() const { return m_path; }

private:
    TemporaryFolder m_folder;
    std::string m_path;
};

} // namespace elvis
