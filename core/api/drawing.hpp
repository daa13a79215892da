/**
 * @file drawing.hpp
 * How calls that draw begin and end.
 */
#pragma once

#include "call.hpp"

#include <memory>

namespace elvis::library {

/** A scene of these data, whatever volume it names. Throws Error if its annotation's font is not there: before work is done. */
Scene scene_for(const Data& data, Scene scene);

/**
 * What a scene shows of data: them, or, where it has a warp, them displaced. The displaced are kept until another warp is
 * wanted. Not while the data's mutex is held.
 */
std::shared_ptr<Data> shown_data(const std::shared_ptr<Data>& data, const Scene& scene, const elvis_task* task);

/** Throws Error if the scene has several volumes; `what` begins the sentence. */
void need_one_volume(const Scene& scene, const char* what);
/** The picture of a scene with several volumes, of which the data are the first. */
elvis_picture* draw_volumes(const std::shared_ptr<Data>& data, const Scene& scene, const elvis_render_options& options,
                            const elvis_task* task);
/** The same for a screen. */
elvis_picture* draw_volumes_for_screen(const std::shared_ptr<Data>& data, const Scene& scene, const ScreenOptions& options,
                                       const elvis_task* task);

/** Gives a scene's streamlines their tubes, and its arrows their glyphs; while the data's mutex is held. */
void provide_glyphs(Data& data, Scene& scene);

inline Precision precision_of(const Scene& scene) { return scene.precision.value_or(Precision::float32); }

/** Options of the caller's, which may be null: then all are zero. */
template <class Struct> Struct known_or_zero(const Struct* options) {
    return options != nullptr ? known_part(options, "options") : Struct{};
}

/** By all devices of the data's context. */
StillOptions still_options(Data& data, Precision precision, const elvis_render_options& options);

/** A new picture, of what was drawn by the data's renderer. */
elvis_picture* new_picture(const std::shared_ptr<Data>& data, Precision precision,
                           std::variant<StillPicture, ScreenPicture> drawn);
/** The same of what was drawn within a budget. */
elvis_picture* new_picture(const std::shared_ptr<Data>& data, Precision precision, StillPicture still, const DemandWork& work);

} // namespace elvis::library
