// elvis_accuracy: the renderer against the oracle on one cut plane of one volume, printed. See --help.
#include <core/oracle/picture/compare.hpp>
#include <core/oracle/picture/view.hpp>

#include <core/plugin_host/plugin.hpp>
#include <core/render/renderer.hpp>

#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>

namespace elvis::oracle {
namespace {

struct Arguments {
    std::string volume;
    std::string field;
    std::uint32_t time_step = 0;
    std::vector<double> plane{1, 0, 0, 0};
    std::vector<double> range;
    std::vector<double> eye;
    std::vector<double> look_at;
    std::vector<std::string> precisions{"float32", "float64"};
    std::uint32_t width = 1000;
    std::uint32_t height = 1000;
    double tilt = 17;
    std::string device;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Whether the promises about channels and the domain's edge hold.
bool holds(const Comparison& comparison, Precision precision) {
    return comparison.max_channel_error <= (precision == Precision::float32 ? 1e-3 : 1e-9) &&
           comparison.disagreement_share() <= 1e-4 && comparison.max_edge_distance <= 1e-5;
}

int run(const Arguments& arguments) {
    const PluginRegistry registry;
    const RuntimeVolume volume(registry.runtime_for(arguments.volume), arguments.volume);
    const std::uint32_t field = arguments.field.empty() ? 0 : volume.field_index(arguments.field);

    auto start = std::chrono::steady_clock::now();
    const Model model(read_volume(arguments.volume, field, arguments.time_step));
    const CutPlane plane{{arguments.plane[0], arguments.plane[1], arguments.plane[2], arguments.plane[3]}};
    FrameRequest request = view_of(model, plane, arguments.width, arguments.height, 0, 1, arguments.tilt);
    request.surfaces[0].field = {field, volume.fields()[field].n_components == 1 ? 0 : -1};
    request.time_step = arguments.time_step;
    if (!arguments.eye.empty())
        request.camera.eye = {arguments.eye[0], arguments.eye[1], arguments.eye[2]};
    if (!arguments.look_at.empty())
        request.camera.look_at = {arguments.look_at[0], arguments.look_at[1], arguments.look_at[2]};
    double low = 0;
    double high = 1;
    if (arguments.range.empty()) {
        // A small picture first, for the range of values in the plane.
        FrameRequest small = request;
        small.width = small.height = 200;
        std::tie(low, high) = value_range(draw(model, small));
    } else {
        low = arguments.range[0];
        high = arguments.range[1];
    }
    request.surfaces[0].colors = view_of(model, plane, 1, 1, low, high).surfaces[0].colors;
    const Picture exact = draw(model, request);
    std::printf(
        "oracle: %zu elements, range [%.9g, %.9g], %zu alternatives, %llu inversions (%llu subdivided, %llu unresolved), "
        "%.1f s\n",
        model.volume.n_elements(), low, high, exact.alternatives.size(), static_cast<unsigned long long>(exact.counts.queries),
        static_cast<unsigned long long>(exact.counts.subdivided), static_cast<unsigned long long>(exact.counts.unresolved),
        seconds_since(start));

    const Device device(arguments.device);
    bool all_hold = true;
    for (const std::string& name : arguments.precisions) {
        const Precision precision = name == "float32" ? Precision::float32 : Precision::float64;
        Renderer renderer(device, volume, precision);
        const Frame frame = renderer.render(request);
        const Comparison comparison = compare(model, exact, frame);
        const bool is_good = holds(comparison, precision);
        all_hold = all_hold && is_good;
        std::printf("%s: %s  (%.1f ms)  %s\n", name.c_str(), to_text(comparison).c_str(), frame.render_milliseconds,
                    is_good ? "good" : "TOO LARGE");
    }
    return all_hold ? 0 : 1;
}

} // namespace
} // namespace elvis::oracle

int main(int argc, char** argv) {
    using elvis::oracle::Arguments;
    Arguments arguments;
    CLI::App app{
        "Compares a cut plane drawn by ElVis with the exact picture, pixel by pixel. The volume must be a native one. "
        "Exit status 0 if every channel of every pixel is within 0.001 (float32) or 1e-9 (float64), and at most 0.01 % "
        "of the pixels disagree about inside, all within 1e-5 of the domain's edge."};
    app.add_option("volume", arguments.volume, "Native volume")->required();
    app.add_option("--field", arguments.field, "Field by name; the first one by default");
    app.add_option("--time-step", arguments.time_step, "Time step");
    app.add_option("--cut-plane", arguments.plane, "A,B,C,D of Ax+By+Cz+D=0")->delimiter(',')->expected(4);
    app.add_option("--range", arguments.range, "Ends of the colour map; default: values in the plane")
        ->delimiter(',')
        ->expected(2);
    app.add_option("--eye", arguments.eye, "Eye; default: the whole volume is seen")->delimiter(',')->expected(3);
    app.add_option("--look-at", arguments.look_at, "Point in the picture's middle")->delimiter(',')->expected(3);
    app.add_option("--precision", arguments.precisions, "float32, float64 or both")
        ->check(CLI::IsMember({"float32", "float64"}));
    app.add_option("--width", arguments.width, "Pixels")->check(CLI::PositiveNumber);
    app.add_option("--height", arguments.height, "Pixels")->check(CLI::PositiveNumber);
    app.add_option("--tilt", arguments.tilt, "Degrees between view direction and the plane's normal");
    app.add_option("--device", arguments.device, "Device by name or index");
    CLI11_PARSE(app, argc, argv);
    try {
        return elvis::oracle::run(arguments);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "elvis_accuracy: %s\n", error.what());
        return 1;
    }
}
