#include <core/base/error.hpp>
#include <core/base/infinity.hpp>
#include <core/base/whole_file.hpp>
#include <core/surface/mesh_cursor.hpp>
#include <core/surface/patch_mesh.hpp>

#include <algorithm>
#include <limits>

namespace elvis {

namespace {

/** Weights of the four control points in the blossom at (x, y, z). */
std::array<double, 4> blossom(double x, double y, double z) {
    const double a = 1 - x, b = 1 - y, c = 1 - z;
    return {a * b * c, x * b * c + a * y * c + a * b * z, x * y * c + x * b * z + a * y * z, x * y * z};
}

/** Those of the control points over [from, to]. */
std::array<std::array<double, 4>, 4> part_weights(double from, double to) {
    return {blossom(from, from, from), blossom(from, from, to), blossom(from, to, to), blossom(to, to, to)};
}

} // namespace

Vector3 BezierPatch::at(double u, double v) const {
    const auto of_u = blossom(u, u, u), of_v = blossom(v, v, v);
    Vector3 point{};
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            point = plus(point, scaled(points[4 * i + j], of_u[i] * of_v[j]));
        }
    }
    return point;
}

BezierPatch BezierPatch::part(double u0, double v0, double h) const {
    const auto of_u = part_weights(u0, u0 + h), of_v = part_weights(v0, v0 + h);
    BezierPatch result;
    for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t l = 0; l < 4; ++l) {
            for (std::size_t i = 0; i < 4; ++i) {
                for (std::size_t j = 0; j < 4; ++j) {
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        result.points[4 * k + l][axis] += of_u[k][i] * of_v[l][j] * points[4 * i + j][axis];
                    }
                }
            }
        }
    }
    return result;
}

std::array<double, 6> PatchMesh::bounds() const {
    std::array<double, 6> box = {infinity, infinity, infinity, -infinity, -infinity, -infinity};
    for (const BezierPatch& patch : patches) {
        for (const auto& point : patch.points) {
            for (std::size_t i = 0; i < 3; ++i) {
                box[i] = std::min(box[i], point[i]);
                box[i + 3] = std::max(box[i + 3], point[i]);
            }
        }
    }
    return box;
}

PatchMesh read_bpt(const std::string& path, std::string_view text) {
    MeshCursor cursor(path, text);
    const std::int64_t n_patches = cursor.integer(cursor.word());
    // A patch takes 2 + 48 numbers of one digit and a space at least.
    if (n_patches < 1 || static_cast<std::uint64_t>(n_patches) > text.size() / 100 + 1) {
        cursor.fail("there cannot be " + std::to_string(n_patches) + " patches in this file");
    }
    PatchMesh mesh;
    mesh.path = path;
    for (std::int64_t i = 0; i < n_patches; ++i) {
        const std::int64_t order_u = cursor.integer(cursor.word()), order_v = cursor.integer(cursor.word());
        if (order_u != 3 || order_v != 3) {
            cursor.fail("patch " + std::to_string(i) + " has orders " + std::to_string(order_u) + " and " +
                        std::to_string(order_v) + "; only bicubic ones (3 3) are read");
        }
        BezierPatch patch;
        for (auto& point : patch.points) {
            for (double& coordinate : point) {
                coordinate = cursor.number(cursor.word());
            }
            if (const auto fault = MeshBuilder::fault_of(point)) {
                cursor.fail(*fault);
            }
        }
        mesh.patches.push_back(patch);
    }
    if (!cursor.word().empty()) {
        cursor.fail("there is more than the " + std::to_string(n_patches) + " patches that the first line announces");
    }
    return mesh;
}

PatchMesh read_patch_mesh(const std::string& path) {
    if (mesh_ending(path) != ".bpt") {
        throw Error(path, "is no file of Bezier patches that can be read: its name does not end in .bpt");
    }
    return read_bpt(path, read_whole_file(path));
}

} // namespace elvis
