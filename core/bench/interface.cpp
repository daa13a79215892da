#include <core/bench/interface.hpp>

#include <core/base/bounds.hpp>
#include <core/base/error.hpp>
#include <core/render/cut_surface/cut_plane_pass.hpp>
#include <core/render/device/device_time.hpp>

#include "by_hand_text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace elvis {

namespace {

constexpr std::uint32_t mesh_order = 1, field_order = 2;
const std::string place = "elvis bench interface";

std::uint32_t first_scalar(const RuntimeVolume& volume) {
    for (std::uint32_t field = 0; field < volume.fields().size(); ++field) {
        if (volume.fields()[field].n_components == 1) {
            return field;
        }
    }
    throw Error(place, "the volume has no scalar field");
}

/** What by_hand.glsl takes for granted. */
void check_class(const RuntimeVolume& volume, std::uint32_t element_class, const SnippetInstance& instance) {
    const std::string name = "element class " + std::to_string(element_class);
    if (volume.plugin().id() != "org.elvis.native") {
        throw Error(place, "needs a native volume, not one of plugin " + volume.plugin().id());
    }
    if (instance.shape != ELVIS_SHAPE_HEXAHEDRON && instance.shape != ELVIS_SHAPE_PRISM) {
        throw Error(place, name + " is neither of hexahedra nor of prisms");
    }
    const std::map<std::string, std::int64_t> constants(instance.constants.begin(), instance.constants.end());
    for (const char* direction : {"P", "Q", "R"}) {
        if (constants.at(std::string("NATIVE_GEOMETRY_") + direction) != mesh_order ||
            constants.at(std::string("NATIVE_FIELD_") + direction) != field_order) {
            throw Error(place, name + " has other orders than 1 of the geometry and 2 of the field");
        }
    }
}

/** Puts functions by hand in the place of the snippet. */
class ByHand {
public:
    ByHand(const Device& device, const RuntimeVolume& volume) : m_device(device), m_volume(volume) {}

    void operator()(KernelRequest& request, std::uint32_t element_class) const {
        const SnippetInstance instance = request.instances.at(0);
        check_class(m_volume, element_class, instance);
        request.instances.clear();
        request.defines.emplace_back("BY_HAND_TEXELS", m_device.uses_texel_buffers() ? "1" : "0");
        request.defines.emplace_back("ELVIS_SHAPE", std::to_string(instance.shape));
        request.defines.emplace_back("ELVIS_N_COMPONENTS", "1");
        request.defines.emplace_back("ELVIS_HAS_INSIDE", "0");
        for (const FetchBuffer& buffer : instance.buffers) {
            if (buffer.name == "geometry") {
                add(request, "BY_HAND_GEOMETRY", *buffer.records);
            } else if (buffer.name == "field") {
                add(request, "BY_HAND_FIELD", *buffer.records);
            }
        }
        add(request, "BY_HAND_ORIGINS", *instance.origins);
        request.text = by_hand_text::files[0].text;
    }

private:
    /** Buffers are numbered as they are met, and called core_part_NUMBER_PART (core/shader/fetch.cpp). */
    static void add(KernelRequest& request, const std::string& name, const RecordBuffer& records) {
        if (records.n_parts() != 1) {
            throw Error(place, "the volume is too large: its buffers are in several parts");
        }
        request.defines.emplace_back(name, "core_part_" + std::to_string(request.buffers.size()) + "_0");
        request.defines.emplace_back(name + "_ROWS", std::to_string(records.padded_record_size() / 4) + "u");
        request.buffers.push_back({name, &records});
    }

    const Device& m_device;
    const RuntimeVolume& m_volume;
};

/**
 * Through the middle of the bounds, nearly across the shortest side, and so near that it fills the picture. Tilted, so that it
 * lies in no faces.
 */
void look_at_middle(const std::array<double, 6>& bounds, CutPlane& plane, Camera& camera) {
    Vector3 side = {bounds[3] - bounds[0], bounds[4] - bounds[1], bounds[5] - bounds[2]};
    const std::size_t shortest = static_cast<std::size_t>(std::min_element(side.begin(), side.end()) - side.begin());
    Vector3 normal{};
    normal[shortest] = 1;
    normal[(shortest + 1) % 3] = 0.11;
    normal[(shortest + 2) % 3] = 0.07;
    camera.look_at = middle_of(bounds);
    camera.eye = plus(camera.look_at, scaled(normal, diagonal_of(bounds)));
    plane.plane = {normal[0], normal[1], normal[2], -dot(normal, camera.look_at)};
    camera.up[(shortest + 1) % 3] = 1;
    camera.orthographic = true;
    std::ranges::sort(side);
    camera.height = side[1];
}

double median(std::vector<double> numbers) {
    std::ranges::sort(numbers);
    return numbers[numbers.size() / 2];
}

/** A pass, the layer that it draws into, and how long that took each time. */
struct Contestant {
    CutPlanePass pass;
    Layer layer;
    FrameCounts counts;
    std::vector<double> milliseconds;

    void draw(const Device& device, const CutPlaneGeometry& geometry, bool is_measured) {
        layer.marks.fill(0);
        layer.samples.fill(0);
        counts = {};
        const DeviceTimer timer(device);
        pass.draw(geometry, 1, {}, {}, {layer}, counts);
        if (is_measured) {
            milliseconds.push_back(timer.milliseconds());
        }
    }

    InterfaceResult::Time time() const { return {*std::ranges::min_element(milliseconds), median(milliseconds)}; }
};

void compare(const Contestant& plugin, const Contestant& by_hand, InterfaceResult& result) {
    const std::uint64_t n_pixels = plugin.layer.n_pixels();
    const auto marks = plugin.layer.marks.read_items<Mark>(n_pixels),
               other_marks = by_hand.layer.marks.read_items<Mark>(n_pixels);
    const auto samples = plugin.layer.samples.read_items<Sample<float>>(n_pixels);
    const auto other_samples = by_hand.layer.samples.read_items<Sample<float>>(n_pixels);
    double lower = std::numeric_limits<double>::infinity(), upper = -lower;
    for (std::uint64_t pixel = 0; pixel < n_pixels; ++pixel) {
        const bool is_hit = marks[pixel].surface() != 0, is_hit_by_hand = other_marks[pixel].surface() != 0;
        if (is_hit != is_hit_by_hand || (is_hit && samples[pixel].number != other_samples[pixel].number)) {
            result.other_pixels += 1;
        } else if (is_hit) {
            const double value = samples[pixel].value;
            result.largest_difference =
                std::max(result.largest_difference, std::abs(value - double{other_samples[pixel].value}));
            lower = std::min(lower, value);
            upper = std::max(upper, value);
        }
        result.hit_pixels += is_hit ? 1 : 0;
    }
    result.largest_difference /= upper > lower ? upper - lower : 1;
    result.plugin_newton_steps = plugin.counts.newton_iterations;
    result.by_hand_newton_steps = by_hand.counts.newton_iterations;
}

} // namespace

InterfaceResult bench_interface(const Device& device, const PluginRegistry& registry, const BenchFolder& folder,
                                const InterfaceOptions& options) {
    const RuntimeVolume volume =
        options.volume.empty()
            ? generated_volume(registry, folder, "waves-16-straight",
                               R"({"generator":1,"mesh":"waves","shape":"hexahedron","geometry_order":1,"field":"waves",)"
                               R"("elements":16,"order":2})")
            : RuntimeVolume(registry.runtime_for(options.volume), options.volume);
    const std::uint32_t field = first_scalar(volume);
    DeviceVolume data(device, volume, Precision::float32, nullptr);
    data.select(field, 0, {0.0});
    CutPlane plane;
    Camera camera;
    look_at_middle(data.bounds(), plane, camera);
    const CutPlaneGeometry geometry = cut_plane_geometry(plane, camera, options.size, options.size, data.centre());

    const auto layer = [&] { return Layer(device, Precision::float32, options.size, options.size); };
    Contestant plugin{CutPlanePass(device, volume, data, false), layer(), {}, {}};
    Contestant by_hand{CutPlanePass(device, volume, data, false, ByHand(device, volume)), layer(), {}, {}};
    // The first picture pays for compilers and caches.
    plugin.draw(device, geometry, false);
    by_hand.draw(device, geometry, false);
    for (std::uint32_t run = 0; run < options.n_runs; ++run) {
        // Neither always comes first.
        (run % 2 == 0 ? plugin : by_hand).draw(device, geometry, true);
        (run % 2 == 0 ? by_hand : plugin).draw(device, geometry, true);
    }
    std::vector<double> ratios;
    for (std::uint32_t run = 0; run < options.n_runs; ++run) {
        ratios.push_back(plugin.milliseconds[run] / by_hand.milliseconds[run]);
    }
    InterfaceResult result;
    result.n_elements = volume.n_elements();
    result.field = volume.fields()[field].name;
    result.size = options.size;
    compare(plugin, by_hand, result);
    result.plugin = plugin.time();
    result.by_hand = by_hand.time();
    result.ratio = median(std::move(ratios));
    return result;
}

} // namespace elvis
