// Arguments that make no sense give errors: random calls, for sanitizers to look at.

#include "some_volume.hpp"

#include <elvis/extract.hpp>
#include <nlohmann/json.hpp>

#include <functional>
#include <limits>
#include <random>

using namespace elvis;
using nlohmann::json;
using test::convert;
using test::own_plugins;
using test::TemporaryFolder;

namespace {

class Dice {
public:
    std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(m_engine); }
    double number() {
        constexpr double odd[] = {
            0, -1, 1e-300, 1e300, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()};
        return below(8) == 0 ? odd[below(std::size(odd))] : std::uniform_real_distribution<double>(-1, 2)(m_engine);
    }
    const char* text() {
        constexpr const char* texts[] = {"p", "p+", "norm(grad(p))", "grad(p)",     "distance(cut)", "distance(",
                                         "",  "q",  "\xff\xfe",      "((((((((((p", "p[3]",          "wall"};
        return below(2) == 0 ? "p" : texts[below(std::size(texts))];
    }
    std::uint32_t small() { return static_cast<std::uint32_t>(below(6)); }

private:
    std::mt19937 m_engine{11};
};

/** A scene in which some value may be something else. */
json spoilt(Dice& dice) {
    const json whole = json::parse(R"({"version": 1, "image": {"size": [16, 12], "samples": 1, "annotation": {"title": "a"}},
        "camera": {"eye": [3, 2, 1], "look_at": [0, 0, 0], "image_shift": [1, 2]}, "color_map": {"name": "gray", "range": [0, 1]},
        "surfaces": [{"type": "plane", "plane": [0, 0, 1, -0.4], "name": "cut", "clip": [[1, 0, 0, 0]]},
                     {"type": "isosurface", "values": [0.5], "field": "p"}],
        "volume_rendering": {"visible": false, "peaks": [{"value": 1, "width": 1, "density": 1}]},
        "lighting": {"lights": [{"type": "point", "position": [1, 1, 1]}]}, "warp": {"field": "p", "factor": 0.1}})");
    const std::vector<json> things = {nullptr, -1, 0, 1e300, "p", "", json::array(), json::object(), {1, 2, 3}, true};
    const json flat = whole.flatten();
    const auto place = std::next(flat.begin(), static_cast<std::ptrdiff_t>(dice.below(flat.size())));
    json document = whole;
    if (dice.below(2) == 0) {
        document.at(json::json_pointer(place.key())) = things[dice.below(things.size())];
    }
    if (dice.below(4) != 0) {
        document.erase("warp"); // By a field that is no vector, which is refused.
    }
    return document;
}

void render_small(const data& volume, const scene& shown) {
    auto options = detail::sized<elvis_render_options>();
    options.width = 8;
    options.height = 6;
    volume.render(shown, options);
}

} // namespace

TEST_CASE("Random arguments give errors and no crash") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder));
    Dice dice;
    const auto make_scene = [&] { return library.parse_scene(spoilt(dice).dump()); };
    const auto point = [&] { return std::array<double, 3>{dice.number(), dice.number(), dice.number()}; };
    const std::vector<std::function<void()>> calls = {
        [&] { make_scene().text(dice.text()); },
        [&] { make_scene().expression(dice.text()); },
        [&] {
            make_scene().transfer({dice.number(), dice.number()}, dice.number());
        },
        [&] {
            auto extent = detail::sized<elvis_extent>();
            std::generate_n(extent.bounds, 6, [&] { return dice.number(); });
            scene shown = make_scene();
            dice.below(2) == 0 ? shown.fit_camera(extent) : shown.complete_camera(extent);
        },
        [&] { make_scene().set(dice.text(), dice.text()); },
        [&] { make_scene().completed(volume); },
        [&] { render_small(volume, make_scene()); },
        [&] { volume.pick(make_scene(), dice.number(), dice.number()); },
        [&] { volume.sample(make_scene(), dice.text(), dice.small() * 7); },
        [&] { volume.percentiles(make_scene(), {dice.number()}); },
        [&] { volume.range(dice.text(), dice.small() / 5); },
        [&] {
            volume.probe({dice.number(), dice.number(), dice.number()}, {dice.text()}, dice.small() / 5);
        },
        [&] { volume.walk_line(point(), point(), {dice.text()}, dice.small() / 5); },
        [&] {
            auto wanted = detail::sized<elvis_integration>();
            wanted.domain = static_cast<elvis_domain>(dice.below(5));
            wanted.field = dice.text();
            wanted.level_field = dice.text();
            wanted.isovalue = dice.number();
            wanted.is_flux = dice.small() / 4;
            wanted.tolerance = dice.below(2) == 0 ? 1e-2 : dice.number();
            std::generate_n(wanted.plane, 4, [&] { return dice.number(); });
            volume.integrate(wanted);
        },
        [&] {
            const std::array<double, 3> seed = point();
            auto tracing = detail::sized<elvis_tracing>();
            tracing.field = dice.text();
            tracing.seeds = seed.data();
            tracing.n_seeds = 1;
            tracing.direction = static_cast<elvis_line_direction>(dice.below(4));
            tracing.length = dice.number();
            tracing.flags = dice.small();
            volume.trace(tracing);
        },
        [&] {
            auto wanted = detail::sized<elvis_extraction>();
            wanted.domain = static_cast<elvis_domain>(dice.below(5));
            wanted.level_field = dice.text();
            wanted.isovalue = dice.number();
            std::generate_n(wanted.plane, 4, [&] { return dice.number(); });
            wanted.tolerance = dice.below(2) == 0 ? 0.1 : dice.number();
            extract(library, volume, wanted);
        },
        [&] {
            auto how = detail::sized<elvis_warp>();
            how.field = dice.text();
            how.factor = dice.number();
            volume.warp(how);
        }};
    std::size_t n_errors = 0;
    const std::size_t n_calls = 300;
    for (std::size_t i = 0; i < n_calls; ++i) {
        try {
            calls[i % calls.size()]();
        } catch (const error& wrong) {
            CHECK(std::string(wrong.what()).size() > 5);
            ++n_errors;
        }
    }
    CHECK(n_errors > n_calls / 4);
    CHECK(n_errors < 3 * n_calls / 4);
}
