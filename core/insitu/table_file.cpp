#include "table_file.hpp"

#include <core/base/csv_text.hpp>
#include <core/base/error.hpp>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <utility>

namespace elvis::library {

TableFile::TableFile(std::string path, const std::vector<std::string>& columns) : m_path(std::move(path)) {
    std::string header;
    for (const std::string& column : columns) {
        header.append(header.empty() ? "" : ",").append(csv_name(column));
    }
    std::string first;
    if (std::ifstream file(m_path); std::getline(file, first) && !first.empty()) {
        if (first != header) {
            throw Error(m_path, "is there, and has other columns: move it away");
        }
        return;
    }
    header += '\n';
    append(header);
}

void TableFile::append(const std::string& rows) const {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(m_path.c_str(), "ab"), &std::fclose);
    const bool is_written =
        file && std::fwrite(rows.data(), 1, rows.size(), file.get()) == rows.size() && std::fflush(file.get()) == 0;
    if (!is_written) {
        throw Error(m_path, std::string("cannot be written: ") + std::strerror(errno));
    }
}

} // namespace elvis::library
