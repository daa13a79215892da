/**
 * @file file_dialog.hpp
 * What dialogs that choose a file have in common.
 */
#pragma once

#include <apps/elvis/view/window/ui.hpp>

#include <string>

namespace elvis::view {

/** In the folder that is shown, or with the path that the name has. */
std::string chosen_path(const DialogState& state);
/** The folder's entries, above so many lines of other controls. Returns whether a file was double-clicked. */
bool folder_list(Ui& ui, float n_lines_below);
/** The file's name, and the two buttons. Returns whether the first was pressed, or Enter. */
bool name_and_buttons(Ui& ui, const char* action, bool& is_closed);

/** Another thing, or the first one, is chosen to be written: what is usual for it. `stem`: of file names. */
void begin_data_file(Ui& ui, const Writable& what, const std::string& stem);
/** To write what is shown as numbers. */
void write_data_dialog(Ui& ui);

} // namespace elvis::view
