#include <core/base/cache.hpp>
#include <core/base/host.hpp>

#include <unistd.h>

#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <system_error>

namespace elvis {

namespace {

/** FNV-1a, 64 bits. */
std::uint64_t fnv1a(std::string_view content) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : content) {
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    }
    return hash;
}

/** Eight bytes a step through the finaliser of MurmurHash3 (Appleby, public domain): independent of FNV-1a. */
std::uint64_t mix_hash(std::string_view content) {
    std::uint64_t hash = 0x9e3779b97f4a7c15u ^ content.size();
    for (std::size_t i = 0; i < content.size(); i += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, content.data() + i, std::min<std::size_t>(8, content.size() - i));
        word = (word ^ (word >> 33)) * 0xff51afd7ed558ccdu;
        word = (word ^ (word >> 33)) * 0xc4ceb9fe1a85ec53u;
        hash = std::rotl(hash ^ word ^ (word >> 33), 27) * 5 + 0x52dce729u;
    }
    hash = (hash ^ (hash >> 33)) * 0xff51afd7ed558ccdu;
    return hash ^ (hash >> 33);
}

struct EntryHeader {
    std::array<char, 8> magic{'E', 'l', 'V', 'i', 's', 'c', 'a', '1'};
    std::uint64_t size = 0;
    std::uint64_t checksum = 0;
};

std::string_view as_text(std::span<const std::byte> content) {
    return {reinterpret_cast<const char*>(content.data()), content.size()};
}

} // namespace

std::filesystem::path cache_folder() {
    if (const auto& decided = host().cache_folder) {
        return *decided;
    }
    if (const auto own = environment_variable("ELVIS_CACHE_PATH")) {
        return *own;
    }
    if (const auto user = environment_variable("XDG_CACHE_HOME")) {
        return std::filesystem::path(*user) / "elvis";
    }
    if (const auto home = environment_variable("HOME")) {
        return std::filesystem::path(*home) / ".cache" / "elvis";
    }
    return {};
}

std::string content_hash(std::string_view content) {
    std::array<char, 33> text{};
    std::snprintf(text.data(), text.size(), "%016llx%016llx", static_cast<unsigned long long>(fnv1a(content)),
                  static_cast<unsigned long long>(mix_hash(content)));
    return text.data();
}

std::optional<std::vector<std::byte>> read_cache_entry(const std::string& name) {
    const auto folder = cache_folder();
    if (folder.empty()) {
        return std::nullopt;
    }
    std::ifstream file(folder / name, std::ios::binary | std::ios::ate);
    const std::streamoff length = file ? static_cast<std::streamoff>(file.tellg()) : -1;
    EntryHeader header;
    if (length < static_cast<std::streamoff>(sizeof header)) {
        return std::nullopt;
    }
    file.seekg(0);
    file.read(reinterpret_cast<char*>(&header), sizeof header);
    if (!file || header.magic != EntryHeader{}.magic || header.size != static_cast<std::uint64_t>(length) - sizeof header) {
        return std::nullopt;
    }
    std::vector<std::byte> content(static_cast<std::size_t>(header.size));
    file.read(reinterpret_cast<char*>(content.data()), static_cast<std::streamsize>(content.size()));
    if (!file || mix_hash(as_text(content)) != header.checksum) {
        return std::nullopt;
    }
    return content;
}

bool write_cache_entry(const std::string& name, std::span<const std::byte> content) {
    static std::atomic<unsigned> counter{0};
    const auto folder = cache_folder();
    if (folder.empty()) {
        return false;
    }
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    const auto temporary = folder / (name + "." + std::to_string(getpid()) + "." + std::to_string(counter++) + ".part");
    {
        std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
        EntryHeader header;
        header.size = content.size();
        header.checksum = mix_hash(as_text(content));
        file.write(reinterpret_cast<const char*>(&header), sizeof header);
        file.write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
        file.close();
        if (!file) {
            std::filesystem::remove(temporary, failure);
            return false;
        }
    }
    std::filesystem::rename(temporary, folder / name, failure);
    if (failure) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        return false;
    }
    return true;
}

} // namespace elvis
