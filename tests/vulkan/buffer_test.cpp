#include <core/base/error.hpp>
#include <core/vulkan/buffer.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <span>

using namespace elvis;
using Catch::Contains;

namespace {

DeviceOptions validated(bool always_stage) {
    DeviceOptions options;
    options.validation = true;
    options.always_stage = always_stage;
    return options;
}

/** The bytes of one part, read back through a storage buffer. */
template <class T>
std::vector<T> read_part(const Device& device, const RecordBuffer& records, std::uint32_t part, std::size_t n) {
    const Buffer copy(device, n * sizeof(T));
    device.record([&](VkCommandBuffer commands) {
        const VkBufferCopy region{0, 0, n * sizeof(T)};
        vkCmdCopyBuffer(commands, records.part(part), copy.handle(), 1, &region);
    });
    return copy.read_items<T>(n);
}

} // namespace

TEST_CASE("What is written to a buffer is read back, mapped or staged") {
    const bool always_stage = GENERATE(false, true);
    const Device device(validated(always_stage));
    // More than two pieces of the staging buffer, and not a multiple of it.
    constexpr std::size_t n = (72u << 20u) / 4 + 3;
    const Buffer buffer(device, n * 4);
    CHECK(buffer.bytes() == n * 4);
    std::vector<std::uint32_t> numbers(n);
    std::iota(numbers.begin(), numbers.end(), 7u);
    buffer.write_items<std::uint32_t>(numbers);
    CHECK(buffer.read_items<std::uint32_t>(n) == numbers);
    CHECK(buffer.read_items<std::uint32_t>(5, n - 5) == std::vector<std::uint32_t>(numbers.end() - 5, numbers.end()));
    buffer.write_items<std::uint32_t>(std::vector<std::uint32_t>{1, 2}, 10);
    CHECK(buffer.read_items<std::uint32_t>(4, 9) == std::vector<std::uint32_t>{16, 1, 2, 19});
    buffer.fill(0xabcd1234u);
    CHECK(buffer.read_items<std::uint32_t>(2, n - 2) == std::vector<std::uint32_t>{0xabcd1234u, 0xabcd1234u});
    CHECK(device.validation_messages() == std::vector<std::string>{});
}

TEST_CASE("Buffers are read together, mapped or staged, with as few waits as the staging buffer asks for") {
    const bool always_stage = GENERATE(false, true);
    DeviceOptions options = validated(always_stage);
    options.submissions = Submissions::collected;
    const Device device(options);
    // Two that fit together, one that is larger than the staging buffer, one of which nothing is wanted, and two more.
    const std::array<std::size_t, 6> sizes = {1000, 2000, (40u << 20u) / 4, 0, 3000, 1};
    std::vector<Buffer> buffers;
    std::vector<std::vector<std::uint32_t>> written, found;
    for (const std::size_t size : sizes) {
        buffers.emplace_back(device, 4 * std::max<std::size_t>(size, 1));
        written.emplace_back(size);
        std::iota(written.back().begin(), written.back().end(), static_cast<std::uint32_t>(written.size()) << 24u);
        buffers.back().write_items<std::uint32_t>(written.back());
        found.emplace_back(size);
    }
    const auto read = [&](std::size_t i) { return Buffer::Read{&buffers[i], std::as_writable_bytes(std::span(found[i]))}; };
    const std::uint64_t before = device.work().host_waits;
    Buffer::read_together({read(0), read(1), read(2), read(3), read(4), read(5)});
    CHECK(found == written);
    CHECK(device.work().host_waits - before <= (always_stage ? 4 : 1));
    CHECK(device.validation_messages() == std::vector<std::string>{});
}

TEST_CASE("What is written to several buffers goes there together, until the staging buffer is full") {
    DeviceOptions options = validated(true);
    options.submissions = Submissions::collected;
    const Device device(options);
    // Larger than what commands carry themselves; 50 MB in all, of which two thirds fit.
    constexpr std::size_t n_buffers = 50, n = 250003;
    std::vector<Buffer> buffers;
    std::vector<std::vector<std::uint32_t>> written;
    for (std::size_t i = 0; i < n_buffers; ++i) {
        buffers.emplace_back(device, n * 4);
        written.emplace_back(n);
        std::iota(written.back().begin(), written.back().end(), static_cast<std::uint32_t>(i) << 24u);
    }
    const std::uint64_t before = device.work().submissions;
    for (std::size_t i = 0; i < n_buffers; ++i) {
        buffers[i].write_items<std::uint32_t>(written[i]);
    }
    for (std::size_t i = 0; i < n_buffers; ++i) {
        CHECK(buffers[i].read_items<std::uint32_t>(n) == written[i]);
    }
    CHECK(device.work().submissions - before <= 2 + n_buffers);
    CHECK(buffers[0].read_if_any(0) == std::vector<std::uint32_t>{0});
    CHECK(buffers[1].read_if_any(2) == std::vector<std::uint32_t>{1u << 24u, (1u << 24u) + 1, (1u << 24u) + 2});
    CHECK(buffers[1].read_if_any(n - 1) == written[1]);
    CHECK(device.validation_messages() == std::vector<std::string>{});
}

TEST_CASE("Memory is counted while buffers live") {
    const Device device;
    const std::uint64_t before = device.allocated_bytes();
    {
        const Buffer first(device, 1000);
        Buffer second(device, 2000);
        const Buffer moved(std::move(second));
        const RecordBuffer records(device, RecordKind::real, Precision::float32, 100, 3);
        CHECK(device.allocated_bytes() >= before + 3000 + records.bytes());
        CHECK(device.allocated_bytes() < before + 3000 + records.bytes() + 4096);
    }
    CHECK(device.allocated_bytes() == before);
}

TEST_CASE("A buffer that is too large is an error that says how large") {
    const Device device;
    CHECK_THROWS_WITH(Buffer(device, std::uint64_t{1} << 50u), Contains("1073741824 MiB") && Contains(device.summary().name));
    CHECK_THROWS_WITH(RecordBuffer(device, RecordKind::real, Precision::float32, std::uint64_t{1} << 33u, 4),
                      Contains("8589934592 records"));
    DeviceOptions options;
    options.max_binding_bytes = 1000;
    const Device small(options);
    CHECK_THROWS_WITH(RecordBuffer(small, RecordKind::real, Precision::float64, 2, 200), Contains("1600 bytes"));
}

TEST_CASE("Records are converted, padded and split without crossing a binding") {
    const bool always_stage = GENERATE(false, true);
    DeviceOptions options = validated(always_stage);
    options.max_binding_bytes = 1000;
    const Device device(options);
    const RecordBuffer records(device, RecordKind::real, Precision::float32, 50, 5);
    CHECK(records.padded_record_size() == 8);
    CHECK(records.records_per_part() == 31);
    REQUIRE(records.n_parts() == 2);
    std::vector<double> numbers(250);
    std::iota(numbers.begin(), numbers.end(), 0.1);
    records.write_reals(0, std::span<const double>(numbers).first(20 * 5));
    records.write_reals(20, std::span<const double>(numbers).subspan(20 * 5));
    std::vector<float> stored = read_part<float>(device, records, 0, 31 * 8);
    const std::vector<float> second = read_part<float>(device, records, 1, 19 * 8);
    stored.insert(stored.end(), second.begin(), second.end());
    for (std::size_t i = 0; i < stored.size(); ++i) {
        const float expected = i % 8 < 5 ? static_cast<float>(numbers[i / 8 * 5 + i % 8]) : 0;
        REQUIRE(stored[i] == expected);
    }
    CHECK(device.validation_messages() == std::vector<std::string>{});
}

TEST_CASE("A record larger than the staging buffer is written whole") {
    const Device device(validated(true));
    constexpr std::uint32_t size = (40u << 20u) / 8 + 1;
    const RecordBuffer records(device, RecordKind::real, Precision::float64, 2, size);
    std::vector<double> numbers(size);
    std::iota(numbers.begin(), numbers.end(), 0.5);
    records.write_reals(1, numbers);
    const auto stored = read_part<double>(device, records, 0, 2 * records.padded_record_size());
    CHECK(std::equal(numbers.begin(), numbers.end(), stored.begin() + records.padded_record_size()));
    CHECK(stored.back() == 0);
}

TEST_CASE("A buffer without records can be bound") {
    const Device device(validated(false));
    const RecordBuffer records(device, RecordKind::uint, Precision::float32, 0, 7);
    CHECK(records.n_parts() == 1);
    CHECK(records.bytes() == 0);
    CHECK(records.part(0) != VK_NULL_HANDLE);
    CHECK(device.validation_messages() == std::vector<std::string>{});
}
