// Wavefront OBJ: lines "v x y z" and "f a/.. b/.. c/.. ...", indices from 1, or from -1 backwards. Normals, texture
// coordinates, groups and materials mean nothing here; free-form curves and surfaces are refused rather than left out.
#include <core/base/vector3.hpp>
#include <core/surface/mesh_cursor.hpp>

#include <algorithm>

namespace elvis {

namespace {

std::uint32_t corner_of(const MeshCursor& cursor, std::string_view word, std::size_t n_points) {
    const std::int64_t index = cursor.integer(word.substr(0, word.find('/')));
    const auto n = static_cast<std::int64_t>(n_points);
    const std::int64_t from_zero = index > 0 ? index - 1 : n + index;
    if (index == 0 || from_zero < 0 || from_zero >= n) {
        cursor.fail("a face names point " + std::to_string(index) + "; there are " + std::to_string(n) + " so far");
    }
    return static_cast<std::uint32_t>(from_zero);
}

} // namespace

TriangleMesh read_obj(const std::string& path, std::string_view text) {
    MeshCursor cursor(path, text);
    MeshBuilder builder(cursor);
    std::string continued;
    while (const auto line = cursor.line()) {
        std::string_view whole = *line;
        // A backslash at its end continues a line.
        if (!whole.empty() && whole.back() == '\\') {
            continued.append(whole.substr(0, whole.size() - 1)).append(" ");
            continue;
        }
        continued.append(whole);
        const std::string own = std::move(continued);
        continued.clear();
        const std::vector<std::string_view> words = words_of(std::string_view(own).substr(0, own.find('#')));
        if (words.empty()) {
            continue;
        }
        if (words[0] == "v") {
            if (words.size() < 4) {
                cursor.fail("a point needs three coordinates");
            }
            const Vector3 point = {cursor.number(words[1]), cursor.number(words[2]), cursor.number(words[3])};
            if (const auto fault = MeshBuilder::fault_of(point)) {
                cursor.fail(*fault);
            }
            builder.add_point(point);
        } else if (words[0] == "f") {
            if (words.size() < 4) {
                cursor.fail("a face needs three points at least");
            }
            std::vector<std::uint32_t> corners;
            for (std::size_t i = 1; i < words.size(); ++i) {
                corners.push_back(corner_of(cursor, words[i], builder.mesh.points.size()));
            }
            builder.add_polygon(corners);
        } else if (words[0] == "surf" || words[0] == "curv" || words[0] == "cstype") {
            cursor.fail("free-form geometry is not read; patches can be given as a Bezier surface");
        }
    }
    return std::move(builder.mesh);
}

} // namespace elvis
