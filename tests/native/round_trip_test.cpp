// What is written is read back, whole and in parts.
#include "volume_fixture.hpp"

#include <elvis/native/extrema.hpp>

#include <catch2/catch.hpp>

#include <cstring>
#include <thread>

using namespace elvis::native;

TEST_CASE("A volume is read back bit by bit") {
    const TemporaryFolder folder;
    for (const VolumeData& data : {small_volume(), large_volume()}) {
        write(folder.path("volume.h5"), data);
        CHECK(identical(read_all(folder.path("volume.h5")), data));
        CHECK(Reader::probe(folder.path("volume.h5")) == 100);
    }
}

TEST_CASE("Parts of a solver are stored by the elements' numbers, and those that do not exist are refused") {
    const TemporaryFolder folder;
    VolumeData data = small_volume();
    write(folder.path("none.h5"), data);
    CHECK(Reader(folder.path("none.h5")).description().n_parts == 0);
    const std::uint64_t n = data.description.n_elements();
    std::vector<std::uint32_t> parts(n);
    for (std::uint64_t element = 0; element < n; ++element) {
        parts[element] = static_cast<std::uint32_t>(element % 2);
    }
    data.description.n_parts = 2;
    CHECK_THROWS_AS(write(folder.path("missing.h5"), data), FileError);
    write(folder.path("parts.h5"), data, parts);
    const Reader reader(folder.path("parts.h5"));
    CHECK(reader.description().n_parts == 2);
    std::vector<std::uint32_t> found(n - 1);
    reader.read_parts(1, found);
    CHECK(std::ranges::equal(found, std::span(parts).subspan(1)));
    parts.back() = 2;
    CHECK_THROWS_AS(write(folder.path("beyond.h5"), data, parts), FileError);
}

TEST_CASE("Extrema of fields without a transform are stored with the volume") {
    const TemporaryFolder folder;
    for (const VolumeData& data : {small_volume(), large_volume()}) {
        write(folder.path("volume.h5"), data);
        const Reader reader(folder.path("volume.h5"));
        const Description& d = reader.description();
        for (std::size_t field = 0; field < d.fields.size(); ++field)
            for (std::size_t step = 0; step < d.times.size(); ++step) {
                const std::vector<Extrema> stored = reader.read_extrema(field, step);
                if (d.fields[field].transform != Transform::none) {
                    CHECK(stored.empty());
                    continue;
                }
                const std::vector<Extrema> found = find_extrema(reader, field, step);
                REQUIRE(stored.size() == found.size());
                for (std::size_t entry = 0; entry < found.size(); ++entry) {
                    CHECK(stored[entry].minimum.value == found[entry].minimum.value);
                    CHECK(stored[entry].maximum.bound == found[entry].maximum.bound);
                    CHECK(stored[entry].maximum.element_class == found[entry].maximum.element_class);
                    CHECK(stored[entry].maximum.element == found[entry].maximum.element);
                    CHECK(stored[entry].maximum.xi == found[entry].maximum.xi);
                }
            }
    }
}

TEST_CASE("Parts of a volume are read alone") {
    const TemporaryFolder folder;
    const VolumeData data = large_volume();
    write(folder.path("volume.h5"), data);
    const Reader reader(folder.path("volume.h5"));
    const Description& d = reader.description();
    for (std::size_t i = 0; i < d.classes.size(); ++i) {
        const std::uint64_t n = d.classes[i].n_elements;
        for (const std::uint64_t first : {std::uint64_t{0}, n / 3, n - 1}) {
            const std::uint64_t count = std::min<std::uint64_t>(97, n - first);
            const auto expect = [&](const auto& part, const auto& whole) {
                const std::size_t row = part.size() / count;
                CHECK(std::memcmp(part.data(), whole.data() + first * row, part.size() * sizeof(part[0])) == 0);
            };
            std::vector<double> geometry(count * 3 * n_modes(d.classes[i].geometry));
            reader.read_geometry(i, first, count, geometry);
            expect(geometry, data.geometry[i]);
            std::vector<std::int64_t> numbers(count);
            reader.read_numbers(i, first, count, numbers);
            expect(numbers, data.numbers[i]);
            for (std::size_t field = 0; field < d.fields.size(); ++field)
                for (std::size_t step = 0; step < d.times.size(); ++step) {
                    std::vector<double> part(count * d.fields[field].n_components * n_modes(d.classes[i].fields[field]));
                    reader.read_field(field, step, i, first, count, part);
                    expect(part, data.fields[field][step][i]);
                }
        }
    }
    std::vector<Face> faces(10);
    reader.read_faces(4321, 10, faces);
    for (std::size_t i = 0; i < 10; ++i)
        CHECK(faces[i].element == data.faces[4321 + i].element);
    reader.read_faces(5000, 0, {});
    CHECK_THROWS_AS(reader.read_faces(4995, 10, faces), FileError);
    std::vector<std::int64_t> numbers(10);
    CHECK_THROWS_AS(reader.read_numbers(0, d.classes[0].n_elements, 10, numbers), FileError);
}

TEST_CASE("Blocks may be written in any order") {
    const TemporaryFolder folder;
    const VolumeData data = large_volume();
    const Description& d = data.description;
    Writer writer(folder.path("volume.h5"), d);
    writer.write_faces(2500, 2500, std::span(data.faces).subspan(2500));
    writer.write_faces(0, 2500, std::span(data.faces).first(2500));
    const auto blocks = [](std::uint64_t n, const auto& write_block) {
        for (std::uint64_t end = n; end > 0;) {
            const std::uint64_t first = end > 60 ? end - 60 : 0;
            write_block(first, end - first);
            end = first;
        }
    };
    for (std::size_t step = d.times.size(); step-- > 0;)
        for (std::size_t i = d.classes.size(); i-- > 0;)
            blocks(d.classes[i].n_elements, [&](std::uint64_t first, std::uint64_t count) {
                for (std::size_t field = 0; field < d.fields.size(); ++field) {
                    const std::size_t row = d.fields[field].n_components * n_modes(d.classes[i].fields[field]);
                    writer.write_field(field, step, i, first, count,
                                       std::span(data.fields[field][step][i]).subspan(first * row, count * row));
                }
                const std::size_t row = 3 * n_modes(d.classes[i].geometry);
                writer.write_geometry(i, first, count, std::span(data.geometry[i]).subspan(first * row, count * row));
                writer.write_numbers(i, first, count, std::span(data.numbers[i]).subspan(first, count));
            });
    writer.commit();
    CHECK(identical(read_all(folder.path("volume.h5")), data));
}

TEST_CASE("What is known only at the end can be set at the end") {
    const TemporaryFolder folder;
    VolumeData data = small_volume();
    Writer writer(folder.path("volume.h5"), data.description);
    write_blocks(writer, data);
    writer.set_max_jump(0, 0.125);
    writer.set_continuity(0, Continuity::discontinuous);
    writer.set_note("source file", "other.xml");
    writer.set_note("converter", "test");
    writer.commit();
    data.description.fields[0].max_jump = 0.125;
    data.description.fields[0].continuity = Continuity::discontinuous;
    data.description.notes = {{"source file", "other.xml"}, {"converter", "test"}};
    CHECK(identical(read_all(folder.path("volume.h5")), data));
}

TEST_CASE("Two-dimensional volumes are volumes") {
    const TemporaryFolder folder;
    VolumeData data = small_volume();
    Description& d = data.description;
    d.dimension = 2;
    d.classes = {{{Shape::triangle, Basis::modified, {1, 1, 0}}, {{Shape::triangle, Basis::modified, {2, 2, 0}}}, 4}};
    d.n_faces = 0;
    d.times = {0};
    data.geometry = {std::vector<double>(4 * 9, 0.5)};
    data.numbers = {{3, 1, 0, 2}};
    data.fields = {{{std::vector<double>(4 * 6, 0.25)}}};
    data.faces.clear();
    write(folder.path("plane.h5"), data);
    CHECK(identical(read_all(folder.path("plane.h5")), data));
}

TEST_CASE("Readers in different threads do not disturb each other") {
    const TemporaryFolder folder;
    const VolumeData data = small_volume();
    write(folder.path("a.h5"), data);
    write(folder.path("b.h5"), data);
    const auto work = [&](const std::string& name, bool& is_good) {
        is_good = true;
        for (int i = 0; i < 20; ++i)
            is_good = is_good && identical(read_all(folder.path(name)), data);
    };
    bool first = false;
    bool second = false;
    std::thread other(work, "a.h5", std::ref(first));
    work("b.h5", second);
    other.join();
    CHECK(first);
    CHECK(second);
}
