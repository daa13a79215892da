#include "scene_oracle.hpp"

#include "light.hpp"
#include <core/base/infinity.hpp>
#include <core/oracle/picture/color.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace elvis::oracle {
namespace {

bool is_clipped(const Surface& surface, const Vector& x) {
    return std::ranges::any_of(surface.clip, [&](const std::array<double, 4>& plane) {
        return Vector(plane[0], plane[1], plane[2]).dot(x) + plane[3] < 0;
    });
}

std::string unknown_part(const FrameRequest& request) {
    for (const Surface& surface : request.surfaces) {
        if (surface.field.expression || surface.field.is_own_boundary)
            return "a field that is no field of the file";
        // Of lines it knows where their surface is, and what is seen there without them.
        if (surface.has_lines() && (request.surfaces.size() > 1 || request.volume || surface.opacity < 1))
            return "lines in a picture of several layers";
        if (surface.lic)
            return "line integral convolution";
        if (const auto* iso = std::get_if<Isosurfaces>(&surface.geometry); iso != nullptr && iso->field.expression)
            return "an isosurface of an expression";
        if (const auto* shape = std::get_if<CutShape>(&surface.geometry); shape != nullptr && !is_known(*shape))
            return "patches, or the function of an implicit surface";
        if (std::holds_alternative<WireFrame>(surface.geometry) || std::holds_alternative<FlatElements>(surface.geometry) ||
            std::holds_alternative<ElementFaces>(surface.geometry))
            return "wires, flat elements or chosen elements";
        const auto* boundary = std::get_if<BoundaryFaces>(&surface.geometry);
        if (boundary != nullptr && !boundary->groups.empty())
            return "groups of boundary faces";
    }
    if (request.volume && request.volume->field.expression)
        return "volume rendering of an expression";
    if (request.volume && has_steps(request.volume->integrator))
        return "an integrator with steps";
    return {};
}

double sampled_range(const Model& model, const Scalar& scalar) {
    double low = infinity, high = -infinity;
    for (std::size_t element = 0; element < model.volume.n_elements(); ++element)
        for (int k = 0; k < 4; ++k)
            for (int j = 0; j < 4; ++j)
                for (int i = 0; i < 4; ++i) {
                    const native::Point xi =
                        native::expand(model.volume.shape(element), {(2 * i - 3) / 3.0, (2 * j - 3) / 3.0, (2 * k - 3) / 3.0});
                    const double value = scalar(model.volume, element, {xi[0], xi[1], xi[2]}, nullptr);
                    low = std::min(low, value);
                    high = std::max(high, value);
                }
    return high - low;
}

} // namespace

SceneVolume::SceneVolume(std::string path, std::vector<elvis_face> faces)
    : m_path(std::move(path)), m_faces(std::move(faces)) {}

const Model& SceneVolume::model(std::uint32_t field, std::uint32_t time_step) {
    std::unique_ptr<Model>& model = m_models[{field, time_step}];
    if (!model)
        model = std::make_unique<Model>(read_volume(m_path, field, time_step));
    return *model;
}

/** How a surface is traced and coloured. */
struct SceneOracle::Look {
    std::unique_ptr<SurfaceTracer> tracer;
    const Model* field = nullptr;
    Scalar scalar;
    double range = 0;
};

struct SceneOracle::Layer {
    int surface = 0;
    SurfacePoint point;
};

SceneOracle::~SceneOracle() = default;

std::unique_ptr<SceneOracle> SceneOracle::make(SceneVolume& volume, const FrameRequest& request, std::string& reason) {
    reason = unknown_part(request);
    if (!reason.empty())
        return nullptr;
    return std::unique_ptr<SceneOracle>(new SceneOracle(volume, request));
}

SceneOracle::SceneOracle(SceneVolume& volume, const FrameRequest& request) : m_request(request) {
    const auto model_of = [&](const FieldChoice& field) { return &volume.model(field.field, request.time_step); };
    m_model = model_of(request.surfaces.empty() ? request.volume->field : request.surfaces.front().field);
    m_finder = std::make_unique<SegmentFinder>(*m_model);
    if (request.volume)
        m_volume_model = model_of(request.volume->field);
    for (const Surface& surface : request.surfaces) {
        Look look;
        look.field = model_of(surface.field);
        look.scalar = scalar_of_field(look.field->volume, surface.field.component);
        look.range = sampled_range(*look.field, look.scalar);
        if (const auto* plane = std::get_if<CutPlane>(&surface.geometry)) {
            look.tracer = plane_tracer(*m_model, *plane);
        } else if (const auto* shape = std::get_if<CutShape>(&surface.geometry)) {
            look.tracer = shape_tracer(*m_model, *shape, surface.outside.has_value());
        } else if (std::holds_alternative<BoundaryFaces>(surface.geometry)) {
            std::vector<elvis_face> faces;
            std::ranges::copy_if(volume.faces(), std::back_inserter(faces),
                                 [](const elvis_face& face) { return face.neighbour == ELVIS_NEIGHBOUR_NONE; });
            look.tracer = face_tracer(*m_model, *m_finder, faces);
        } else {
            const auto& iso = std::get<Isosurfaces>(surface.geometry);
            const Model& model = *model_of(iso.field);
            look.tracer = isosurface_tracer(model, {scalar_of_field(model.volume, iso.field.component), iso.values});
        }
        m_looks.push_back(std::move(look));
    }
}

const Model& SceneOracle::model() const { return *m_model; }
double SceneOracle::range(int surface) const { return m_looks[static_cast<std::size_t>(surface)].range; }

std::uint64_t SceneOracle::n_failures() const {
    std::uint64_t n = 0;
    for (const Look& look : m_looks)
        n += look.tracer->n_failures();
    for (const auto& [shift, tracer] : m_volume_tracers)
        n += tracer.n_failures();
    return n;
}

double SceneOracle::value(int surface, std::size_t element, const Vector& xi, Vector* gradient) const {
    const Look& look = m_looks[static_cast<std::size_t>(surface)];
    if (gradient == nullptr)
        return look.scalar(look.field->volume, element, xi, nullptr);
    Vector in_xi;
    Matrix jacobian;
    const double result = look.scalar(look.field->volume, element, xi, &in_xi);
    m_model->volume.position(element, xi, &jacobian);
    *gradient = jacobian.transpose().inverse() * in_xi;
    return result;
}

double SceneOracle::value(int surface, const SurfacePoint& point) const {
    return point.element == SurfacePoint::no_element ? std::numeric_limits<double>::quiet_NaN()
                                                     : value(surface, point.element, point.xi, nullptr);
}

void SceneOracle::add_layers(const Line& line, const Perturbation& perturbation, std::vector<Layer>& layers) {
    for (std::size_t i = 0; i < m_looks.size(); ++i) {
        const Surface& surface = m_request.surfaces[i];
        if (!(surface.opacity > 0))
            continue;
        for (SurfacePoint& point : m_looks[i].tracer->trace(line, m_request.camera.near, perturbation)) {
            if (is_clipped(surface, line.at(point.t)))
                continue;
            layers.push_back({static_cast<int>(i), point});
            if (surface.opacity >= 1)
                break;
        }
    }
    const auto is_opaque = [&](const Layer& layer) {
        return m_request.surfaces[static_cast<std::size_t>(layer.surface)].opacity >= 1;
    };
    // Opaque surfaces are drawn first, and of equal depths the first one stays.
    std::stable_sort(layers.begin(), layers.end(), [&](const Layer& a, const Layer& b) {
        return a.point.t != b.point.t ? a.point.t < b.point.t : is_opaque(a) && !is_opaque(b);
    });
    const auto last = std::ranges::find_if(layers, is_opaque);
    if (last != layers.end())
        layers.erase(last + 1, layers.end());
}

VolumeTracer& SceneOracle::volume_tracer(double shift) {
    const auto known = m_volume_tracers.find(shift);
    if (known != m_volume_tracers.end())
        return known->second;
    const VolumeRendering& rendering = *m_request.volume;
    VolumeOptics optics{scalar_of_field(m_volume_model->volume, rendering.field.component), rendering.transfer};
    if (shift != 0) {
        const VolumeTracer& unshifted = volume_tracer(0);
        const double by = shift * (unshifted.high() - unshifted.low());
        for (auto& point : optics.transfer.density)
            point.value += by;
        for (auto& point : optics.transfer.color)
            point.value += by;
    }
    return m_volume_tracers.emplace(shift, VolumeTracer(*m_volume_model, optics)).first->second;
}

Color SceneOracle::shown(const Layer& layer, const Line& line) const {
    const Surface& surface = m_request.surfaces[static_cast<std::size_t>(layer.surface)];
    if (layer.point.element == SurfacePoint::no_element)
        return {(*surface.outside)[0], (*surface.outside)[1], (*surface.outside)[2], 1};
    Color color = color_of(surface.colors, value(layer.surface, layer.point));
    if (m_request.lighting && surface.is_lit)
        color = lit(*m_request.lighting, color, layer.point.normal, line.at(layer.point.t), -line.direction);
    return color;
}

PixelAnswer SceneOracle::look(const Line& line, const Perturbation& perturbation) {
    std::vector<Layer> layers;
    add_layers(line, perturbation, layers);
    PixelAnswer answer;
    if (!layers.empty()) {
        answer.surface = layers.front().surface;
        answer.point = layers.front().point;
        answer.value = value(answer.surface, answer.point);
    }
    // Between the eye, the layers, and what is behind, which an opaque layer hides.
    std::vector<double> stops{0};
    for (const Layer& layer : layers)
        stops.push_back(layer.point.t);
    const bool is_closed = !layers.empty() && m_request.surfaces[static_cast<std::size_t>(layers.back().surface)].opacity >= 1;
    if (!is_closed)
        stops.push_back(infinity);
    std::vector<VolumeLight> lights;
    if (m_request.volume)
        lights = volume_tracer(perturbation.field).integrate_between(line, stops);

    VolumeLight all;
    const auto add = [&](const std::array<double, 3>& light, double kept) {
        for (std::size_t c = 0; c < 3; ++c)
            all.rgb[c] += all.transmittance * light[c];
        all.transmittance *= kept;
    };
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
        if (m_request.volume)
            add(lights[i].rgb, lights[i].transmittance);
        if (i < layers.size()) {
            const double opacity = m_request.surfaces[static_cast<std::size_t>(layers[i].surface)].opacity;
            const Color color = shown(layers[i], line);
            add({opacity * color[0], opacity * color[1], opacity * color[2]}, 1 - opacity);
        }
    }
    answer.color = color_over(all, m_request.background);
    return answer;
}

} // namespace elvis::oracle
