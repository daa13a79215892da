// What the plugin's page says of its speed: nek5000_test "[.speed]".
#include "nek5000_fixture.hpp"
#include "written_file.hpp"

#include <catch2/catch.hpp>
#include <core/convert/convert.hpp>

#include <chrono>
#include <cstdio>
#include <numeric>

using namespace elvis;

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/** All there is, at the Gauss points that a conversion asks for: values a second, on one processor. */
double sampling_rate(const SourceVolume& source, int n) {
    std::vector<double> points(static_cast<std::size_t>(n)), weights(points.size()), xi;
    native::gauss_legendre(points, weights);
    for (const double z : points) {
        for (const double y : points) {
            for (const double x : points) {
                xi.insert(xi.end(), {x, y, z});
            }
        }
    }
    std::vector<double> positions(xi.size()), values(source.n_values() * xi.size() / 3);
    const auto start = std::chrono::steady_clock::now();
    for (std::uint64_t element = 0; element < source.info().n_elements; ++element) {
        source.evaluate_mapping(element, xi, positions);
        source.sample(0, element, xi, values);
    }
    return static_cast<double>(source.info().n_elements * (positions.size() + values.size())) / seconds_since(start);
}

} // namespace

TEST_CASE("Speed of reading and of conversion", "[.speed]") {
    const TemporaryFolder folder;
    WrittenFile file;
    file.n = 8;
    file.n_elements = 2000;
    file.code = "XUPT";
    file.numbers.resize(2000);
    std::iota(file.numbers.begin(), file.numbers.end(), 1);
    for (const int real_size : {4, 8}) {
        file.real_size = real_size;
        const std::string content = file.content();
        const auto start = std::chrono::steady_clock::now();
        const SourceVolume source = open_nek5000({folder.write("run0.f00001", content)});
        const double seconds_to_open = seconds_since(start);
        const double rate = sampling_rate(source, file.n);
        const ConvertReport report = convert(source, folder.path("volume.h5"), {}, {});
        std::printf(
            "%d elements of %d^3 nodes, reals of %d bytes, %.0f MB: opened in %.2f s; reading %.1f million values a second; "
            "conversion %.1f million coefficients a second (%.2f s)\n",
            file.n_elements, file.n, real_size, static_cast<double>(content.size()) * 1e-6, seconds_to_open, rate * 1e-6,
            static_cast<double>(report.n_coefficients) / report.seconds * 1e-6, report.seconds);
        CHECK(report.geometry_exact);
    }
}
