/**
 * @file settings.hpp
 * What the window remembers from one start to the next.
 */
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace elvis::view {

struct Settings {
    static constexpr std::size_t most_recent_files = 12;

    /** Latest first; absolute. */
    std::vector<std::string> recent_files;
    /** Where dialogs begin. */
    std::string folder;
    /** Of the window, in the screen's units. */
    std::array<int, 2> window_size{1280, 800};
    /** Of the panels at the left and right, in the same, before scaling. */
    std::array<float, 2> panel_widths{310, 330};
    /** Times what the screen asks for. */
    float text_scale = 1;
    bool is_dark = true;

    /** Puts it first. */
    void add_recent(const std::string& path);
};

/** $XDG_CONFIG_HOME/elvis/view.json, else $HOME/.config/elvis/view.json; empty if neither is set. */
std::filesystem::path settings_file();

/** Defaults for what is missing or makes no sense: no file of settings can keep the window from opening. */
Settings read_settings(const std::filesystem::path& file);
/** Returns whether that worked. */
bool write_settings(const Settings& settings, const std::filesystem::path& file);

} // namespace elvis::view
