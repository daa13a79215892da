/**
 * @file table_file.hpp
 * Comma-separated values that grow while a program runs.
 */
#pragma once

#include <string>
#include <vector>

namespace elvis::library {

/** Rows are written whole. A file that is there goes on if its first line is the same: of a run that was begun before. */
class TableFile {
public:
    /** Throws Error where the file is of another table, or cannot be written. */
    TableFile(std::string path, const std::vector<std::string>& columns);

    /** Lines with their ends. Throws Error. */
    void append(const std::string& rows) const;

private:
    std::string m_path;
};

} // namespace elvis::library
