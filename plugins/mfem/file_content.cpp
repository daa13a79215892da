#include "file_content.hpp"

#include <elvis/plugin.hpp>

#include <zlib.h>

#include <algorithm>
#include <filesystem>
#include <memory>

namespace elvis_mfem {

namespace {

/** gzip packs up to a thousand bytes into one, numbers as text about three: a small file must not take all memory. */
constexpr std::size_t max_ratio = 100;
/** This much may be packed more tightly: fields of zeros. */
constexpr std::size_t always_allowed = std::size_t{1} << 27;

struct Close {
    void operator()(gzFile_s* file) const { gzclose_r(file); }
};

using File = std::unique_ptr<gzFile_s, Close>;

/** Plain files are read as they are. */
File open(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::is_directory(path, ignored) ? File() : File(gzopen(path.c_str(), "rb"));
}

/** Appends up to n bytes; false at the end of the file. */
bool read_more(gzFile_s* file, std::size_t n, std::string& content) {
    const std::size_t size = content.size();
    content.resize(size + n);
    const int n_read = gzread(file, content.data() + size, static_cast<unsigned>(n));
    content.resize(size + static_cast<std::size_t>(std::max(0, n_read)));
    return n_read > 0;
}

} // namespace

std::string read_content(const std::string& path) {
    const File file = open(path);
    if (!file) {
        throw elvis::api::Error(ELVIS_ERROR_FILE, path, "the file cannot be opened");
    }
    gzbuffer(file.get(), 1u << 17);
    std::string content;
    std::error_code ignored;
    const auto known_size = std::filesystem::file_size(path, ignored);
    const std::size_t size = ignored ? 0 : static_cast<std::size_t>(known_size);
    constexpr std::size_t block = std::size_t{1} << 20;
    content.reserve(size + block);
    while (read_more(file.get(), block, content)) {
        if (content.size() > always_allowed + max_ratio * size && gzdirect(file.get()) == 0) {
            throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, path,
                                    "the compressed file holds more than " + std::to_string(max_ratio) +
                                        " times its size, which is not supported; unpack it with gunzip");
        }
    }
    int error = Z_OK;
    gzerror(file.get(), &error);
    if (error != Z_OK && error != Z_STREAM_END) {
        throw elvis::api::Error(ELVIS_ERROR_FILE, path,
                                error == Z_ERRNO ? "the file cannot be read" : "the compressed file is damaged or ends early");
    }
    return content;
}

std::string read_head(const std::string& path, std::size_t n) {
    const File file = open(path);
    std::string head;
    while (file && head.size() < n && read_more(file.get(), n - head.size(), head)) {
    }
    return head;
}

} // namespace elvis_mfem
