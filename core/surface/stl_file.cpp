// STL: binary (80 bytes, a count, 50 bytes a triangle, little-endian) if the size of the file fits that, else text
// ("facet normal . . . outer loop vertex x y z ... endloop endfacet").
#include <core/base/vector3.hpp>
#include <core/surface/mesh_cursor.hpp>

#include <bit>
#include <cstring>

namespace elvis {

namespace {

constexpr std::size_t header_bytes = 84;
constexpr std::size_t record_bytes = 50;

std::uint32_t little_word(const char* bytes) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        word |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
    }
    return word;
}

void add_triangle(MeshBuilder& builder, const std::array<Vector3, 3>& corners) {
    const auto first = static_cast<std::uint32_t>(builder.mesh.points.size());
    for (const auto& corner : corners) {
        builder.add_point(corner);
    }
    const std::array<std::uint32_t, 3> indices = {first, first + 1, first + 2};
    builder.add_polygon(indices);
}

TriangleMesh read_binary(MeshCursor& cursor, std::size_t n_triangles) {
    MeshBuilder builder(cursor);
    builder.mesh.points.reserve(3 * n_triangles);
    builder.mesh.triangles.reserve(n_triangles);
    cursor.bytes(header_bytes);
    for (std::size_t triangle = 0; triangle < n_triangles; ++triangle) {
        // A normal, three corners, two bytes of no meaning.
        const std::span<const char> record = cursor.bytes(record_bytes);
        std::array<Vector3, 3> corners{};
        for (std::size_t i = 0; i < 9; ++i) {
            corners[i / 3][i % 3] = static_cast<double>(std::bit_cast<float>(little_word(record.data() + 12 + 4 * i)));
        }
        for (const auto& corner : corners) {
            if (const auto fault = MeshBuilder::fault_of(corner)) {
                cursor.fail_at_byte("triangle " + std::to_string(triangle) + ": " + *fault);
            }
        }
        add_triangle(builder, corners);
    }
    return std::move(builder.mesh);
}

TriangleMesh read_text(MeshCursor& cursor) {
    MeshBuilder builder(cursor);
    const auto expect = [&cursor](std::string_view found, std::string_view wanted) {
        if (found != wanted) {
            cursor.fail(std::string("'").append(wanted).append("' is expected here"));
        }
    };
    // "solid", and a name of any words.
    cursor.line();
    for (std::string_view word = cursor.word(); !word.empty(); word = cursor.word()) {
        if (word == "endsolid" || word == "solid") {
            // Another solid may follow.
            cursor.line();
            continue;
        }
        expect(word, "facet");
        expect(cursor.word(), "normal");
        for (int i = 0; i < 3; ++i) {
            cursor.number(cursor.word());
        }
        expect(cursor.word(), "outer");
        expect(cursor.word(), "loop");
        std::array<Vector3, 3> corners{};
        for (auto& corner : corners) {
            expect(cursor.word(), "vertex");
            for (double& coordinate : corner) {
                coordinate = cursor.number(cursor.word());
            }
            if (const auto fault = MeshBuilder::fault_of(corner)) {
                cursor.fail(*fault);
            }
        }
        expect(cursor.word(), "endloop");
        expect(cursor.word(), "endfacet");
        add_triangle(builder, corners);
    }
    return std::move(builder.mesh);
}

} // namespace

TriangleMesh read_stl(const std::string& path, std::string_view text) {
    MeshCursor cursor(path, text);
    const std::size_t n_triangles = text.size() >= header_bytes ? little_word(text.data() + header_bytes - 4) : 0;
    if (text.size() >= header_bytes && text.size() == header_bytes + record_bytes * n_triangles) {
        return read_binary(cursor, n_triangles);
    }
    if (text.substr(0, 5) != "solid") {
        cursor.fail_at_byte("is no STL file: it does not start with 'solid', and its size of " + std::to_string(text.size()) +
                            " bytes is not the " + std::to_string(header_bytes + record_bytes * n_triangles) +
                            " that binary data of " + std::to_string(n_triangles) + " triangles would have");
    }
    return read_text(cursor);
}

} // namespace elvis
