/**
 * @file panels.hpp
 * The parts of the window. Each draws one thing from the model, and changes it through the model.
 */
#pragma once

#include <apps/elvis/view/window/ui.hpp>

namespace elvis::view {

/** Value and density. */
using DensityPoints = std::vector<std::array<double, 2>>;

void draw_menu(Ui& ui);
/** List of items, and what can be done with them. */
void draw_items(Ui& ui);
/** Properties of the selected item. */
void draw_item_editor(Ui& ui);
/** Field, colours, lines and light that items take if they have none of their own. */
void draw_scene_editor(Ui& ui);
void draw_camera(Ui& ui);
void draw_picked(Ui& ui);
/** A line through the volume, and the plot of a field along it. */
void draw_line_probe(Ui& ui);
/** Integrals and extrema of what is shown. */
void draw_numbers(Ui& ui);
void draw_statistics(Ui& ui);
/** Which picture is on the screen, and what is being done. */
void draw_status(Ui& ui);
void draw_time(Ui& ui);
/** Whichever is open. */
void draw_dialogs(Ui& ui);

/** Of parts of the scene; each returns whether something changed. `name` is for tests. */
/** Of the colours: the map's own, or else the field's. */
std::array<double, 2> range_of(const Json& map, const std::optional<FieldRange>& data);
/** The "color_map" of a part. */
bool edit_color_map(Ui& ui, const std::string& name, Json& owner, const std::optional<std::string>& field);
bool edit_contours(Ui& ui, const std::string& name, Json& owner);
bool edit_mesh_lines(Ui& ui, const std::string& name, Json& owner);
/** Nothing where the volume has nothing to follow. */
bool edit_lic(Ui& ui, const std::string& name, Json& owner);
bool edit_volume_rendering(Ui& ui, Json& rendering);
/** Density and peaks over the histogram, which may be null. `base`: the density without peaks; `range`: of the colours;
 * `usual`: a density that shows something. */
bool edit_density_plot(Ui& ui, Json& rendering, const DensityPoints& base, const std::array<double, 2>& range,
                       bool is_logarithmic, double usual, const Histogram* histogram);
/** As the reader of scenes asks for: its width is not lost in rounding. */
bool is_peak(const Json& peak);
void remove_peak(Json& rendering, std::size_t index);
bool edit_geometry(Ui& ui, Json& surface);
bool edit_boundary(Ui& ui, Json& surface);
bool edit_elements(Ui& ui, Json& surface);
bool edit_wireframe(Ui& ui, Json& frame);
/** Streamlines and pathlines. */
bool edit_streamlines(Ui& ui, Json& lines);
/** Where they begin. */
bool edit_seeds(Ui& ui, Json& lines);
bool edit_arrows(Ui& ui, Json& arrows);
bool edit_light(Ui& ui, Json& light);
bool edit_warp(Ui& ui, Json& scene);

/** Keys and what they do, for people. */
const std::vector<std::pair<const char*, const char*>>& shortcut_texts();
/** Called once a frame. */
void handle_shortcuts(Ui& ui);
/** A second view is there, or goes. */
void toggle_second_view(Ui& ui);

} // namespace elvis::view
