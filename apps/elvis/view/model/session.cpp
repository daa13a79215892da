#include "session.hpp"

#include <core/base/bounds.hpp>
#include <core/base/error.hpp>
#include <core/base/milliseconds.hpp>
#include <core/base/vector3.hpp>
#include <core/expression/expression.hpp>
#include <core/scene/default_surfaces.hpp>
#include <core/scene/frame_request.hpp>
#include <core/scene/output/png_file.hpp>
#include <core/scene/resolve.hpp>
#include <core/scene/scene_annotation.hpp>
#include <core/scene/surface_distance.hpp>
#include <core/session/field_samples.hpp>
#include <core/session/missed_surfaces.hpp>
#include <core/session/open_volume.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace elvis::view {

namespace {

using Clock = std::chrono::steady_clock;

AnnotationPlan annotation_of(const Scene& scene, const FrameRequest& request, const Frame& frame, const RuntimeVolume& volume) {
    return scene.annotation ? plan_annotation(request.width, request.height,
                                              make_annotation_request(*scene.annotation, request, frame, volume))
                            : AnnotationPlan{};
}

} // namespace

Session::Session(const std::string& device, bool validation) : m_device(std::make_unique<Device>(device, validation)) {}
Session::~Session() = default;

VolumeFacts Session::open(const Scene& scene) {
    const std::string key = scene.volume + "\n" + scene.plugin + "\n" + scene.plugin_options;
    const Precision precision = scene.precision.value_or(Precision::float32);
    if (!m_volume || key != m_key) {
        if (scene.volume.empty()) {
            throw Error("the scene names no volume");
        }
        auto volume =
            std::make_unique<RuntimeVolume>(open_volume(m_registry, scene.volume, scene.plugin, scene.plugin_options));
        auto renderer = std::make_unique<Renderer>(*m_device, *volume, precision);
        m_prober.reset();
        m_renderer = std::move(renderer);
        m_volume = std::move(volume);
        m_precision = precision;
        m_key = key;
    }
    return facts_of(*m_volume, m_renderer->ranges());
}

void Session::need_precision(const Scene& scene) {
    if (!m_volume) {
        throw Error("no volume is open");
    }
    const Precision precision = scene.precision.value_or(Precision::float32);
    if (!m_renderer || precision != m_precision) {
        m_renderer.reset();
        m_renderer = std::make_unique<Renderer>(*m_device, *m_volume, precision);
        m_precision = precision;
    }
}

Picture Session::draw(const Scene& scene, const FrameSchedule::Step& step) {
    need_precision(scene);
    const FrameRequest request = drawn_request(scene);
    const Frame frame = m_renderer->render(request_for(request, step.stage, step.divisor, step.with_lines), &m_control);
    const Clock::time_point drawn = Clock::now();
    Picture picture = picture_of(frame, annotation_of(scene, request, frame, *m_volume), request.width, request.height);
    picture.camera = request.camera;
    picture.remarks.insert(picture.remarks.end(), request.remarks.begin(), request.remarks.end());
    if (step.divisor == 1) {
        MissedSurfaces missed;
        missed.add(request, frame);
        const std::vector<std::string> remarks = missed.remarks(scene, request, m_renderer->ranges());
        picture.remarks.insert(picture.remarks.end(), remarks.begin(), remarks.end());
    }
    picture.is_refinable = has_refinement(request);
    picture.milliseconds = frame.render_milliseconds + milliseconds_since(drawn);
    return picture;
}

std::vector<std::string> Session::save_picture(const Scene& scene, const std::string& path, int bits) {
    need_precision(scene);
    const FrameRequest request = drawn_request(scene);
    Frame frame = m_renderer->render(request);
    std::vector<std::string> remarks = request.remarks;
    if (scene.annotation) {
        for (const std::string& name : annotate(frame, make_annotation_request(*scene.annotation, request, frame, *m_volume))) {
            remarks.push_back("annotation: there is no room for the " + name);
        }
    }
    write_png(frame, path, bits);
    return remarks;
}

FrameRequest Session::drawn_request(const Scene& scene) {
    FrameRequest request = make_frame_request(scene, *m_volume, m_renderer->ranges());
    request.with_buffers = false;
    return request;
}

FieldRange Session::range(const Scene& scene, const std::optional<std::string>& field) {
    need_precision(scene);
    const std::optional<std::string> text = field ? std::optional(with_distances(*field, scene.surfaces)) : std::nullopt;
    return m_renderer->ranges().extrema(choose_field(*m_volume, text), scene.time_step).range();
}

Scene Session::first_scene(const std::string& path) {
    Scene scene;
    scene.volume = path;
    scene.annotation = SceneAnnotation{};
    if (m_volume->dimension() == 2) {
        scene.surfaces.push_back({ElementFaces{}});
        return scene;
    }
    scene.surfaces =
        default_surfaces(scene.camera, *m_volume, m_renderer->ranges(), choose_field(*m_volume, std::nullopt), scene.time_step);
    if (m_volume->n_faces() > 0) {
        scene.lighting = Lighting{};
    }
    return scene;
}

Picked Session::pick(const Scene& scene, const std::array<double, 2>& place) {
    need_precision(scene);
    // One pixel with the ray of that place: s and v of a picture of one pixel are 2 shift_x and -2 shift_y.
    FrameRequest request = make_frame_request(scene, *m_volume, m_renderer->ranges());
    const double width = request.width, height = request.height;
    const Ray ray = ray_through(request.camera, {width, height}, place);
    request.camera.image_shift = {((place[0] + request.camera.image_shift[0]) / width - 0.5) * width / height,
                                  (place[1] + request.camera.image_shift[1]) / height - 0.5};
    request.width = request.height = 1;
    request.volume.reset(); // Light has no place.
    const Frame frame = m_renderer->render(request);
    Picked picked;
    picked.is_hit = std::isfinite(frame.depth[0]);
    if (!picked.is_hit) {
        return picked;
    }
    picked.depth = frame.depth[0];
    picked.position = ray.at(picked.depth);
    picked.normal = {frame.normal[0], frame.normal[1], frame.normal[2]};
    picked.shown_value = frame.value[0];
    if (frame.element[0] >= 0) {
        picked.element = frame.element[0];
    }
    if (m_volume->dimension() == 2) {
        picked.remark = "Only volumes of three dimensions can be probed.";
        return picked;
    }
    if (!probe(ray, scene.time_step, picked)) {
        picked.remark = "The point lies in no element.";
    }
    return picked;
}

bool Session::probe(const Ray& ray, std::uint32_t time_step, Picked& picked) {
    if (!m_prober) {
        m_prober = std::make_unique<Prober>(*m_volume);
    }
    std::vector<std::shared_ptr<const Expression>> expressions;
    for (const char* text : {"jacobian", "scaled_jacobian", "order"}) {
        expressions.push_back(std::make_shared<const Expression>(text, m_volume->fields(), m_volume->dimension()));
    }
    // A point of the boundary may be outside by what single precision is off: then a little deeper, or less deep.
    const std::array<double, 6> bounds = m_renderer->ranges().bounds();
    const double diagonal = diagonal_of(bounds);
    for (const double shift : {0.0, 1e-7, -1e-7, 1e-6, -1e-6, 1e-5, -1e-5, 1e-4}) {
        const Vector3 position = ray.at(picked.depth + shift * diagonal);
        const ProbedPoint point = m_prober->probe(std::span(&position, 1), time_step, expressions).front();
        if (!point.element) {
            continue;
        }
        picked.position = position;
        picked.also = point.also;
        picked.xi = point.xi;
        if (picked.element && *picked.element != *point.element) {
            picked.also.push_back(*picked.element);
        }
        picked.element = point.element;
        for (std::size_t i = 0; i < point.fields.size(); ++i) {
            const FieldInfo& info = m_volume->fields()[i];
            picked.fields.push_back({info.name, info.unit, point.fields[i].values, point.fields[i].gradients,
                                     point.fields[i].gradient_is_estimated});
        }
        picked.jacobian = point.expressions[0].value;
        picked.scaled_jacobian = point.expressions[1].value;
        picked.order = point.expressions[2].value;
        std::sort(picked.also.begin(), picked.also.end());
        return true;
    }
    return false;
}

std::vector<double> Session::samples(const Scene& scene, const std::optional<std::string>& field, unsigned piece) {
    need_precision(scene);
    need_samples(*m_volume);
    if (!m_prober) {
        m_prober = std::make_unique<Prober>(*m_volume);
    }
    return field_samples(*m_prober, *m_volume, m_renderer->ranges().bounds(), scene, field, piece);
}

} // namespace elvis::view
