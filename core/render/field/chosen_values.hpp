/**
 * @file chosen_values.hpp
 * Values of what a surface shows at places in elements, on the processor in double precision.
 */
#pragma once

#include <core/probe/cpu_evaluator.hpp>
#include <core/render/surface.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

/** Of a component, of a magnitude or of an expression. */
std::vector<double> chosen_values(CpuEvaluator& evaluator, const FieldChoice& field, std::uint32_t time_step,
                                  std::span<const ReferencePoint> places);

/** Whether it takes fields that are found by place (RuntimeVolume::add_by_place), which the device cannot evaluate. */
bool is_by_place(const FieldChoice& field, const RuntimeVolume& volume);

/** Of what is found by place: the least and largest of samples in all elements. */
FieldExtrema extrema_by_place(const RuntimeVolume& volume, const FieldChoice& field, std::uint32_t time_step);

/** About what rounding costs its values: of the largest of the fields that it takes. */
double rounding_by_place(const RuntimeVolume& volume, const FieldChoice& field, std::uint32_t time_step);

} // namespace elvis
