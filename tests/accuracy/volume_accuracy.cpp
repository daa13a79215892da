#include "volume_accuracy.hpp"

#include <core/oracle/isosurface/isosurface_compare.hpp>
#include <core/oracle/samples/meshes.hpp>
#include <core/oracle/volume/transfers.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/base/error.hpp>
#include <core/render/renderer.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>

namespace elvis::oracle {
namespace {

Vector3 array_of(const Vector& v) { return {v.x(), v.y(), v.z()}; }

/** What rounding of the field to a precision may do to it, over its range. */
double field_rounding(Precision precision) {
    return (precision == Precision::float64 ? float64_tolerance : float32_tolerance).field;
}

double largest_difference(const Color& a, const Color& b, std::size_t* channel = nullptr) {
    double largest = -1;
    for (std::size_t c = 0; c < 4; ++c) {
        const double off = std::abs(a[c] - b[c]);
        if (!(off <= largest)) {
            largest = std::isnan(off) ? std::numeric_limits<double>::infinity() : off;
            if (channel != nullptr)
                *channel = c;
        }
    }
    return largest;
}

// The same for a field that is lower by `shift`.
TransferFunction shifted(TransferFunction transfer, double shift) {
    for (auto& point : transfer.density)
        point.value += shift;
    for (auto& point : transfer.color)
        point.value += shift;
    return transfer;
}

} // namespace

VolumeScene sphere_scene(const std::string& shape, bool is_one_element, double peak_width, const std::string& path) {
    generate(R"({"generator": 1, "mesh": "box", "shape": ")" + shape + R"(", "box": [[-1, -1, -2], [1, 1, 4]], "elements": )" +
                 (is_one_element ? "[1, 1, 1]" : "[4, 4, 6]") + R"(, "order": 2, "geometry_order": 1, "field": "sphere"})",
             path);
    VolumeScene scene;
    char width[40];
    std::snprintf(width, sizeof width, "%g", 100 * peak_width);
    scene.description = (is_one_element ? "one " : "4 x 4 x 6 cells of ") + shape + ", peaks of " + width + " %";
    scene.data = read_volume(path);
    scene.path = path;
    scene.transfer = sphere_peaks(peak_width);
    scene.camera.eye = {6.1, 5.2, 5.7};
    scene.camera.look_at = {0.05, -0.03, 1};
    scene.camera.up = {0.1, 0.2, 1};
    scene.camera.field_of_view = 30;
    return scene;
}

VolumeScene random_scene(std::uint64_t seed, const std::string& path) {
    const RandomVolume random = random_volume(seed);
    write_volume(path, random.data);
    VolumeScene scene;
    scene.data = random.data;
    scene.path = path;
    scene.camera = random.camera;
    const Model model(random.data);
    const VolumeTracer range(model, {scalar_of_field(model.volume, 0), sphere_peaks(0.1)});
    const RandomTransfer transfer = random_transfer(seed, range.low(), range.high(), model.diagonal);
    scene.transfer = transfer.transfer;
    scene.description = random.description + "; " + transfer.description;
    return scene;
}

VolumeScene file_scene(const std::string& path, TransferFunction transfer) {
    VolumeScene scene;
    scene.description = path;
    scene.data = read_volume(path);
    scene.path = path;
    const Model model(scene.data);
    if (transfer.density.empty()) {
        const VolumeTracer tracer(model, {scalar_of_field(model.volume, 0), sphere_peaks(0.1)});
        const double low = tracer.low(), range = tracer.high() - low;
        for (const double at : {0.25, 0.5, 0.75}) {
            transfer.density.push_back({low + (at - 0.05) * range, 0});
            transfer.density.push_back({low + at * range, 10 / model.diagonal});
            transfer.density.push_back({low + (at + 0.05) * range, 0});
        }
        transfer.color = {{low, {0.2, 0.3, 0.9}}, {low + 0.5 * range, {0.9, 0.9, 0.8}}, {low + range, {0.8, 0.1, 0.1}}};
    }
    scene.transfer = std::move(transfer);
    const Vector middle = 0.5 * (model.tree.lower() + model.tree.upper());
    scene.camera.look_at = array_of(middle);
    scene.camera.eye = array_of(middle + 1.2 * model.diagonal * Vector(0.62, 0.48, 0.51).normalized());
    scene.camera.up = {0.1, 0.2, 1};
    scene.camera.field_of_view = 45;
    return scene;
}

TransferFunction read_transfer(const std::string& path) {
    std::ifstream file(path);
    if (!file)
        throw Error(path, "cannot be read");
    TransferFunction transfer;
    try {
        const nlohmann::json json = nlohmann::json::parse(file);
        for (const auto& point : json.at("density"))
            transfer.density.push_back({point.at(0), point.at(1)});
        for (const auto& point : json.at("color"))
            transfer.color.push_back({point.at(0), {point.at(1), point.at(2), point.at(3)}});
    } catch (const nlohmann::json::exception& error) {
        throw Error(path, std::string("is no transfer function: ") + error.what());
    }
    return transfer;
}

VolumeComparison& VolumeComparison::operator+=(const VolumeComparison& other) {
    if (n_pixels + other.n_pixels > 0)
        mean_error = (mean_error * static_cast<double>(n_pixels) + other.mean_error * static_cast<double>(other.n_pixels)) /
                     static_cast<double>(n_pixels + other.n_pixels);
    n_pixels += other.n_pixels;
    n_touched += other.n_touched;
    n_flagged += other.n_flagged;
    n_above += other.n_above;
    n_above_flagged += other.n_above_flagged;
    n_above_rounding += other.n_above_rounding;
    n_wrong += other.n_wrong;
    error = std::max(error, other.error);
    flagged_error = std::max(flagged_error, other.flagged_error);
    oracle_error = std::max(oracle_error, other.oracle_error);
    return *this;
}

VolumeComparison compare(const Model& model, const VolumeOptics& optics, const Camera& camera, const Color& background,
                         const VolumePicture& exact, const Frame& frame, double tolerance, double rounding) {
    VolumeTracer tracer(model, optics);
    const double shift = rounding * (tracer.high() - tracer.low());
    VolumeTracer below(model, {optics.scalar, shifted(optics.transfer, shift)});
    VolumeTracer above(model, {optics.scalar, shifted(optics.transfer, -shift)});
    VolumeComparison result;
    double worst = -1;
    for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
        const std::size_t pixel = exact.pixels[i];
        const Color right = color_over(exact.answers[i], background);
        Color drawn;
        std::copy_n(frame.color.begin() + static_cast<std::ptrdiff_t>(4 * pixel), 4, drawn.begin());
        std::size_t channel = 0;
        const double error = largest_difference(right, drawn, &channel);
        const bool is_flagged = (frame.flags[pixel] & (pixel_flag::volume_tolerance | pixel_flag::undecided |
                                                       pixel_flag::work_limit | pixel_flag::newton_failure)) != 0;
        const bool is_above = !(error <= tolerance);
        bool is_rounding = false;
        if (is_above && !is_flagged) {
            // Between what the field would give if it were a little lower or higher, in each channel.
            const Line line =
                line_of(pixel_ray(camera, frame.width, frame.height, static_cast<long double>(pixel % frame.width),
                                  static_cast<long double>(pixel / frame.width)));
            const Color one = color_over(below.integrate(line), background),
                        other = color_over(above.integrate(line), background);
            is_rounding = true;
            for (std::size_t c = 0; c < 4; ++c)
                is_rounding = is_rounding && drawn[c] >= std::min({right[c], one[c], other[c]}) - tolerance &&
                              drawn[c] <= std::max({right[c], one[c], other[c]}) + tolerance;
        }
        const bool is_wrong = is_above && !is_flagged && !is_rounding;
        ++result.n_pixels;
        result.n_touched += exact.answers[i].transmittance < 1;
        result.n_flagged += is_flagged;
        result.n_above += is_above;
        result.n_above_flagged += is_above && is_flagged;
        result.n_above_rounding += is_rounding;
        result.n_wrong += is_wrong;
        double& largest = is_flagged ? result.flagged_error : result.error;
        largest = std::max(largest, error);
        result.mean_error += error;
        result.oracle_error = std::max(result.oracle_error, exact.answers[i].error);
        // Wrong ones are worse than others.
        const double badness = error + (is_wrong ? 1e6 : 0);
        if (badness > worst) {
            worst = badness;
            result.worst_pixel = pixel;
            result.worst_channel = channel;
        }
    }
    result.mean_error /= static_cast<double>(std::max<std::size_t>(result.n_pixels, 1));
    return result;
}

FrameRequest volume_request(const VolumeScene& scene, const VolumeSettings& settings, double diagonal) {
    FrameRequest request;
    request.width = request.height = settings.size;
    request.camera = scene.camera;
    request.background = scene.background;
    VolumeRendering& volume = request.volume.emplace();
    volume.transfer = scene.transfer;
    volume.integrator = settings.integrator;
    volume.step = settings.step * diagonal;
    volume.tolerance = settings.tolerance;
    return request;
}

VolumeAccuracy measure_volume(const Device* device, const VolumeScene& scene, const VolumeSettings& settings) {
    const Model model(scene.data);
    const VolumeOptics optics{scalar_of_field(model.volume, 0), scene.transfer};
    const std::size_t n_pixels = std::size_t{settings.size} * settings.size;
    VolumeAccuracy result;
    result.exact =
        draw_volume(model, optics, scene.camera, settings.size, settings.size,
                    settings.n_pixels == 0 ? std::vector<std::size_t>{} : sampled_pixels(n_pixels, settings.n_pixels, 1));
    if (device == nullptr)
        return result;
    const RuntimeVolume volume = open_volume(scene.path);
    for (const Precision precision : settings.precisions) {
        Renderer renderer(*device, volume, precision);
        const Frame frame = renderer.render(volume_request(scene, settings, model.diagonal));
        result.comparisons.push_back(compare(model, optics, scene.camera, scene.background, result.exact, frame,
                                             settings.tolerance, field_rounding(precision)));
        result.counts.push_back(frame.counts);
        result.render_milliseconds.push_back(frame.render_milliseconds);
    }
    return result;
}

std::string to_text(const VolumeComparison& c) {
    char text[1000];
    std::snprintf(text, sizeof text,
                  "  pixels compared                        %zu, %zu of them with light of the volume\n"
                  "  largest error of a channel             %.3g (channel %zu of pixel %zu), mean %.3g\n"
                  "  where flagged                          %.3g in %zu pixels\n"
                  "  above the tolerance                    %zu: %zu flagged, %zu within the field's rounding, %zu wrong\n"
                  "  the oracle's own estimate              %.3g",
                  c.n_pixels, c.n_touched, c.error, c.worst_channel, c.worst_pixel, c.mean_error, c.flagged_error, c.n_flagged,
                  c.n_above, c.n_above_flagged, c.n_above_rounding, c.n_wrong, c.oracle_error);
    return text;
}

} // namespace elvis::oracle
