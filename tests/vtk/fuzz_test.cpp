// Damaged files are refused or read; nothing else happens.
#include "vtk_fixture.hpp"

#include <catch2/catch.hpp>
#include <core/base/error.hpp>

#include <sys/resource.h>

#include <random>

using namespace elvis;

namespace {

/** One change: an end cut off, bytes exchanged, a number or a tag replaced, a part removed or repeated. */
std::string damaged_text(std::string content, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
    // Half of the changes in the part that is surely text.
    const std::size_t reach = below(2) == 0 ? std::min<std::size_t>(content.size(), 3000) : content.size();
    switch (below(7)) {
    case 0:
        content.resize(below(content.size()));
        break;
    case 1:
        for (std::size_t n = 1 + below(8); n > 0; --n)
            content[below(reach)] = static_cast<char>(below(256));
        break;
    case 2: {
        const std::size_t digit = content.find_first_of("0123456789", below(reach));
        const char* const numbers[] = {"-1", "0", "4294967296", "99999999999999999999", "1e300", "nan", "255", "74", "3"};
        if (digit != std::string::npos)
            content.replace(digit, 1 + below(4), numbers[below(std::size(numbers))]);
        break;
    }
    case 3: {
        const std::size_t first = below(reach);
        content.erase(first, 1 + below(200));
        break;
    }
    case 4: {
        const std::size_t first = below(reach);
        content.insert(below(reach), content.substr(first, 1 + below(200)));
        break;
    }
    case 5: {
        const std::size_t tag = content.find('<', below(reach));
        const std::size_t end = tag == std::string::npos ? tag : content.find('>', tag);
        if (end != std::string::npos)
            content.erase(tag, end - tag + 1);
        break;
    }
    default: {
        const char* const pairs[][2] = {{"Float64", "UInt8"},        {"Int64", "Float32"},   {"UInt64", "UInt32"},
                                        {"ascii", "binary"},         {"appended", "binary"}, {"LittleEndian", "BigEndian"},
                                        {"vtkZLib", "vtkLZ4"},       {"raw", "base64"},      {"base64", "raw"},
                                        {"offset=\"", "offset=\"9"}, {"types", "type"},      {"UInt8", "Int64"}};
        const auto& pair = pairs[below(std::size(pairs))];
        const std::size_t at = content.find(pair[0]);
        if (at != std::string::npos)
            content.replace(at, std::string(pair[0]).size(), pair[1]);
    }
    }
    return content;
}

} // namespace

TEST_CASE("damaged files neither crash nor hang nor take memory", "[vtk]") {
    std::mt19937 random(7);
    const TemporaryFolder folder;
    std::size_t n_refused = 0, n_read = 0;
    for (const char* name : {"small_ascii", "small_binary", "small_binary_zlib", "small_binary_lz4_big", "small_raw",
                             "small_raw_lz4", "small_base64", "small_base64_zlib", "rational", "cells2"}) {
        const std::string good = read_file(sample_file(std::string(name) + ".vtu"));
        for (int variant = 0; variant < 200; ++variant) {
            INFO(name << ", variant " << variant);
            try {
                const SourceVolume source = open_vtk({folder.write("damaged.vtu", damaged_text(good, random))});
                std::vector<elvis_source_element> elements(source.info().n_elements);
                source.elements(0, elements.size(), elements);
                std::vector<double> values(source.n_values());
                std::array<double, 3> x;
                for (std::uint64_t element = 0; element < elements.size(); ++element) {
                    source.sample(0, element, native::Point{-0.4, -0.5, -0.6}, values);
                    source.evaluate_mapping(element, native::Point{-0.4, -0.5, -0.6}, x);
                }
                ++n_read;
            } catch (const Error& error) {
                ++n_refused;
                CHECK(std::string(error.what()).size() > 20);
            }
        }
    }
    // Files that name others: small_raw.vtu as the one piece of the one step.
    folder.write("piece.vtu", read_file(sample_file("small_raw.vtu")));
    const std::string parallel = R"(<VTKFile type="PUnstructuredGrid" version="1.0"><PUnstructuredGrid GhostLevel="0">
        <Piece Source="piece.vtu"/></PUnstructuredGrid></VTKFile>)";
    const std::string collection = R"(<VTKFile type="Collection" version="0.1"><Collection>
        <DataSet timestep="0" part="0" file="all.pvtu"/><DataSet timestep="1" file="piece.vtu"/></Collection></VTKFile>)";
    for (int variant = 0; variant < 200; ++variant) {
        INFO("collection, variant " << variant);
        folder.write("all.pvtu", variant % 2 == 0 ? damaged_text(parallel, random) : parallel);
        try {
            open_vtk({folder.write("all.pvd", variant % 2 == 0 ? collection : damaged_text(collection, random))});
            ++n_read;
        } catch (const Error&) {
            ++n_refused;
        }
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    WARN(n_refused << " refused, " << n_read << " read, at most " << usage.ru_maxrss / 1024 << " MiB of memory");
    CHECK(n_refused > 500);
    CHECK(usage.ru_maxrss < 2048 * 1024);
}
