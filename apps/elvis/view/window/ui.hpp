/**
 * @file ui.hpp
 * What panels draw with: the workbench, and controls that explain themselves.
 */
#pragma once

#include <apps/elvis/view/model/settings.hpp>
#include <apps/elvis/view/model/workbench.hpp>

#include <imgui.h>

#include <array>
#include <map>
#include <optional>
#include <string>

namespace elvis::view {

/** A key that went down. */
struct KeyPress {
    /** What is written on it, capital, for letters and digits; else 0. */
    char letter = 0;
    bool is_delete = false, is_space = false, is_f1 = false;
    bool with_control = false, with_shift = false;
};

/** Which dialog is open; each is drawn by its own file in panels/. */
enum class Dialog { none, open, save_scene, save_picture, convert, shortcuts, quit, write_data };

/** What is entered in the dialog that is open. */
struct DialogState {
    /** It has just been opened. */
    bool is_new = false;
    std::string folder, name, filter;
    std::string input; ///< of a conversion
    std::array<std::uint32_t, 2> size{};
    bool has_16_bits = false;
    DataFile file{}; ///< of numbers
};

struct Ui {
    Workbench& bench;
    Settings& settings;
    /** Pixels of the screen a unit of length. */
    float scale = 1;
    /** The one that is open, and the one that is to be opened. */
    Dialog dialog = Dialog::none, next_dialog = Dialog::none;
    DialogState dialog_state{};
    /** The user wants to leave; and may, as far as changes are concerned. */
    bool wants_to_quit = false, has_leave_to_quit = false;
    /** Colours of panels have changed. */
    bool has_new_look = false;
    /** The point of the line that is looked at in its plot. */
    std::optional<Vector3> line_point{};
    /** Time steps go on by themselves. */
    bool is_playing = false;
    /** The hand is at work, outside of what ImGui knows. */
    bool is_dragging = false;
    /** Since the last frame. ImGui 1.86 misses those that go up again before the next one. */
    std::vector<KeyPress> keys{};
    /** The control below the cursor, and since when: explanations wait a little, or they would be in the way. */
    std::string hovered{};
    double hovered_since = 0;
    /** Texts that are being written, by control, and when they last were. */
    struct Written {
        std::string text;
        int frame = 0;
    };
    std::map<ImGuiID, Written> written{};
    /** Where controls are in this frame, for tests; by name. */
    std::map<std::string, std::array<float, 4>> places{};

    Model& model() { return bench.model(); }
    const Scene& scene() { return bench.model().scene(); }
};

/** After a control: says what it is for when the cursor rests on it, and notes where it is. */
void explain(Ui& ui, const std::string& name, const char* help);

/** Controls as ImGui has them, with an explanation. `name` is for tests; `label` is what people see. */
bool button(Ui& ui, const std::string& name, const char* label, const char* help);
bool small_button(Ui& ui, const std::string& name, const char* label, const char* help);
bool check(Ui& ui, const std::string& name, const char* label, bool& value, const char* help);
/** Typed, or dragged at a speed that suits `extent`. Returns whether it changed; never gives what is not finite. */
bool number(Ui& ui, const std::string& name, const char* label, double& value, double extent, const char* help);
bool positive_number(Ui& ui, const std::string& name, const char* label, double& value, double extent, const char* help);
bool slider(Ui& ui, const std::string& name, const char* label, double& value, double lower, double upper, const char* help);
bool vector(Ui& ui, const std::string& name, const char* label, std::array<double, 3>& value, double extent, const char* help);
bool color(Ui& ui, const std::string& name, const char* label, std::array<double, 3>& rgb, const char* help);
/** Changes the value when editing ends, so that no half-written expression is drawn. */
bool text(Ui& ui, const std::string& name, const char* label, std::string& value, const char* help, const char* hint = "");
/** Near the middle of a range, with few digits: where to start from. */
double round_middle(const std::array<double, 2>& range);
/** Values separated by blanks or commas, sorted. */
bool number_list(Ui& ui, const std::string& name, const char* label, std::vector<double>& values, const char* help);
/** One of a few words. */
bool choice(Ui& ui, const std::string& name, const char* label, std::size_t& chosen, const std::vector<std::string>& words,
            const char* help);
/** An expression that is typed, or one of those that are offered. */
bool offered_text(Ui& ui, const std::string& name, const char* label, std::string& value,
                  const std::vector<std::string>& offers, const char* help);
/** A field of the volume, or an expression; with `may_be_scenes` also "as the scene". */
bool field_choice(Ui& ui, const std::string& name, const char* label, std::optional<std::string>& field, bool may_be_scenes,
                  const char* help);

/** The same for what stands under a key of a part of the scene; `usual` is what it means if nothing does. */
bool check(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, bool usual, const char* help);
bool number(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, double usual, double extent,
            const char* help);
bool positive_number(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, double extent,
                     const char* help);
bool slider(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, double usual, double lower,
            double upper, const char* help);
bool whole_slider(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, int usual, int lower,
                  int upper, const char* help);
bool vector(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, double extent, const char* help);
bool color(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, const Rgb& usual, const char* help);
/** A colour that may be left to the program. */
bool optional_color(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, const Rgb& start,
                    const char* help);
/** Empty, it says nothing. */
bool text(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, const char* help,
          const char* hint = "");
bool number_list(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, const char* help);
/** The first word is the usual one. */
bool choice(Ui& ui, const std::string& name, const char* label, Json& part, const char* key,
            const std::vector<std::string>& words, const char* help);
bool offered_text(Ui& ui, const std::string& name, const char* label, Json& part, const char* key,
                  const std::vector<std::string>& offers, const char* help);
bool field_choice(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, bool may_be_scenes,
                  const char* help);
/** What may be left out: a mark by which it begins as `start`. Returns whether it came or went. */
bool optional_part(Ui& ui, const std::string& name, const char* label, Json& whole, const char* key, const Json& start,
                   const char* help);
/** A length that may be left to the program. */
bool optional_length(Ui& ui, const std::string& name, const char* label, Json& part, const char* key, double start,
                     double extent, const char* help);

} // namespace elvis::view
