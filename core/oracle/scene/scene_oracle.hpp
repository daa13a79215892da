/**
 * @file scene_oracle.hpp
 * What the ray of a pixel shows of a whole scene: surfaces, transparent ones too, clips, light, and volume rendering.
 */
#pragma once

#include "surface_tracer.hpp"
#include <core/oracle/volume/volume_integral.hpp>

#include <core/render/frame.hpp>

#include <map>
#include <optional>
#include <string>

namespace elvis::oracle {

/** A native volume as all threads read it. */
class SceneVolume {
public:
    /** `faces`: all of the mesh. */
    SceneVolume(std::string path, std::vector<elvis_face> faces);

    /** Geometry and one field of a time step, read when first asked for. Not by several threads. */
    const Model& model(std::uint32_t field, std::uint32_t time_step);
    std::span<const elvis_face> faces() const { return m_faces; }

private:
    std::string m_path;
    std::vector<elvis_face> m_faces;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::unique_ptr<Model>> m_models;
};

struct PixelAnswer {
    /** The nearest surface: its number in the request, or -1 and nothing but a colour. */
    int surface = -1;
    SurfacePoint point;
    double value = std::numeric_limits<double>::quiet_NaN();
    Color color{};
};

/** For one thread. Volume and request must outlive it. */
class SceneOracle {
public:
    /** Nothing where a scene has what the oracle does not know; `reason` then says what. */
    static std::unique_ptr<SceneOracle> make(SceneVolume& volume, const FrameRequest& request, std::string& reason);
    ~SceneOracle();

    PixelAnswer look(const Line& line, const Perturbation& perturbation = {});
    /** The colours that a point of a surface, the nearest one or not, has by itself. */
    double value(int surface, const SurfacePoint& point) const;
    /** Field and gradient in world coordinates. */
    double value(int surface, std::size_t element, const Vector& xi, Vector* gradient) const;
    /** Largest less smallest value of a surface's field among samples. */
    double range(int surface) const;
    const Model& model() const;
    std::uint64_t n_failures() const;

private:
    struct Layer;
    SceneOracle(SceneVolume& volume, const FrameRequest& request);
    void add_layers(const Line& line, const Perturbation& perturbation, std::vector<Layer>& layers);
    VolumeTracer& volume_tracer(double shift);
    Color shown(const Layer& layer, const Line& line) const;

    struct Look;
    const FrameRequest& m_request;
    const Model* m_model = nullptr;
    const Model* m_volume_model = nullptr;
    std::unique_ptr<SegmentFinder> m_finder;
    std::vector<Look> m_looks;
    std::map<double, VolumeTracer> m_volume_tracers;
};

} // namespace elvis::oracle
