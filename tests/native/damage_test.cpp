// A damaged file is refused, or the damage is without effect.
#include "volume_fixture.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace elvis::native;

namespace {

enum class Outcome { refused, harmless, wrong };

Outcome outcome(const std::string& path, const VolumeData& expected) {
    try {
        return identical(read_all(path), expected) ? Outcome::harmless : Outcome::wrong;
    } catch (const FileError&) {
        return Outcome::refused;
    }
}

} // namespace

TEST_CASE("A flipped byte is refused or without effect") {
    const TemporaryFolder folder;
    const std::string path = folder.path("volume.h5");
    const VolumeData data = small_volume();
    write(path, data);
    const std::vector<char> bytes = read_bytes(path);
    std::mt19937 random(7);
    std::size_t n_refused = 0;
    std::size_t n_harmless = 0;
    // One byte at a time; every third one for speed.
    for (std::size_t place = random() % 3; place < bytes.size(); place += 3) {
        std::vector<char> damaged = bytes;
        damaged[place] = static_cast<char>(damaged[place] ^ static_cast<char>(1 + random() % 255));
        write_bytes(path, damaged);
        const Outcome result = outcome(path, data);
        CAPTURE(place, bytes.size());
        REQUIRE(result != Outcome::wrong);
        ++(result == Outcome::refused ? n_refused : n_harmless);
    }
    WARN(bytes.size() << " bytes: " << n_refused << " flips refused, " << n_harmless << " without effect");
    CHECK(n_refused > n_harmless);
}

TEST_CASE("A truncated file is refused") {
    const TemporaryFolder folder;
    const std::string path = folder.path("volume.h5");
    const VolumeData data = small_volume();
    write(path, data);
    const std::vector<char> bytes = read_bytes(path);
    for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 100) {
        write_bytes(path, {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)});
        CAPTURE(length);
        CHECK(outcome(path, data) == Outcome::refused);
    }
    write_bytes(path, {bytes.begin(), bytes.end() - 1});
    CHECK(outcome(path, data) == Outcome::refused);
}

TEST_CASE("Blocks of zeros in a large file are refused") {
    // What a crashed machine leaves behind: pages that were never written.
    const TemporaryFolder folder;
    const std::string path = folder.path("volume.h5");
    const VolumeData data = large_volume();
    write(path, data);
    const std::vector<char> bytes = read_bytes(path);
    std::mt19937 random(8);
    constexpr std::size_t page = 4096;
    for (int i = 0; i < 25; ++i) {
        std::vector<char> damaged = bytes;
        const std::size_t first = random() % (bytes.size() / page) * page;
        std::fill_n(damaged.begin() + static_cast<std::ptrdiff_t>(first), page, '\0');
        write_bytes(path, damaged);
        CAPTURE(first);
        CHECK(outcome(path, data) != Outcome::wrong);
    }
}
