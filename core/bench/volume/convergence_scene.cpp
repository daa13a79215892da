#include <core/bench/volume/convergence_scene.hpp>

#include <core/base/bounds.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace elvis {

namespace {

constexpr double largest_reference_tolerance = 1e-5;

FieldRange usual_range_of(Renderer& renderer) {
    const std::array<double, 6> bounds = renderer.ranges().bounds();
    FrameRequest request = volume_picture(bounds, 64);
    Surface surface;
    const Vector3 normal{0.2, 0.9, 0.1};
    double offset = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        offset -= 0.5 * normal[axis] * (bounds[axis] + bounds[axis + 3]);
    }
    surface.geometry = CutPlane{{normal[0], normal[1], normal[2], offset}};
    surface.colors.points = {{0, {1, 1, 1}}};
    request.surfaces = {surface};
    std::vector<double> values = renderer.render(request).value;
    std::erase_if(values, [](double value) { return std::isnan(value); });
    if (values.empty()) {
        return renderer.ranges().range({}, 0);
    }
    std::sort(values.begin(), values.end());
    return {values[values.size() / 50], values[values.size() - 1 - values.size() / 50]};
}

} // namespace

TransferFunction peaks_in(const FieldRange& range, double width, double diagonal) {
    const double all = range.upper - range.lower;
    TransferFunction transfer;
    for (const double at : {0.25, 0.5, 0.75}) {
        const double middle = range.lower + at * all;
        transfer.density.push_back({middle - 0.5 * width * all, 0});
        // A ray that crosses the range over half the diagonal is in a peak for width / 2 of that; tents are half as dense.
        transfer.density.push_back({middle, 1.2 / (width * diagonal)});
        transfer.density.push_back({middle + 0.5 * width * all, 0});
    }
    transfer.color = {{range.lower + 0.25 * all, {0.2, 0.3, 0.9}},
                      {range.lower + 0.5 * all, {0.9, 0.9, 0.3}},
                      {range.lower + 0.75 * all, {0.8, 0.1, 0.1}}};
    return transfer;
}

TransferFunction ramp_in(const FieldRange& range, double diagonal) {
    // What ranges in elements are certain to hold is more than the field takes.
    const double margin = range.upper - range.lower;
    return {{{range.lower - margin, 0}, {range.upper + margin, 6 / diagonal}},
            {{range.lower - margin, {0.2, 0.3, 0.9}}, {range.upper + margin, {0.8, 0.1, 0.1}}}};
}

TransferFunction edge_at(double value, double width) { return {{{value, 0}, {value + width, 1}}, {{value, {0.9, 0.6, 0.2}}}}; }

FrameRequest volume_picture(const std::array<double, 6>& bounds, std::uint32_t size) {
    FrameRequest request;
    request.width = request.height = size;
    const double diagonal = diagonal_of(bounds);
    const Vector3 from_centre = {0.93, 0.72, 0.76};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        request.camera.look_at[axis] = 0.5 * (bounds[axis] + bounds[axis + 3]);
        request.camera.eye[axis] = request.camera.look_at[axis] + diagonal * from_centre[axis];
    }
    request.camera.up = {0.1, 0.2, 1};
    request.camera.field_of_view = 35;
    request.background = {0.1, 0.2, 0.3, 1};
    return request;
}

double largest_difference(const Frame& frame, const Frame& reference) {
    double largest = 0;
    for (std::size_t i = 0; i < frame.color.size(); ++i) {
        if ((reference.flags[i / 4] & pixel_flag::work_limit) != 0) {
            continue;
        }
        const double off = std::abs(frame.color[i] - reference.color[i]);
        if (std::isnan(off)) {
            return std::numeric_limits<double>::infinity();
        }
        largest = std::max(largest, off);
    }
    return largest;
}

RuntimeVolume sphere_volume(const PluginRegistry& registry, const BenchFolder& folder, const std::string& shape,
                            const std::array<std::uint32_t, 3>& n) {
    const std::string x = std::to_string(n[0]), y = std::to_string(n[1]), z = std::to_string(n[2]);
    std::string name = "sphere-";
    name += shape + "-" + x + "-" + y + "-" + z;
    std::string text =
        R"({"generator":1,"mesh":"box","box":[[-1,-1,-2],[1,1,4]],"order":2,"geometry_order":1,"field":"sphere","shape":")";
    text += shape + R"(","elements":[)" + x + "," + y + "," + z + "]}";
    return generated_volume(registry, folder, name, text);
}

double a_pixel(std::uint64_t count, std::uint64_t n_pixels) {
    return static_cast<double>(count) / static_cast<double>(std::max<std::uint64_t>(n_pixels, 1));
}

ConvergenceScene::ConvergenceScene(const Device& device, const RuntimeVolume& volume, Precision precision, std::uint32_t size)
    : m_renderer(device, volume, precision), m_request(volume_picture(m_renderer.ranges().bounds(), size)),
      m_diagonal(diagonal_of(m_renderer.ranges().bounds())), m_range(m_renderer.ranges().range({}, 0)),
      m_usual_range(usual_range_of(m_renderer)) {
    m_request.volume.emplace();
    rendering().transfer = {{{0, 0.1 / m_diagonal}}, {{0, {1, 1, 1}}}};
    m_n_pixels = draw(Integrator::trapezoid, m_diagonal, wanted_error).counts.volume_pixels;
}

TransferFunction ConvergenceScene::narrow_peaks() const {
    const double usual = m_usual_range.upper - m_usual_range.lower;
    return peaks_in(m_usual_range, std::min(0.01 * (m_range.upper - m_range.lower) / usual, 0.24), m_diagonal);
}

Frame ConvergenceScene::draw(Integrator integrator, double step, double tolerance) {
    rendering().integrator = integrator;
    rendering().step = step;
    rendering().tolerance = tolerance;
    return m_renderer.render(m_request);
}

Frame ConvergenceScene::draw_reference(double& tolerance) {
    tolerance = reference_tolerance;
    Frame frame = draw(Integrator::exact, 0, tolerance);
    while (frame.counts.work_limit_pixels > 0 && tolerance < largest_reference_tolerance) {
        tolerance *= 10;
        frame = draw(Integrator::exact, 0, tolerance);
    }
    return frame;
}

} // namespace elvis
