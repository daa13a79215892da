// The reader refuses files that are no native volume, and says what is wrong with which object.
#include "volume_fixture.hpp"

#include <catch2/catch.hpp>

#include <hdf5.h>
#include <unistd.h>

#include <functional>

using namespace elvis::native;
using Catch::Matchers::Contains;

namespace {

// Opens an HDF5 file for change.
void edit(const std::string& path, const std::function<void(hid_t)>& change) {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    REQUIRE(file >= 0);
    change(file);
    REQUIRE(H5Fclose(file) >= 0);
}

void set_attribute(hid_t file, const std::string& object, const std::string& name, hid_t type, const void* values,
                   hsize_t count) {
    const hid_t id = H5Oopen(file, object.c_str(), H5P_DEFAULT);
    REQUIRE(id >= 0);
    if (H5Aexists(id, name.c_str()) > 0)
        H5Adelete(id, name.c_str());
    const hid_t space = count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr);
    const hid_t attribute = H5Acreate2(id, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT);
    REQUIRE(H5Awrite(attribute, type, values) >= 0);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Oclose(id);
}

template <class T>
void set_attribute(hid_t file, const std::string& object, const std::string& name, hid_t type, const std::vector<T>& values) {
    set_attribute(file, object, name, type, values.data(), values.size());
}

void set_text(hid_t file, const std::string& object, const std::string& name, const std::string& text) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, text.size());
    set_attribute(file, object, name, type, text.data(), 1);
    H5Tclose(type);
}

// A dataset in place of another, stored in one chunk.
template <class T>
void replace_dataset(hid_t file, const std::string& path, hid_t type, const std::vector<hsize_t>& shape, std::vector<T> values,
                     bool checksum = true) {
    REQUIRE(H5Ldelete(file, path.c_str(), H5P_DEFAULT) >= 0);
    const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(list, static_cast<int>(shape.size()), shape.data());
    if (checksum)
        H5Pset_fletcher32(list);
    const hid_t dataset = H5Dcreate2(file, path.c_str(), type, space, H5P_DEFAULT, list, H5P_DEFAULT);
    REQUIRE(dataset >= 0);
    if (!values.empty())
        REQUIRE(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
    H5Dclose(dataset);
    H5Pclose(list);
    H5Sclose(space);
}

// What the reader says to the small volume after a change; empty if it accepts it.
std::string complaint(const std::function<void(hid_t)>& change) {
    const TemporaryFolder folder;
    const std::string path = folder.path("volume.h5");
    write(path, small_volume());
    edit(path, change);
    try {
        read_all(path);
        return "";
    } catch (const FileError& error) {
        CHECK(error.file() == path);
        const std::string text = error.what();
        CHECK(text.find(path) == 0);
        return text.substr(path.size());
    }
}

} // namespace

TEST_CASE("Files that are no native volume are refused") {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& path) {
        CHECK(Reader::probe(path) == 0);
        CHECK_THROWS_AS(Reader(path), FileError);
        CHECK_THROWS_WITH(Reader(path), Contains(path));
    };
    refused(folder.path("missing.h5"));
    refused(folder.path(""));
    write_bytes(folder.path("empty"), {});
    refused(folder.path("empty"));
    write_bytes(folder.path("text"), {'n', 'o', 't', ' ', 'H', 'D', 'F', '5'});
    refused(folder.path("text"));
    const hid_t file = H5Fcreate(folder.path("other.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    H5Fclose(file);
    refused(folder.path("other.h5"));
    CHECK_THROWS_WITH(Reader(folder.path("missing.h5")), Contains("no such file"));
}

TEST_CASE("The mark and the major version must agree") {
    CHECK_THAT(complaint([](hid_t file) { set_text(file, "/", "format", "something else"); }), Contains("format"));
    CHECK_THAT(complaint([](hid_t file) {
                   set_attribute<std::uint32_t>(file, "/", "version", H5T_STD_U32LE, {2, 0});
               }),
               Contains("version") && Contains("2.0"));
    CHECK(complaint([](hid_t file) { set_attribute<std::uint32_t>(file, "/", "version", H5T_STD_U32LE, {1, 99}); }).empty());
}

TEST_CASE("Missing objects are named") {
    for (const char* path : {"/times", "/faces", "/boundary_groups", "/notes", "/classes", "/classes/1/geometry",
                             "/classes/0/numbers", "/fields/0", "/fields/0/1/coefficients"}) {
        CAPTURE(path);
        CHECK_THAT(complaint([&](hid_t file) { H5Ldelete(file, path, H5P_DEFAULT); }), Contains(path) && Contains("missing"));
    }
    for (const char* name : {"format", "version", "dimension", "n_elements", "n_classes", "n_fields", "n_times", "n_faces",
                             "n_boundary_groups", "n_notes"}) {
        CAPTURE(name);
        CHECK_THAT(complaint([&](hid_t file) { H5Adelete(file, name); }), Contains(name) && Contains("missing"));
    }
    for (const char* name : {"shape", "geometry_basis", "geometry_order", "n_elements"}) {
        CAPTURE(name);
        CHECK_THAT(complaint([&](hid_t file) { H5Adelete_by_name(file, "/classes/1", name, H5P_DEFAULT); }),
                   Contains(std::string("/classes/1/") + name) && Contains("missing"));
    }
    for (const char* name : {"name", "unit", "n_components", "continuity", "transform", "max_jump"}) {
        CAPTURE(name);
        CHECK_THAT(complaint([&](hid_t file) { H5Adelete_by_name(file, "/fields/0", name, H5P_DEFAULT); }),
                   Contains(std::string("/fields/0/") + name) && Contains("missing"));
    }
}

TEST_CASE("Wrong types and shapes are refused") {
    const std::vector<double> four(4, 0.5);
    CHECK_THAT(complaint([&](hid_t file) {
                   replace_dataset<double>(file, "/classes/0/numbers", H5T_IEEE_F64LE, {2}, {0, 1});
               }),
               Contains("/classes/0/numbers has another type than little-endian int64"));
    CHECK_THAT(complaint([&](hid_t file) {
                   replace_dataset<std::int64_t>(file, "/classes/0/numbers", H5T_STD_I64LE, {3}, {0, 1, 2});
               }),
               Contains("/classes/0/numbers has the shape (3)") && Contains("(2)"));
    CHECK_THAT(complaint([&](hid_t file) {
                   replace_dataset<float>(file, "/classes/1/geometry", H5T_IEEE_F32LE, {2, 3, 4}, std::vector<float>(24, 1.0F));
               }),
               Contains("/classes/1/geometry has another type than little-endian float64"));
    CHECK_THAT(complaint([&](hid_t file) {
                   replace_dataset<double>(file, "/classes/1/geometry", H5T_IEEE_F64LE, {2, 3, 4}, std::vector<double>(24, 1.0),
                                           false);
               }),
               Contains("/classes/1/geometry has no checksums"));
    CHECK_THAT(complaint([&](hid_t file) {
                   replace_dataset<double>(file, "/classes/1/geometry", H5T_IEEE_F64LE, {2, 3, 4}, {});
               }),
               Contains("/classes/1/geometry is incomplete"));
    CHECK_THAT(complaint([](hid_t file) { set_attribute<std::int32_t>(file, "/", "n_fields", H5T_STD_I32LE, {1}); }),
               Contains("n_fields has another type than little-endian unsigned int32"));
    CHECK_THAT(complaint([](hid_t file) {
                   set_attribute<std::uint32_t>(file, "/classes/0", "geometry_order", H5T_STD_U32LE, {1, 1});
               }),
               Contains("geometry_order has 2 values"));
    CHECK_THAT(complaint([](hid_t file) { set_attribute<double>(file, "/", "format", H5T_IEEE_F64LE, {1}); }),
               Contains("not text"));
    CHECK_THAT(complaint([](hid_t file) {
                   const hid_t type = H5Tcopy(H5T_C_S1);
                   H5Tset_size(type, H5T_VARIABLE);
                   const char* text = "ElVis native volume";
                   set_attribute<const char*>(file, "/", "format", type, {text});
                   H5Tclose(type);
               }),
               Contains("not text of fixed length"));
}

TEST_CASE("Inconsistent counts are refused before memory is asked for") {
    const auto huge = std::uint64_t{1} << 62;
    CHECK_THAT(complaint([&](hid_t file) { set_attribute<std::uint64_t>(file, "/", "n_elements", H5T_STD_U64LE, {5}); }),
               Contains("n_elements"));
    for (const std::uint64_t n : {huge, std::uint64_t{1} << 39, std::uint64_t{3}, std::uint64_t{0}}) {
        CAPTURE(n);
        CHECK_THAT(
            complaint([&](hid_t file) { set_attribute<std::uint64_t>(file, "/classes/0", "n_elements", H5T_STD_U64LE, {n}); }),
            Contains("/classes/0"));
        CHECK_THAT(complaint([&](hid_t file) { set_attribute<std::uint64_t>(file, "/", "n_times", H5T_STD_U64LE, {n}); }),
                   Contains("times"));
        if (n != 0)
            CHECK_THAT(complaint([&](hid_t file) { set_attribute<std::uint64_t>(file, "/", "n_faces", H5T_STD_U64LE, {n}); }),
                       Contains("faces"));
    }
    for (const std::uint32_t n : {0xffffffffU, 3U}) {
        CHECK_THAT(complaint([&](hid_t file) { set_attribute<std::uint32_t>(file, "/", "n_classes", H5T_STD_U32LE, {n}); }),
                   Contains("classes"));
        CHECK_THAT(complaint([&](hid_t file) { set_attribute<std::uint32_t>(file, "/", "n_fields", H5T_STD_U32LE, {n}); }),
                   Contains("fields"));
        CHECK_THAT(complaint([&](hid_t file) { set_attribute<std::uint32_t>(file, "/", "n_notes", H5T_STD_U32LE, {n}); }),
                   Contains("notes"));
    }
    CHECK_THAT(complaint([&](hid_t file) { set_attribute<std::uint32_t>(file, "/", "dimension", H5T_STD_U32LE, {2}); }),
               Contains("dimension"));
}

TEST_CASE("Spaces that do not exist are refused") {
    CHECK_THAT(complaint([](hid_t file) {
                   set_attribute<std::uint32_t>(file, "/classes/1", "geometry_order", H5T_STD_U32LE, {40, 40, 40});
               }),
               Contains("/classes/1") && Contains("largest order"));
    CHECK_THAT(complaint([](hid_t file) {
                   set_attribute<std::uint32_t>(file, "/fields/0/1", "order", H5T_STD_U32LE, {3, 2, 2});
               }),
               Contains("/fields/0/1") && Contains("tetrahedron"));
    CHECK_THAT(complaint([](hid_t file) { set_text(file, "/fields/0/0", "basis", "fourier"); }), Contains("fourier"));
    CHECK_THAT(complaint([](hid_t file) { set_text(file, "/classes/0", "shape", "cube"); }), Contains("cube"));
    CHECK_THAT(complaint([](hid_t file) { set_text(file, "/classes/0", "shape", "prism"); }), Contains("shape"));
    CHECK_THAT(complaint([](hid_t file) { set_text(file, "/fields/0", "transform", "covariant"); }), Contains("components"));
    CHECK_THAT(complaint([](hid_t file) { set_text(file, "/fields/0", "continuity", "perhaps"); }), Contains("continuity"));
}

TEST_CASE("Element numbers must be a permutation, faces must name elements and faces that exist") {
    const auto set_numbers = [](std::vector<std::int64_t> values) {
        return [values](hid_t file) { replace_dataset<std::int64_t>(file, "/classes/0/numbers", H5T_STD_I64LE, {2}, values); };
    };
    const std::vector<std::int64_t> others = small_volume().numbers[1];
    CHECK_THAT(complaint(set_numbers({others[0], others[1]})), Contains("second element"));
    CHECK_THAT(complaint(set_numbers({-1, 0})), Contains("number -1"));
    CHECK_THAT(complaint(set_numbers({4, 0})), Contains("number 4"));

    const VolumeData data = small_volume();
    const auto set_first_face = [&](std::vector<std::int64_t> row) {
        return [&data, row](hid_t file) {
            std::vector<std::int64_t> rows = row;
            for (std::size_t i = 1; i < data.faces.size(); ++i) {
                const Face& face = data.faces[i];
                rows.insert(rows.end(), {face.element, face.neighbour, face.local_face, face.neighbour_local_face, face.group});
            }
            replace_dataset<std::int64_t>(file, "/faces", H5T_STD_I64LE, {6, 5}, rows);
        };
    };
    const std::int64_t tetrahedron = others[0];
    CHECK(complaint(set_first_face({tetrahedron, -1, 3, -1, 0})).empty());
    CHECK_THAT(complaint(set_first_face({tetrahedron, -1, 4, -1, 0})), Contains("shape does not have"));
    CHECK_THAT(complaint(set_first_face({data.numbers[0][0], tetrahedron, 5, 4, -1})), Contains("shape does not have"));
    CHECK_THAT(complaint(set_first_face({4, -1, 0, -1, 0})), Contains("element 4") && Contains("row 0"));
    CHECK_THAT(complaint(set_first_face({0, 4, 0, 0, 0})), Contains("neighbour 4"));
    CHECK_THAT(complaint(set_first_face({0, -1, 0, -1, 1})), Contains("group 1"));
    CHECK_THAT(complaint(set_first_face({0, -1, std::int64_t{1} << 32, -1, 0})), Contains("out of range"));
}

TEST_CASE("HDF5 prints nothing, and its printer is as before") {
    const TemporaryFolder folder;
    write(folder.path("volume.h5"), small_volume());
    H5Eset_auto2(H5E_DEFAULT, reinterpret_cast<H5E_auto2_t>(H5Eprint2), stderr);
    read_all(folder.path("volume.h5"));
    CHECK(Reader::probe(folder.path("missing.h5")) == 0);
    H5E_auto2_t printer = nullptr;
    void* stream = nullptr;
    H5Eget_auto2(H5E_DEFAULT, &printer, &stream);
    CHECK(printer != nullptr);
    CHECK(stream == stderr);

    std::vector<char> bytes = read_bytes(folder.path("volume.h5"));
    bytes.resize(bytes.size() / 2);
    write_bytes(folder.path("volume.h5"), bytes);
    const int saved = dup(2);
    FILE* captured = std::tmpfile();
    REQUIRE(captured != nullptr);
    dup2(fileno(captured), 2);
    std::string text;
    try {
        const Reader reader(folder.path("volume.h5"));
    } catch (const FileError& error) {
        text = error.what();
    }
    dup2(saved, 2);
    close(saved);
    CHECK(std::fseek(captured, 0, SEEK_END) == 0);
    CHECK(std::ftell(captured) == 0);
    std::fclose(captured);
    CHECK_THAT(text, Contains("truncated")); // HDF5's own reason is in the message
}
