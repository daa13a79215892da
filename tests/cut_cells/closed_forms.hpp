/**
 * @file closed_forms.hpp
 * The samples of cut cells, and what is known of them: the ball of radius 0.8, and the level set of the gyroid.
 */
#pragma once

#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/renderer.hpp>
#include <tests/support/device.hpp>

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace elvis::cut_cells {

inline constexpr double radius = 0.8;
inline const std::string ball = CUT_CELLS_SAMPLES "/ball.cut", gyroid = CUT_CELLS_SAMPLES "/gyroid.cut";

inline RuntimeVolume open(const std::string& path) { return RuntimeVolume(Plugin::load(CUT_CELLS_PLUGIN), path); }

/** The ray through a pixel's middle, of a parallel view along `along`, from a plane through `eye`. */
struct View {
    FrameRequest request;
    Vector3 along{}, right{}, top{};

    View() {
        request.width = 120;
        request.height = 90;
        request.camera.orthographic = true;
        request.camera.eye = {1.3, 0.7, 2.9};
        request.camera.up = {0, 1, 0};
        request.camera.height = 1.9;
        along = unit({-1.3, -0.7, -2.9});
        right = unit(cross(along, request.camera.up));
        top = cross(right, along);
    }

    static Vector3 unit(const Vector3& v) {
        const double size = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        return {v[0] / size, v[1] / size, v[2] / size};
    }
    static Vector3 cross(const Vector3& a, const Vector3& b) {
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }

    Vector3 origin(std::size_t pixel) const {
        const double column = static_cast<double>(pixel % request.width), row = static_cast<double>(pixel / request.width);
        const double s = (2 * (column + 0.5) / request.width - 1) * request.width / request.height;
        const double v = 1 - 2 * (row + 0.5) / request.height;
        Vector3 x = request.camera.eye;
        for (std::size_t i = 0; i < 3; ++i) {
            x[i] += 0.5 * request.camera.height * (s * right[i] + v * top[i]);
        }
        return x;
    }

    /** Where the ray meets the sphere about the origin; NaN if it does not. */
    std::array<double, 2> through_sphere(std::size_t pixel, double r) const {
        const Vector3 x = origin(pixel);
        double middle = 0, square = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            middle -= x[i] * along[i];
            square += x[i] * x[i];
        }
        const double half = std::sqrt(r * r - (square - middle * middle));
        return {middle - half, middle + half};
    }
};

/** The plugin's field level_set at positions, found by the cells' bounds; 1 where there is no cell. */
class LevelSet {
public:
    LevelSet(const RuntimeVolume& volume, std::size_t n_cells)
        : m_volume(volume), m_field(volume.field_index("level_set")), m_n_cells(n_cells), m_bounds(6 * volume.n_elements()) {
        volume.bounds(0, volume.n_elements(), m_bounds);
        for (std::uint64_t element = 0; element < volume.n_elements(); ++element) {
            Vector3 middle{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                middle[axis] = 0.5 * (m_bounds[6 * element + axis] + m_bounds[6 * element + 3 + axis]);
            }
            m_elements[place(middle)] = element;
        }
    }

    double at(const Vector3& x) const {
        const auto found = m_elements.find(place(x));
        if (found == m_elements.end()) {
            return 1;
        }
        Vector3 xi{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            xi[axis] = (x[axis] + M_PI) / M_PI * static_cast<double>(m_n_cells) - 2 * cell(x[axis]) - 1;
        }
        std::array<double, 1> value{};
        m_volume.evaluate_field(m_field, 0, found->second, xi, value, {});
        return value[0];
    }

private:
    /** The cell's number in one direction of the gyroid sample's box, from -pi to pi. */
    double cell(double x) const { return std::floor((x + M_PI) / (2 * M_PI) * static_cast<double>(m_n_cells)); }
    std::array<int, 3> place(const Vector3& x) const {
        return {static_cast<int>(cell(x[0])), static_cast<int>(cell(x[1])), static_cast<int>(cell(x[2]))};
    }

    const RuntimeVolume& m_volume;
    std::uint32_t m_field;
    std::size_t m_n_cells;
    std::vector<double> m_bounds;
    std::map<std::array<int, 3>, std::uint64_t> m_elements;
};

inline std::uint32_t field_of(const RuntimeVolume& volume, const char* name) { return volume.field_index(name); }

} // namespace elvis::cut_cells
