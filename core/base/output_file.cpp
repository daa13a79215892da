#include <core/base/error.hpp>
#include <core/base/output_file.hpp>

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <utility>

namespace elvis {

OutputFile::OutputFile(std::string path)
    : m_path(std::move(path)), m_temporary(m_path + ".part-" + std::to_string(::getpid())) {}

OutputFile::~OutputFile() {
    if (!m_is_committed) {
        std::remove(m_temporary.c_str());
    }
}

void OutputFile::commit() {
    if (std::rename(m_temporary.c_str(), m_path.c_str()) != 0) {
        throw Error(m_path, std::string("cannot be written: ") + std::strerror(errno));
    }
    m_is_committed = true;
}

void write_text_file(const std::string& path, std::string_view text) {
    OutputFile output(path);
    std::ofstream file(output.temporary(), std::ios::binary);
    file << text;
    file.close();
    if (!file) {
        throw Error(path, std::string("cannot be written: ") + std::strerror(errno));
    }
    output.commit();
}

} // namespace elvis
