/**
 * @file output_file.hpp
 * Files that appear whole or not at all.
 */
#pragma once

#include <string>
#include <string_view>

namespace elvis {

/** A temporary name beside a target. Renamed into place by commit(); removed if that never happens. */
class OutputFile {
public:
    explicit OutputFile(std::string path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    const std::string& temporary() const { return m_temporary; }
    void commit();

private:
    std::string m_path;
    std::string m_temporary;
    bool m_is_committed = false;
};

/** Writes a text file. Throws Error naming it. */
void write_text_file(const std::string& path, std::string_view text);

} // namespace elvis
