// Files of buffers say themselves what is in them, and the page on them says the same.

#include "fixture.hpp"
#include "stage.hpp"

#include <core/scene/output/buffers_file.hpp>
#include <core/scene/output/pixel_flags.hpp>

#include <hdf5.h>

#include <bit>

using namespace elvis;
using namespace elvis::test;

namespace {

std::string text_attribute(hid_t file, const char* object, const char* name) {
    INFO(object << ", " << name);
    const hid_t attribute = H5Aopen_by_name(file, object, name, H5P_DEFAULT, H5P_DEFAULT);
    REQUIRE(attribute >= 0);
    const hid_t type = H5Aget_type(attribute);
    char* text = nullptr;
    REQUIRE(H5Aread(attribute, type, &text) >= 0);
    const std::string result(text);
    H5free_memory(text);
    H5Tclose(type);
    H5Aclose(attribute);
    return result;
}

std::vector<double> number_attribute(hid_t file, const char* name, std::size_t n) {
    INFO(name);
    std::vector<double> numbers(n);
    const hid_t attribute = H5Aopen(file, name, H5P_DEFAULT);
    REQUIRE(attribute >= 0);
    REQUIRE(H5Aget_storage_size(attribute) == n * sizeof(double));
    REQUIRE(H5Aread(attribute, H5T_NATIVE_DOUBLE, numbers.data()) >= 0);
    H5Aclose(attribute);
    return numbers;
}

/** The attribute `bits` as it is in the file: numbers and names. */
std::vector<std::pair<std::uint32_t, std::string>> bits_attribute(hid_t file) {
    const hid_t attribute = H5Aopen_by_name(file, "flags", "bits", H5P_DEFAULT, H5P_DEFAULT);
    REQUIRE(attribute >= 0);
    const hid_t type = H5Aget_type(attribute), space = H5Aget_space(attribute);
    const hid_t row = H5Tcreate(H5T_COMPOUND, sizeof(PixelFlag)), text = H5Tget_member_type(type, 1);
    H5Tinsert(row, "bit", HOFFSET(PixelFlag, bit), H5T_NATIVE_UINT32);
    H5Tinsert(row, "name", HOFFSET(PixelFlag, name), text);
    H5Tinsert(row, "meaning", HOFFSET(PixelFlag, meaning), text);
    std::vector<PixelFlag> rows(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    REQUIRE(H5Aread(attribute, row, rows.data()) >= 0);
    std::vector<std::pair<std::uint32_t, std::string>> bits;
    for (const PixelFlag& flag : rows) {
        bits.emplace_back(flag.bit, flag.name);
        CHECK(std::string(flag.meaning).size() > 10);
    }
    H5Dvlen_reclaim(row, space, H5P_DEFAULT, rows.data());
    for (const hid_t id : {text, row, type}) {
        H5Tclose(id);
    }
    H5Sclose(space);
    H5Aclose(attribute);
    return bits;
}

} // namespace

TEST_CASE("A file of buffers says what its datasets are, in which unit, and of which view") {
    Stage stage;
    const FrameRequest request = stage.request(R"("image": {"size": [8, 6]}, "field": "wave",
        "camera": {"eye": [3, 2, 1], "look_at": [0, 0, 0.5], "up": [0, 0, 1], "field_of_view": 40})");
    const TemporaryFolder folder;
    const std::string path = folder.write("buffers.h5", "");
    write_buffers(stage.renderer.render(request), request, stage.volume, path, Precision::float32);
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    REQUIRE(file >= 0);
    for (const char* dataset : {"color", "value", "depth", "normal", "element", "flags"}) {
        CHECK_FALSE(text_attribute(file, dataset, "description").empty());
        CHECK_FALSE(text_attribute(file, dataset, "unit").empty());
    }
    CHECK(text_attribute(file, "value", "field") == "wave");
    CHECK(text_attribute(file, "value", "unit") == "K");
    CHECK(text_attribute(file, ".", "camera_type") == "perspective");
    CHECK(number_attribute(file, "camera_eye", 3) == std::vector<double>{3, 2, 1});
    CHECK(number_attribute(file, "camera_look_at", 3) == std::vector<double>{0, 0, 0.5});
    CHECK(number_attribute(file, "camera_field_of_view", 1) == std::vector<double>{40});
    const auto bits = bits_attribute(file);
    REQUIRE(bits.size() == pixel_flags().size());
    for (std::size_t i = 0; i < bits.size(); ++i) {
        CHECK(bits[i] == std::pair<std::uint32_t, std::string>(pixel_flags()[i].bit, pixel_flags()[i].name));
    }
    H5Fclose(file);
}

TEST_CASE("Every flag is one bit of its own, and the page on buffers has its number and name") {
    const std::string page = test::read_file(ELVIS_BUFFERS_PAGE);
    std::uint32_t before = 0;
    for (const PixelFlag& flag : pixel_flags()) {
        INFO(flag.name);
        CHECK(std::has_single_bit(flag.bit));
        CHECK(flag.bit > before);
        before = flag.bit;
        CHECK(page.find("| " + std::to_string(flag.bit) + " | `" + flag.name + "` |") != std::string::npos);
    }
}
