// The writer is atomic and refuses what is no volume.
#include "volume_fixture.hpp"

#include <catch2/catch.hpp>

#include <limits>

using namespace elvis::native;
using Catch::Matchers::Contains;

TEST_CASE("Without commit nothing is left behind") {
    const TemporaryFolder folder;
    const VolumeData data = small_volume();
    {
        Writer writer(folder.path("volume.h5"), data.description);
        write_blocks(writer, data);
        CHECK(names_in(folder).size() == 1); // the temporary file lies beside the target
        CHECK(names_in(folder)[0] != "volume.h5");
    }
    CHECK(names_in(folder).empty());
    try {
        Writer writer(folder.path("volume.h5"), data.description);
        throw 1;
    } catch (int) {
    }
    CHECK(names_in(folder).empty());
}

TEST_CASE("What was there stays until commit") {
    const TemporaryFolder folder;
    const VolumeData data = small_volume();
    write(folder.path("volume.h5"), data);
    VolumeData changed = data;
    changed.geometry[0][0] += 1;
    Writer writer(folder.path("volume.h5"), changed.description);
    write_blocks(writer, changed);
    CHECK(identical(read_all(folder.path("volume.h5")), data));
    writer.commit();
    CHECK(identical(read_all(folder.path("volume.h5")), changed));
    CHECK(names_in(folder) == std::vector<std::string>{"volume.h5"});
}

TEST_CASE("Two writers of one file do not disturb each other") {
    const TemporaryFolder folder;
    const VolumeData first = small_volume();
    VolumeData second = first;
    second.geometry[0][0] += 1;
    Writer a(folder.path("volume.h5"), first.description);
    Writer b(folder.path("volume.h5"), second.description);
    write_blocks(a, first);
    write_blocks(b, second);
    a.commit();
    b.commit();
    CHECK(identical(read_all(folder.path("volume.h5")), second));
    CHECK(names_in(folder).size() == 1);
}

TEST_CASE("Commit refuses what is incomplete and names it") {
    const TemporaryFolder folder;
    const VolumeData data = small_volume();
    const auto commit_without = [&](const std::string& part) {
        Writer writer(folder.path("volume.h5"), data.description);
        for (std::size_t i = 0; i < 2; ++i) {
            // Element 0 twice instead of elements 0 and 1.
            const auto n = std::uint64_t{2};
            if (part == "geometry") {
                writer.write_geometry(i, 0, 1, std::span(data.geometry[i]).first(data.geometry[i].size() / 2));
                writer.write_geometry(i, 0, 1, std::span(data.geometry[i]).first(data.geometry[i].size() / 2));
            } else {
                writer.write_geometry(i, 0, n, data.geometry[i]);
            }
            if (part == "numbers")
                writer.write_numbers(i, 1, 1, std::span(data.numbers[i]).last(1));
            else
                writer.write_numbers(i, 0, n, part == "permutation" ? data.numbers[0] : data.numbers[i]);
            writer.write_field(0, 0, i, 0, n, data.fields[0][0][i]);
            writer.write_field(0, part == "field" ? 0 : 1, i, 0, n, data.fields[0][1][i]);
        }
        writer.write_faces(0, part == "faces" ? 5 : 6, std::span(data.faces).first(part == "faces" ? 5 : 6));
        writer.commit();
    };
    CHECK_THROWS_WITH(commit_without("geometry"), Contains("geometry of class 0") && Contains("row 1"));
    CHECK_THROWS_WITH(commit_without("numbers"), Contains("numbers of class 0") && Contains("row 0"));
    CHECK_THROWS_WITH(commit_without("permutation"), Contains("no element has the number"));
    CHECK_THROWS_WITH(commit_without("field"), Contains("field 'p'") && Contains("time step 1"));
    CHECK_THROWS_WITH(commit_without("faces"), Contains("faces") && Contains("row 5"));
    CHECK(names_in(folder).empty());
    CHECK_NOTHROW(commit_without("nothing"));
}

TEST_CASE("A folder that cannot be written is an error that names the file") {
    const TemporaryFolder folder;
    const VolumeData data = small_volume();
    const std::string missing = folder.path("no/such/folder/volume.h5");
    CHECK_THROWS_WITH(Writer(missing, data.description), Contains(missing));
    write_bytes(folder.path("file"), {'x'});
    CHECK_THROWS_AS(Writer(folder.path("file") + "/volume.h5", data.description), FileError);
    // A folder in the target's place is found at the end at the latest, and nothing is left beside it.
    std::filesystem::create_directory(folder.path("volume.h5"));
    {
        Writer writer(folder.path("volume.h5"), data.description);
        write_blocks(writer, data);
        CHECK_THROWS_AS(writer.commit(), FileError);
    }
    CHECK(names_in(folder).size() == 2);
}

TEST_CASE("The writer refuses descriptions that no reader would accept") {
    const TemporaryFolder folder;
    const auto refused = [&](const auto& change) {
        Description d = small_volume().description;
        change(d);
        CHECK_THROWS_AS(Writer(folder.path("volume.h5"), d), FileError);
    };
    refused([](Description& d) { d.classes.clear(); });
    refused([](Description& d) { d.times.clear(); });
    refused([](Description& d) { d.dimension = 2; });
    refused([](Description& d) { d.dimension = 4; });
    refused([](Description& d) { d.classes[0].n_elements = 0; });
    refused([](Description& d) { d.classes[0].n_elements = std::numeric_limits<std::uint64_t>::max(); });
    refused([](Description& d) { d.classes[0].fields.clear(); });
    refused([](Description& d) { d.classes[0].fields[0].shape = Shape::prism; });
    refused([](Description& d) { d.classes[0].fields[0].order = {31, 31, 31}; });
    refused([](Description& d) { d.classes[0].geometry.order = {0, 0, 0}; });
    refused([](Description& d) { d.fields[0].name = ""; });
    refused([](Description& d) { d.fields[0].n_components = 0; });
    refused([](Description& d) { d.fields[0].transform = Transform::covariant; });
    refused([](Description& d) {
        d.fields.push_back(d.fields[0]);
        for (ElementClass& element_class : d.classes)
            element_class.fields.push_back(element_class.fields[0]);
    });
    CHECK(names_in(folder).empty());
}

TEST_CASE("The writer refuses numbers and faces out of range") {
    const TemporaryFolder folder;
    const VolumeData data = small_volume();
    Writer writer(folder.path("volume.h5"), data.description);
    CHECK_THROWS_AS(writer.write_numbers(0, 0, 2, std::vector<std::int64_t>{0, 4}), FileError);
    CHECK_THROWS_AS(writer.write_numbers(0, 0, 2, std::vector<std::int64_t>{-1, 0}), FileError);
    for (const Face face :
         {Face{4, -1, 0, -1, -1}, Face{0, 4, 0, 0, -1}, Face{0, -3, 0, -1, -1}, Face{0, -1, 6, -1, -1}, Face{0, -1, 0, -1, 1}})
        CHECK_THROWS_AS(writer.write_faces(0, 1, std::vector<Face>{face}), FileError);
    CHECK_THROWS_AS(writer.write_geometry(0, 1, 2, data.geometry[0]), FileError);
}
