#include "fixture.hpp"

#include <core/shader/composer.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstdint>

using namespace elvis;

namespace {

constexpr const char* read_all = R"(
layout(local_size_x = 8) in;
#include "arithmetic/precision.glsl"
#include "picture/samples.glsl"
layout(set = 0, binding = 0) CORE_READ_ROWS(core_rows);
layout(set = 0, binding = 1) CORE_READ_REALS(core_reals);
layout(set = 0, binding = 2) CORE_READ_WORDS(core_words);
layout(set = 0, binding = 3) CORE_READ_SAMPLES(core_samples);
layout(set = 0, binding = 4) CORE_READ_MARKS(core_marks);
layout(std430, set = 0, binding = 5) buffer output_block { uvec2 result[]; };
layout(push_constant) uniform push_block { uint n_items; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= n_items) {
        return;
    }
    const elvis_vec4 row = CORE_ROW(core_rows, i);
    const core_mark mark = CORE_MARK(core_marks, i);
    const core_sample whole = CORE_SAMPLE(core_samples, i);
    result[8u * i] = bits(CORE_REAL(core_reals, i));
    result[8u * i + 1u] = uvec2(CORE_WORD(core_words, i), whole.number);
    result[8u * i + 2u] = bits(row.x);
    result[8u * i + 3u] = bits(row.w);
    result[8u * i + 4u] = bits(CORE_SAMPLE_VALUE(core_samples, i));
    result[8u * i + 5u] = bits(CORE_SAMPLE_DEPTH(core_samples, i));
    result[8u * i + 6u] = uvec2(CORE_SAMPLE_NUMBER(core_samples, i), bits(CORE_REAL3(core_reals, i).z).x);
    result[8u * i + 7u] = uvec2(mark.owner, mark.flags);
}
)";

using Bits = std::array<std::uint32_t, 2>;

/** Of every buffer: read as a float, a half of a double or a word, each differs. */
std::uint32_t word(std::uint32_t i) { return 0x3f800000u + 8191u * i; }

Bits real(Precision precision, std::uint32_t i) {
    return precision == Precision::float64 ? Bits{word(2 * i), word(2 * i + 1)} : Bits{word(i), 0};
}

/** What the kernel finds of item `i`. */
std::array<Bits, 8> expected_of(Precision precision, std::uint32_t i) {
    const std::uint32_t number = word(precision == Precision::float64 ? 6 * i + 4 : 3 * i + 2);
    return {real(precision, i),
            Bits{word(i), number},
            real(precision, 4 * i),
            real(precision, 4 * i + 3),
            real(precision, 3 * i),
            real(precision, 3 * i + 1),
            Bits{number, real(precision, i + 2)[0]},
            Bits{word(2 * i), word(2 * i + 1)}};
}

void check_reading(DataBuffers buffers, Precision precision) {
    DeviceOptions options;
    options.data_buffers = buffers;
    options.validation = true;
    const Device device(options);
    // No buffer ends with a whole texel, but for the rows.
    constexpr std::uint32_t n = 13;
    const std::uint32_t real_words = precision == Precision::float64 ? 2 : 1;
    std::vector<Buffer> read;
    for (const std::uint32_t n_words : {4 * n * real_words, (n + 2) * real_words, n, 3 * n * real_words, 2 * n}) {
        std::vector<std::uint32_t> words;
        for (std::uint32_t i = 0; i < n_words; ++i) {
            words.push_back(word(i));
        }
        read.emplace_back(device, n_words * sizeof(std::uint32_t)).write_items<std::uint32_t>(words);
    }
    const Buffer result(device, n * 8 * sizeof(Bits));
    KernelRequest request;
    request.name = "reading test";
    request.kernel = "read_all";
    request.kernel_text = test::bits_glsl;
    request.kernel_text += read_all;
    request.precision = precision;
    request.bindings = buffer_bindings({.storage = 6});
    request.push_constant_bytes = sizeof n;
    const ComposedKernel kernel(device, request);
    const std::array<const Buffer*, 6> bindings{&read[0], &read[1], &read[2], &read[3], &read[4], &result};
    kernel.dispatch(bindings, std::as_bytes(std::span(&n, 1)), (n + 7) / 8);
    const auto found = result.read_items<std::array<Bits, 8>>(n);
    for (std::uint32_t i = 0; i < n; ++i) {
        CHECK(found[i] == expected_of(precision, i));
    }
    CHECK(device.validation_messages() == std::vector<std::string>{});
}

} // namespace

TEST_CASE("Every number of a buffer that is only read is read bit for bit") {
    const test::CacheFolder cache;
    for (const DataBuffers buffers : {DataBuffers::texel, DataBuffers::storage}) {
        for (const Precision precision : {Precision::float32, Precision::float64}) {
            INFO((buffers == DataBuffers::texel ? "texel buffers" : "storage buffers"));
            INFO((precision == Precision::float64 ? "float64" : "float32"));
            check_reading(buffers, precision);
        }
    }
}
