/**
 * @file prepared_request.hpp
 * From what callers ask for to what is drawn.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/field/shown_field.hpp>
#include <core/render/frame.hpp>

#include <vector>

namespace elvis {

/** Throws Error where the request does not suit the volume. */
void check_request(const FrameRequest& request, const RuntimeVolume& volume);

/**
 * With fields that the device evaluates in place of those found by place (Surface::by_place), with fields less what keeps their
 * digits, and behind the surfaces that are asked for, where elements are cut by their own boundary (elvis_inside) or by
 * conditions, those cuts, for each that shows the whole boundary.
 */
FrameRequest prepared(FrameRequest request, const RuntimeVolume& volume, ShownFields& fields);

/** `is_met` of the surfaces of a prepared request, for those of the request that it was made of. */
std::vector<bool> met_as_asked(const FrameRequest& asked, const RuntimeVolume& volume, std::vector<bool> is_met);

} // namespace elvis
