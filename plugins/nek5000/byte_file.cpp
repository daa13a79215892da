#include "byte_file.hpp"

#include <elvis/plugin.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace elvis_nek5000 {

namespace {

/** A fraction of the 1024 descriptors that a process usually may have. */
constexpr std::size_t max_open = 128;

} // namespace

ByteFile::ByteFile(std::string path) : m_path(std::move(path)) {
    // Not waiting for a writer, should it be a pipe.
    m_descriptor = ::open(m_path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (m_descriptor < 0) {
        throw elvis::api::Error(ELVIS_ERROR_FILE, m_path, std::string("cannot be opened: ") + std::strerror(errno));
    }
    struct stat status {};
    if (::fstat(m_descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
        ::close(m_descriptor);
        throw elvis::api::Error(ELVIS_ERROR_FILE, m_path, "is no file");
    }
    m_size = static_cast<std::uint64_t>(status.st_size);
}

ByteFile::~ByteFile() { ::close(m_descriptor); }

void ByteFile::read(std::uint64_t place, char* bytes, std::size_t n) const {
    while (n > 0) {
        const ssize_t n_read = ::pread(m_descriptor, bytes, n, static_cast<off_t>(place));
        if (n_read < 0 && errno == EINTR) {
            continue;
        }
        if (n_read < 0) {
            throw elvis::api::Error(ELVIS_ERROR_FILE, m_path,
                                    "byte " + std::to_string(place) + ": cannot be read: " + std::strerror(errno));
        }
        if (n_read == 0) {
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, m_path,
                                    "ends at byte " + std::to_string(place) + ", where " + std::to_string(n) +
                                        " more are expected");
        }
        place += static_cast<std::uint64_t>(n_read);
        bytes += n_read;
        n -= static_cast<std::size_t>(n_read);
    }
}

std::string ByteFile::text(std::uint64_t place, std::size_t n) const {
    const std::uint64_t left = m_size - std::min(m_size, place);
    std::string result(std::min<std::uint64_t>(n, left), '\0');
    read(place, result.data(), result.size());
    return result;
}

std::shared_ptr<const ByteFile> OpenFiles::open(const std::string& path) {
    const std::lock_guard lock(m_mutex);
    const auto found = std::ranges::find_if(m_files, [&](const auto& file) { return file->path() == path; });
    if (found != m_files.end()) {
        return *found;
    }
    auto file = std::make_shared<const ByteFile>(path);
    m_files.push_front(file);
    if (m_files.size() > max_open) {
        m_files.pop_back();
    }
    return file;
}

} // namespace elvis_nek5000
