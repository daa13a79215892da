/**
 * @file volume_point.hpp
 * A point of an element of a volume whose plugin evaluates on the CPU, for expressions.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/expression/evaluate.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace elvis {

/** Second derivatives are differences of first ones, which plugins give on the CPU. */
class VolumePoint : public ExpressionPoint {
public:
    /** Needs RuntimeVolume::has_evaluation(); the volume must outlive it. `element` counts as in the volume. */
    VolumePoint(const RuntimeVolume& volume, std::uint64_t element, const Vector3& xi, std::uint32_t time_step);

    Vector3 position() override { return m_position; }
    std::array<double, 9> jacobian() override { return m_jacobian; }
    std::array<double, 27> mapping_hessian() override;
    double value(std::uint32_t field, std::uint32_t component) override { return sample(field).values[component]; }
    Vector3 gradient(std::uint32_t field, std::uint32_t component) override;
    std::array<double, 9> hessian(std::uint32_t field, std::uint32_t component) override;
    double order(std::uint32_t field) override;
    double element_number() override;

    /** Gradient by reference coordinates of an expression that has none of its own. */
    Vector3 differences(const Expression& expression) const;

private:
    struct Sample {
        std::vector<double> values, gradients;
        std::optional<std::vector<double>> hessians;
    };
    Sample& sample(std::uint32_t field);
    std::uint32_t element_class() const;
    /** Derivatives of n numbers by each reference coordinate: 3 n numbers, n of each. */
    std::vector<double> differences(const std::function<std::vector<double>(const Vector3&)>& function) const;

    const RuntimeVolume& m_volume;
    std::uint64_t m_element;
    Vector3 m_xi;
    std::uint32_t m_time_step;
    Vector3 m_position{};
    std::array<double, 9> m_jacobian{};
    std::map<std::uint32_t, Sample> m_samples;
};

} // namespace elvis
