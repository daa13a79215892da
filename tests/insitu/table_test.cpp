// A solver of one process whose basis its own functions know: a table in place of arrays.
#include <elvis/insitu.h>

#include <core/base/cancel.hpp>
#include <core/session/volume/warped.hpp>
#include <tests/insitu/thread_ranks.hpp>
#include <tests/support/program_folder.hpp>

#include <elvis/native/serve.hpp>

#include <catch2/catch.hpp>

#include <sstream>

using namespace elvis;
using namespace elvis::test;

namespace {

/** The native volume's functions, with values times `factor`. */
struct ScaledTable {
    static inline double factor = 1;

    static elvis_runtime make() {
        elvis_runtime table = *native::runtime_table();
        table.probe = nullptr;
        table.open = nullptr;
        table.close = nullptr;
        table.get_field_ranges = nullptr;
        table.get_field_derivative_bounds = nullptr;
        table.fill_buffer = fill_buffer;
        table.evaluate_field = evaluate_field;
        return table;
    }

private:
    static elvis_result fill_buffer(elvis_volume* volume, const elvis_fill_request* request, void* destination) {
        elvis_buffer buffer{};
        buffer.struct_size = sizeof buffer;
        native::runtime_table()->get_buffer(volume, request->buffer, request->field, &buffer);
        // Its own offset is multiplied, too.
        const double offset = request->field_offset[0] / factor;
        elvis_fill_request unscaled = *request;
        unscaled.field_offset = &offset;
        const elvis_result result = native::runtime_table()->fill_buffer(volume, &unscaled, destination);
        auto* numbers = static_cast<double*>(destination);
        for (std::uint64_t at = 0; buffer.depends != 0 && at < request->count * buffer.record_size; ++at) {
            numbers[at] *= factor;
        }
        return result;
    }
    static elvis_result evaluate_field(elvis_volume* volume, std::uint32_t field, std::uint32_t step, std::uint64_t element,
                                       std::uint64_t n, const double* xi, double* values, double* gradients) {
        const elvis_result result =
            native::runtime_table()->evaluate_field(volume, field, step, element, n, xi, values, gradients);
        for (std::uint64_t at = 0; at < n; ++at) {
            values != nullptr ? values[at] *= factor : 0;
            for (std::uint64_t axis = 0; gradients != nullptr && axis < 3; ++axis) {
                gradients[3 * at + axis] *= factor;
            }
        }
        return result;
    }
};

/** A volume in a file, and what the native functions know it by. */
class ServedFile : public ProgramFolder {
public:
    ServedFile() {
        write("input.json", R"({"generator": 1, "mesh": "waves", "elements": [4, 3, 3], "order": 2, "field": "waves"})");
        REQUIRE(run("convert input.json -o whole.h5").status == 0);
        m_volume.emplace(serve_native(native_source(path("whole.h5")), "whole", &m_control, &served));
        context_options.struct_size = sizeof context_options;
        context_options.plugin_path = ELVIS_TEST_PLUGINS;
    }

    elvis_volume* served = nullptr;
    elvis_context_options context_options{};

private:
    TaskControl m_control;
    std::optional<RuntimeVolume> m_volume;
};

double last_number(const std::string& line) { return std::stod(line.substr(line.rfind(',') + 1)); }

} // namespace

TEST_CASE("A solver's own functions are drawn, sampled and integrated at each step, by one process") {
    const ServedFile file;
    file.write("scene.json", R"({"version": 1, "volume": {"path": "whole.h5"}, "image": {"size": [64, 48]},
        "color_map": {"range": [-1, 1]}, "surfaces": [{"type": "plane", "plane": [1, 0.2, 0.1, 0.1]}]})");
    REQUIRE(file.run("render scene.json -o whole.png").status == 0);
    const char* const plan = R"~({"version": 1, "outputs": [{"name": "cut", "scene": "scene.json"},
        {"name": "point", "points": [[0.3, 0.1, 0.2]]}, {"name": "sum", "quantities": ["integral(waves^2)"]}]})~";
    const elvis_runtime table = ScaledTable::make();
    elvis_context* context = nullptr;
    elvis_insitu* insitu = nullptr;
    elvis_context_create(&file.context_options, &context);
    ScaledTable::factor = 1;
    const std::string folder = file.path("");
    REQUIRE(elvis_insitu_open_runtime(context, nullptr, &table, file.served, plan, folder.c_str(), &insitu) == ELVIS_OK);
    CHECK(elvis_insitu_step(insitu, 0, 0) == ELVIS_OK);
    ScaledTable::factor = 0.5;
    CHECK(elvis_insitu_step(insitu, 1, 0.1) == ELVIS_OK);
    ScaledTable::factor = 1;
    CHECK(elvis_insitu_step(insitu, 2, 0.2) == ELVIS_OK);
    CHECK(elvis_insitu_set_values(insitu, 0, 0, nullptr) == ELVIS_ERROR_INVALID_ARGUMENT);
    elvis_insitu_release(insitu);
    elvis_context_release(context);
    CHECK(file.read("cut_000000.png") == file.read("whole.png"));
    CHECK(file.read("cut_000001.png") != file.read("whole.png"));
    CHECK(file.read("cut_000002.png") == file.read("whole.png"));
    for (const auto& [name, ratio] : {std::pair{"point.csv", 0.5}, std::pair{"sum.csv", 0.25}}) {
        std::istringstream lines(file.read(name));
        std::string head, first, second;
        std::getline(lines, head);
        std::getline(lines, first);
        std::getline(lines, second);
        CHECK(last_number(first) != 0);
        CHECK(last_number(second) == Approx(ratio * last_number(first)).epsilon(1e-12));
    }
}

#ifdef ELVIS_TEST_FORTRAN
extern "C" elvis_result run_fortran_solver(elvis_context* context, const elvis_runtime* runtime, elvis_volume* volume,
                                           const char* folder);

TEST_CASE("A solver in Fortran hands over a table of functions") {
    const ServedFile file;
    const elvis_runtime table = ScaledTable::make();
    elvis_context* context = nullptr;
    elvis_insitu* insitu = nullptr;
    elvis_context_create(&file.context_options, &context);
    ScaledTable::factor = 1;
    const std::string folder = file.path("");
    CHECK(run_fortran_solver(context, &table, file.served, folder.c_str()) == ELVIS_OK);
    // The same in C adds the same row to the same table.
    const char* const plan = R"~({"version": 1, "outputs": [{"name": "sum", "quantities": ["integral(waves^2)"]}]})~";
    REQUIRE(elvis_insitu_open_runtime(context, nullptr, &table, file.served, plan, folder.c_str(), &insitu) == ELVIS_OK);
    CHECK(elvis_insitu_step(insitu, 0, 0) == ELVIS_OK);
    elvis_insitu_release(insitu);
    std::istringstream lines(file.read("sum.csv"));
    std::string head, of_fortran, of_c;
    std::getline(lines, head);
    std::getline(lines, of_fortran);
    std::getline(lines, of_c);
    CHECK(of_fortran == of_c);
    CHECK(last_number(of_c) > 0.1);
    elvis_runtime without = table;
    without.get_class = nullptr;
    CHECK(run_fortran_solver(context, &without, file.served, folder.c_str()) != ELVIS_OK);
    elvis_context_release(context);
}
#endif

TEST_CASE("A table of functions is refused on several ranks, on all with the same words") {
    const ServedFile file;
    const elvis_runtime table = ScaledTable::make();
    std::vector<std::string> errors(2);
    ThreadRanks(2).run([&](const elvis_communicator& own) {
        elvis_context* context = nullptr;
        elvis_insitu* insitu = nullptr;
        elvis_context_create(&file.context_options, &context);
        CHECK(elvis_insitu_open_runtime(context, &own, &table, file.served, R"({"version": 1, "outputs": []})", nullptr,
                                        &insitu) != ELVIS_OK);
        errors[own.rank] = elvis_context_error(context);
        elvis_context_release(context);
    });
    CHECK(errors[0] == errors[1]);
    CHECK(errors[0].find("2 ranks; a table of functions is taken on one rank alone") != std::string::npos);
}
