#include "fixture.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

using namespace elvis;

namespace {

// Reads number `index` by elvis_fetch and by elvis_fetch4, and writes both as bits.
constexpr const char* read_all = R"(
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) buffer output_block { uvec2 result[]; };
layout(push_constant) uniform push_block { uint n_records; uint record_size; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= n_records * record_size) {
        return;
    }
    uint record = i / record_size, index = i % record_size;
    result[4u * i] = bits(elvis_fetch_reals(record, index));
    result[4u * i + 1u] = bits(elvis_fetch4_reals(record, index / 4u)[index % 4u]);
    result[4u * i + 2u] = uvec2(elvis_fetch_uints(record, index), elvis_fetch4_uints(record, index / 4u)[index % 4u]);
    // The padding of the last row reads as zero.
    uvec2 padding = bits(elvis_fetch4_reals(record, (record_size - 1u) / 4u).w);
    result[4u * i + 3u] = uvec2(padding.x | padding.y, elvis_fetch4_uints(record, (record_size - 1u) / 4u).w);
}
)";

/** A number that needs all bits of a double and differs for each place. */
double number(std::uint64_t i) { return 1.0 / (1.0 + static_cast<double>(i)) - 0.3; }

/** A double's low and high word, or a float's word and zero, or two words. */
using Bits = std::array<std::uint32_t, 2>;

void check_fetch(DataBuffers buffers, Precision precision, std::uint64_t max_binding_bytes, std::uint32_t expected_parts) {
    DeviceOptions options;
    options.data_buffers = buffers;
    options.max_binding_bytes = max_binding_bytes;
    options.validation = true;
    const Device device(options);
    constexpr std::uint32_t n_records = 53, record_size = 11;
    RecordBuffer reals(device, RecordKind::real, precision, n_records, record_size);
    RecordBuffer uints(device, RecordKind::uint, precision, n_records, record_size);
    REQUIRE(reals.n_parts() == expected_parts);
    std::vector<double> numbers(n_records * record_size);
    std::vector<std::uint32_t> words(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        numbers[i] = number(i);
        words[i] = static_cast<std::uint32_t>(i * 2654435761u);
    }
    // Written in ranges that do not end where the parts end.
    for (std::uint32_t first = 0; first < n_records; first += 9) {
        const std::size_t count = std::min(9u, n_records - first);
        reals.write_reals(first, std::span<const double>(numbers).subspan(first * record_size, count * record_size));
        uints.write_uints(first, std::span<const std::uint32_t>(words).subspan(first * record_size, count * record_size));
    }

    KernelRequest request;
    request.name = "fetch test";
    request.kernel = "read_all";
    request.kernel_text = test::bits_glsl;
    request.kernel_text += read_all;
    request.precision = precision;
    request.buffers = {{"reals", &reals}, {"uints", &uints}};
    request.bindings = {{0, BindingType::storage_buffer}};
    request.push_constant_bytes = 8;
    const ComposedKernel kernel(device, request);
    const Buffer result(device, numbers.size() * 4 * sizeof(Bits));
    const std::uint32_t push[2]{n_records, record_size};
    const Buffer* const bindings[]{&result};
    kernel.dispatch(bindings, std::as_bytes(std::span(push)), (n_records * record_size + 63) / 64);

    const auto bits = result.read_items<Bits>(numbers.size() * 4);
    std::size_t n_wrong = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        Bits expected{};
        if (precision == Precision::float64) {
            std::memcpy(expected.data(), &numbers[i], 8);
        } else {
            const auto rounded = static_cast<float>(numbers[i]);
            std::memcpy(expected.data(), &rounded, 4);
        }
        n_wrong += bits[4 * i] != expected ? 1 : 0;
        n_wrong += bits[4 * i + 1] != expected ? 1 : 0;
        n_wrong += bits[4 * i + 2] != Bits{words[i], words[i]} ? 1 : 0;
        n_wrong += bits[4 * i + 3] != Bits{} ? 1 : 0;
    }
    CHECK(n_wrong == 0);
    CHECK(device.validation_messages() == std::vector<std::string>{});
}

} // namespace

TEST_CASE("Every number of a record buffer is fetched bit for bit") {
    const test::CacheFolder cache;
    for (const DataBuffers buffers : {DataBuffers::texel, DataBuffers::storage}) {
        for (const Precision precision : {Precision::float32, Precision::float64}) {
            const bool is_double = precision == Precision::float64;
            INFO((buffers == DataBuffers::texel ? "texel " : "storage ") << (is_double ? "float64" : "float32"));
            check_fetch(buffers, precision, 0, 1);
            // Bindings of 1000 bytes hold 20 records of 48 bytes, or 10 of 96.
            check_fetch(buffers, precision, 1000, is_double ? 6 : 3);
        }
    }
}

TEST_CASE("Three hundred mebibytes are read on the device's own limits") {
    const test::CacheFolder cache;
    const DataBuffers buffers = GENERATE(DataBuffers::texel, DataBuffers::storage);
    DeviceOptions options;
    options.data_buffers = buffers;
    const Device device(options);
    constexpr std::uint32_t n_records = 76800, record_size = 1024;
    const RecordBuffer records(device, RecordKind::real, Precision::float32, n_records, record_size);
    REQUIRE(records.bytes() == 300u << 20u);
    const auto value = [](std::uint64_t i) { return static_cast<float>(i % 16777213); };
    constexpr std::uint32_t at_once = 2400;
    std::vector<double> numbers(std::size_t{at_once} * record_size);
    for (std::uint32_t first = 0; first < n_records; first += at_once) {
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            numbers[i] = value(std::uint64_t{first} * record_size + i);
        }
        records.write_reals(first, numbers);
    }
    KernelRequest request;
    request.name = "large fetch test";
    request.kernel = "test.comp";
    request.kernel_text = "layout(local_size_x = 64) in;\n"
                          "layout(std430, binding = 0) writeonly buffer result_block { float result[]; };\n"
                          "void main() {\n"
                          "    uint i = gl_GlobalInvocationID.x;\n"
                          "    result[i] = elvis_fetch_large(i, i % 1024u);\n"
                          "}\n";
    request.buffers = {{"large", &records}};
    request.bindings = {{0, BindingType::storage_buffer}};
    const ComposedKernel kernel(device, request);
    const Buffer output(device, n_records * sizeof(float));
    const std::array<const Buffer*, 1> bindings{&output};
    kernel.dispatch(bindings, {}, n_records / 64);
    const auto result = output.read_items<float>(n_records);
    std::size_t n_wrong = 0;
    for (std::uint32_t i = 0; i < n_records; ++i) {
        n_wrong += result[i] != value(std::uint64_t{i} * record_size + i % 1024) ? 1 : 0;
    }
    CHECK(n_wrong == 0);
}
