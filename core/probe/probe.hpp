/**
 * @file probe.hpp
 * Fields at points, in double precision.
 */
#pragma once

#include <core/base/background.hpp>
#include <core/base/vector3.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/probe/element_finder.hpp>
#include <core/probe/point_evaluator.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace elvis {

struct ProbeOptions {
    enum class Evaluation {
        automatic, ///< cpu where the plugin can, else device
        cpu,
        device
    };
    Evaluation evaluation = Evaluation::automatic;
    /** For device evaluation, as for choose_device. */
    std::string device;
};

/** What is asked of each point. */
struct ProbeWishes {
    /** Of each field of the volume whether it is wanted; nothing: all are. */
    std::optional<std::vector<bool>> fields;
    std::vector<std::shared_ptr<const Expression>> expressions;
    bool with_gradients = true;
};

struct ProbedPoint {
    Vector3 position{};
    /** Number of the element that contains the point; the lowest if several do. */
    std::optional<std::int64_t> element;
    Vector3 xi{};
    /** One for each field of the volume, empty where it is not wanted; none if no element contains the point. */
    std::vector<FieldSample> fields;
    /** One for each expression asked for; empty likewise. */
    std::vector<ExpressionSample> expressions;
    /** Numbers of the other elements that contain the point, ascending: on shared faces, or where elements overlap. */
    std::vector<std::int64_t> also;
    /** Elements for which the inversion failed, so that it is not known whether they contain the point. */
    std::uint32_t n_failures = 0;
};

/**
 * Probes one volume, which must outlive it. One thread at a time. In two dimensions a point is in an element if it is on it, to
 * on_surface (plate.hpp).
 */
class Prober {
public:
    /** An Error if the plugin lacks what the options ask for. In two dimensions points are found on the CPU alone. */
    explicit Prober(const RuntimeVolume& volume, const ProbeOptions& options = {});

    /** One answer a position, in the same order. A position that is not finite lies in no element. */
    std::vector<ProbedPoint> probe(std::span<const Vector3> positions, std::uint32_t time_step, const ProbeWishes& wishes = {});

private:
    void probe_part(std::span<const Vector3> positions, std::uint32_t time_step, const ProbeWishes& wishes,
                    std::span<ProbedPoint> points) const;

    const RuntimeVolume* m_volume;
    std::unique_ptr<PointEvaluator> m_evaluator;
    ElementFinder m_finder;
    std::unique_ptr<Background> m_background;
    /** Of each element. */
    std::vector<std::int64_t> m_numbers;
};

} // namespace elvis
