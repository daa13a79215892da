/*
 * A program shows its own volume: a table of functions and a pointer. Here both are the native plugin's, opened by hand.
 */
#include <elvis/elvis.hpp>
#include <elvis/plugin.h>

#include <tests/support/files.hpp>

#include <catch2/catch.hpp>

#include <dlfcn.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <fstream>

namespace {

using elvis::test::TemporaryFolder;

elvis_context_options own_plugins() {
    auto options = elvis::detail::sized<elvis_context_options>();
    options.plugin_path = ELVIS_TEST_PLUGINS;
    return options;
}

/** The solver: a volume whose field it multiplies, from one step to the next. */
class Solver {
public:
    explicit Solver(const std::string& path) {
        const std::string library = std::string(ELVIS_TEST_PLUGINS) + "/elvis_native_plugin.so";
        m_library = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
        REQUIRE(m_library != nullptr);
        const auto entry = reinterpret_cast<const elvis_plugin_descriptor* (*)()>(dlsym(m_library, ELVIS_PLUGIN_ENTRY));
        native = *static_cast<const elvis_runtime*>(entry()->get_interface(ELVIS_RUNTIME_INTERFACE));
        host.struct_size = sizeof host;
        host.abi_version = ELVIS_ABI_VERSION;
        host.log = [](const elvis_host*, elvis_log_level, const char*) {};
        host.report_progress = [](const elvis_host*, double, const char*) {};
        host.is_cancelled = [](const elvis_host*) -> std::int32_t { return 0; };
        host.set_error = [](const elvis_host*, const char*, const char*) {};
        REQUIRE(native.open(&host, path.c_str(), nullptr, &m_volume) == ELVIS_OK);
    }
    ~Solver() { native.close(m_volume); }
    Solver(const Solver&) = delete;
    Solver& operator=(const Solver&) = delete;

    elvis_volume* volume() const { return m_volume; }
    /** Without what a program that shows its own data need not have, and with the field multiplied by `factor`. */
    static elvis_runtime table() {
        elvis_runtime table = native;
        table.probe = nullptr;
        table.open = nullptr;
        table.close = nullptr;
        table.get_field_ranges = nullptr;
        table.get_field_derivative_bounds = nullptr;
        table.fill_buffer = [](elvis_volume* volume, const elvis_fill_request* request, void* destination) {
            elvis_buffer buffer{};
            buffer.struct_size = sizeof buffer;
            native.get_buffer(volume, request->buffer, request->field, &buffer);
            ++(buffer.depends == 0 ? n_fills_of_mesh : n_fills[request->field]);
            // Its own offset is multiplied, too.
            const double offset = request->field_offset[0] / factor;
            elvis_fill_request unscaled = *request;
            unscaled.field_offset = &offset;
            const elvis_result result = native.fill_buffer(volume, &unscaled, destination);
            auto* numbers = static_cast<double*>(destination);
            for (std::uint64_t at = 0; buffer.depends != 0 && at < request->count * buffer.record_size; ++at) {
                numbers[at] *= factor;
            }
            return result;
        };
        table.evaluate_field = [](elvis_volume* volume, std::uint32_t field, std::uint32_t step, std::uint64_t element,
                                  std::uint64_t n, const double* xi, double* values, double* gradients) {
            const elvis_result result = native.evaluate_field(volume, field, step, element, n, xi, values, gradients);
            for (std::uint64_t at = 0; at < n; ++at) {
                values != nullptr ? values[at] *= factor : 0;
                for (std::uint64_t axis = 0; gradients != nullptr && axis < 3; ++axis) {
                    gradients[3 * at + axis] *= factor;
                }
            }
            return result;
        };
        return table;
    }

    /** As from a file, but for the call of get_field_ranges after which `wants_stop` holds: `n_before_stop` go before. */
    static elvis_runtime stopping_table() {
        elvis_runtime table = native;
        table.probe = nullptr;
        table.open = nullptr;
        table.close = nullptr;
        table.get_field_ranges = [](elvis_volume* volume, std::uint32_t field, std::uint32_t step, std::uint64_t first,
                                    std::uint64_t count, double* ranges, elvis_certainty* certainty) {
            if (n_before_stop-- == 0) {
                wants_stop = true;
            }
            return native.get_field_ranges(volume, field, step, first, count, ranges, certainty);
        };
        return table;
    }
    static inline std::atomic<int> n_before_stop = 0;
    static inline std::atomic<bool> wants_stop = false;

    static inline double factor = 1;
    /** Calls of fill_buffer, by field and for what depends on none. */
    static inline std::array<std::atomic<int>, 2> n_fills{};
    static inline std::atomic<int> n_fills_of_mesh = 0;

private:
    static inline elvis_runtime native{};
    static inline elvis_host host{};
    void* m_library = nullptr;
    elvis_volume* m_volume = nullptr;
};

constexpr const char* two_fields = R"({"generator": 1, "mesh": "waves", "elements": [3, 3, 3], "geometry_order": 2,
    "fields": [{"field": "polynomial", "name": "p", "coefficients": [[2, 1, 0, 1], [0, 0, 1, 1]]}, "sphere"]})";

std::string make_volume(const elvis::context& context, const TemporaryFolder& folder, const char* description = two_fields) {
    std::ofstream(folder.path("input.json")) << description;
    const std::string input = folder.path("input.json"), output = folder.path("volume.h5");
    auto conversion = elvis::detail::sized<elvis_conversion>();
    const char* const inputs[] = {input.c_str()};
    conversion.n_inputs = 1;
    conversion.inputs = inputs;
    conversion.output = output.c_str();
    conversion.order = -1;
    context.convert(conversion);
    return output;
}

elvis::scene plane(const elvis::context& context) {
    elvis::scene scene = context.make_scene();
    scene.set("/image/size", "[48, 36]");
    scene.set("/surfaces/-", R"({"type": "plane", "plane": [0.1, 0.2, 1, -0.3]})");
    return scene;
}

} // namespace

TEST_CASE("A program's own volume is drawn like the same one from a file") {
    const elvis::context context(own_plugins());
    const TemporaryFolder folder;
    const std::string path = make_volume(context, folder);
    Solver::factor = 1;
    const Solver solver(path);
    const elvis_runtime table = Solver::table();
    const elvis::data own = context.from_runtime(table, solver.volume(), "step 1");
    const elvis::data file = context.open(path);
    const elvis::scene scene = plane(context);
    const elvis::picture of_own = own.render(scene), of_file = file.render(scene);
    CHECK(of_own.read<std::int64_t>(ELVIS_CHANNEL_ELEMENT) == of_file.read<std::int64_t>(ELVIS_CHANNEL_ELEMENT));
    CHECK(of_own.read<double>(ELVIS_CHANNEL_COLOR) == of_file.read<double>(ELVIS_CHANNEL_COLOR));
    CHECK(own.probe({0.3, 0.4, 0.5}, {"p"}).values[0] == file.probe({0.3, 0.4, 0.5}, {"p"}).values[0]);
    CHECK_THROWS_WITH(own.probe({0, 0, 0}, {"p"}, 1), Catch::Contains("time step"));
}

TEST_CASE("Values that the program has changed are drawn after it says so, with their own colour range") {
    const elvis::context context(own_plugins());
    const TemporaryFolder folder;
    const std::string path = make_volume(context, folder);
    Solver::factor = 1;
    const Solver solver(path);
    const elvis_runtime table = Solver::table();
    elvis::data own = context.from_runtime(table, solver.volume());
    const elvis::scene scene = plane(context);
    const elvis::picture before = own.render(scene);
    const elvis_range range = own.range("p");
    for (const double factor : {-3.0, 0.5}) {
        Solver::factor = factor;
        own.fields_changed();
        const elvis::picture after = own.render(scene);
        const std::vector<double> old = before.read<double>(ELVIS_CHANNEL_VALUE),
                                  values = after.read<double>(ELVIS_CHANNEL_VALUE);
        double largest = 0;
        std::size_t n_seen = 0;
        for (std::size_t at = 0; at < old.size(); ++at) {
            REQUIRE(std::isnan(old[at]) == std::isnan(values[at]));
            if (!std::isnan(old[at])) {
                largest = std::max(largest, std::abs(values[at] - factor * old[at]));
                ++n_seen;
            }
        }
        CHECK(n_seen > 300);
        CHECK(largest < 1e-5);
        const elvis_range changed = own.range("p");
        CHECK(changed.maximum == Approx(factor > 0 ? factor * range.maximum : factor * range.minimum).epsilon(1e-3));
        // The same picture as of data that never had other values.
        CHECK(context.from_runtime(table, solver.volume()).render(scene).read<double>(ELVIS_CHANNEL_COLOR) ==
              after.read<double>(ELVIS_CHANNEL_COLOR));
    }
}

TEST_CASE("Of several fields only the one that has changed is asked for again, and nothing of the mesh") {
    const elvis::context context(own_plugins());
    const TemporaryFolder folder;
    const std::string path = make_volume(context, folder);
    Solver::factor = 1;
    const Solver solver(path);
    elvis::data own = context.from_runtime(Solver::table(), solver.volume());
    elvis::scene scene = plane(context);
    scene.set("/surfaces/-", R"({"type": "plane", "plane": [1, 0.2, 0.1, -0.3], "field": "sphere"})");
    own.render(scene);
    const auto fills = [&] {
        Solver::n_fills[0] = Solver::n_fills[1] = Solver::n_fills_of_mesh = 0;
        own.render(scene);
        return std::array<bool, 3>{Solver::n_fills[0] > 0, Solver::n_fills[1] > 0, Solver::n_fills_of_mesh > 0};
    };
    CHECK(fills() == std::array{false, false, false});
    own.fields_changed(1);
    CHECK(fills() == std::array{false, true, false});
    own.fields_changed(0);
    CHECK(fills() == std::array{true, false, false});
    own.fields_changed();
    CHECK(fills() == std::array{true, true, false});
    CHECK_THROWS_WITH(own.fields_changed(2), Catch::Contains("2 fields"));
}

TEST_CASE("A table that lacks a function is refused by its name") {
    const elvis::context context(own_plugins());
    const TemporaryFolder folder;
    const Solver solver(make_volume(context, folder));
    elvis_runtime table = Solver::table();
    table.get_bounds = nullptr;
    CHECK_THROWS_WITH(context.from_runtime(table, solver.volume(), "mine"),
                      Catch::Contains("get_bounds") && Catch::Contains("mine"));
}

namespace {

void check_stopping(const std::string& shape) {
    const elvis::context context(own_plugins());
    const TemporaryFolder folder;
    const std::string description =
        R"({"generator": 1, "mesh": "ball", "elements": 1, "order": 2, "geometry_order": 2, "field": "waves", "shape": ")" +
        shape + "\"}";
    const Solver solver(make_volume(context, folder, description.c_str()));
    elvis::scene scene = context.make_scene();
    scene.set("/image/size", "[32, 24]");
    scene.set("/surfaces/-", R"({"type": "isosurface", "values": [0.2]})");
    const elvis_runtime table = Solver::stopping_table();
    const auto fresh = [&] { return context.from_runtime(table, solver.volume()); };
    Solver::n_before_stop = -1;
    Solver::wants_stop = false;
    const std::vector<double> expected = fresh().render(scene).read<double>(ELVIS_CHANNEL_COLOR);
    int n_stopped = 0;
    for (int n = 0; n < 100; ++n) {
        const elvis::data own = fresh();
        Solver::n_before_stop = n;
        Solver::wants_stop = false;
        const auto options = elvis::detail::sized<elvis_render_options>();
        try {
            own.render(scene, options, {{}, [] { return Solver::wants_stop.load(); }});
        } catch (const elvis::cancelled&) {
            ++n_stopped;
        }
        const bool was_asked = Solver::wants_stop;
        Solver::n_before_stop = -1;
        Solver::wants_stop = false;
        CHECK((own.render(scene).read<double>(ELVIS_CHANNEL_COLOR) == expected));
        if (!was_asked) {
            break;
        }
    }
    CHECK(n_stopped >= 4);
}

} // namespace

TEST_CASE("An isosurface that is stopped while ranges are asked for is the same the next time") { check_stopping("prism"); }

TEST_CASE("An isosurface in all shapes that is stopped is the same the next time", "[.long]") { check_stopping("mixed"); }
