// A solver of one process whose basis its own functions know: a table in place of arrays.
#include <elvis/insitu.h>

#include <core/base/cancel.hpp>
#include <core/parts/part_volume.hpp>
#include <core/parts/partition.hpp>
#include <core/render/frame.hpp>
#include <core/session/volume/warped.hpp>
#include <tests/insitu/thread_ranks.hpp>
#include <tests/support/program_folder.hpp>

#include <elvis/demand.h>
#include <elvis/native/serve.hpp>

#include <catch2/catch.hpp>
#include <hdf5.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <numeric>
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

    const RuntimeVolume& volume() const { return *m_volume; }

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
    REQUIRE(elvis_insitu_open_runtime(context, nullptr, &table, file.served, nullptr, plan, folder.c_str(), &insitu) ==
            ELVIS_OK);
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
    REQUIRE(elvis_insitu_open_runtime(context, nullptr, &table, file.served, nullptr, plan, folder.c_str(), &insitu) ==
            ELVIS_OK);
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

namespace {

using Elements = std::vector<std::uint64_t>;

/** Some elements of the file, as a rank serves them. */
class ServedPart {
public:
    ServedPart(const ServedFile& file, const Elements& elements) {
        m_volume.emplace(serve_native(
            std::make_shared<const PartVolume>(native_source(file.path("whole.h5")), std::vector<Elements>{elements}), "part",
            &m_control, &served));
    }
    elvis_volume* served = nullptr;

private:
    TaskControl m_control;
    std::optional<RuntimeVolume> m_volume;
};

constexpr std::uint64_t n_elements_in_file = 36;

/** Of each rank: as `elvis render --parts` has them. */
std::vector<Elements> shares(std::uint32_t n_ranks) {
    const Partition partition = Partition::in_shares(n_elements_in_file, n_ranks);
    std::vector<Elements> all;
    for (std::uint32_t rank = 0; rank < n_ranks; ++rank) {
        all.push_back(partition.elements(rank));
    }
    return all;
}

/** The native volume's functions. */
elvis_runtime native_table() {
    elvis_runtime table = *native::runtime_table();
    table.probe = nullptr;
    table.open = nullptr;
    table.close = nullptr;
    return table;
}

/** Whether ranks serve elements of others that touch their own. */
enum class Around { served, not_served };

/** A rank's own elements, with those around them. */
Elements with_around(const ServedFile& file, const Elements& own) {
    std::vector<double> boxes(6 * n_elements_in_file);
    file.volume().bounds(0, n_elements_in_file, boxes);
    return with_surroundings(boxes, own);
}

/** What goes wrong on ranks that have these elements. */
std::vector<std::string> run_ranks(const ServedFile& file, const std::vector<Elements>& elements, const std::string& plan,
                                   const std::string& folder, Around around = Around::not_served,
                                   const std::function<void(std::uint32_t, elvis_runtime&)>& change = {}) {
    std::vector<std::string> errors(elements.size());
    ThreadRanks(static_cast<std::uint32_t>(elements.size())).run([&](const elvis_communicator& own) {
        const Elements& of_rank = elements[own.rank];
        const Elements served = around == Around::served ? with_around(file, of_rank) : of_rank;
        const ServedPart part(file, served);
        std::vector<std::uint8_t> is_own;
        for (const std::uint64_t element : served) {
            is_own.push_back(std::ranges::binary_search(of_rank, element) ? 1 : 0);
        }
        elvis_context* context = nullptr;
        elvis_insitu* insitu = nullptr;
        elvis_context_create(&file.context_options, &context);
        elvis_runtime table = native_table();
        if (change) {
            change(own.rank, table);
        }
        if (elvis_insitu_open_runtime(context, &own, &table, part.served, around == Around::served ? is_own.data() : nullptr,
                                      plan.c_str(), folder.c_str(), &insitu) != ELVIS_OK ||
            elvis_insitu_step(insitu, 0, 0) != ELVIS_OK) {
            errors[own.rank] = elvis_context_error(context);
        }
        elvis_insitu_release(insitu);
        elvis_context_release(context);
    });
    return errors;
}

/** Of a file of buffers. */
std::vector<std::uint32_t> flags_in(const std::string& path) {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), dataset = H5Dopen(file, "flags", H5P_DEFAULT);
    const hid_t space = H5Dget_space(dataset);
    std::vector<std::uint32_t> flags(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    CHECK(H5Dread(dataset, H5T_NATIVE_UINT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, flags.data()) >= 0);
    H5Sclose(space);
    H5Dclose(dataset);
    H5Fclose(file);
    return flags;
}

} // namespace

TEST_CASE("Tables of several ranks draw what elvis render draws in as many parts, and sample and integrate the same") {
    const ServedFile file;
    const std::string head =
        R"({"version": 1, "volume": {"path": "../whole.h5"}, "image": {"size": [64, 48]}, "color_map": {"range": [-1, 1]})";
    file.write("scenes/all.json",
               head + R"(, "surfaces": [{"type": "plane", "plane": [1, 0.2, 0.1, 0.1]}, {"type": "isosurface", "values": [0.3]},
        {"type": "boundary", "opacity": 0.3}], "volume_rendering": {"density": [[-2, 0], [2, 1]]}})");
    file.write("scenes/default.json", head + "}");
    const std::string plan =
        R"~({"version": 1, "outputs": [{"name": "all", "scene": "all.json"}, {"name": "default", "scene": "default.json"},
        {"name": "points", "points": [[0.3, 0.1, 0.2], [-0.4, 0.6, -0.7], [0.1, -0.5, 0.8]]},
        {"name": "sums", "quantities": ["integral(waves^2)"]}, {"name": "most", "quantities": ["maximum(waves)"]}]})~";
    for (const std::uint32_t n_ranks : {1u, 2u, 3u}) {
        const std::string folder = file.path("scenes");
        REQUIRE(run_ranks(file, shares(n_ranks), plan, folder) == std::vector<std::string>(n_ranks));
        for (const std::string name : {"all", "default"}) {
            INFO(name << " on " << n_ranks);
            const std::string parts = n_ranks > 1 ? " --parts " + std::to_string(n_ranks) : "";
            REQUIRE(file.run("render scenes/" + name + ".json" + parts + " -o " + name + ".png").status == 0);
            CHECK(file.read("scenes/" + name + "_000000.png") == file.read(name + ".png"));
        }
    }
    // Rows of one, two and three ranks, one after the other in the same tables.
    // Extrema are certain to a thousandth of their distance; all else is rounding.
    const struct {
        const char* name;
        std::size_t n_rows;
        double tolerance;
    } tables[] = {{"points.csv", 3, 1e-12}, {"sums.csv", 1, 1e-12}, {"most.csv", 1, 1e-3}};
    for (const auto& [name, n_rows, tolerance] : tables) {
        INFO(name);
        std::istringstream lines(file.read(std::string("scenes/") + name));
        std::string title;
        std::getline(lines, title);
        std::vector<std::string> rows;
        for (std::string row; std::getline(lines, row);) {
            rows.push_back(row);
        }
        REQUIRE(rows.size() == 3 * n_rows);
        for (std::size_t at = n_rows; at < rows.size(); ++at) {
            CHECK(last_number(rows[at]) == Approx(last_number(rows[at % n_rows])).epsilon(tolerance));
        }
    }
}

TEST_CASE("Ranks show the same where a scene names no surfaces, though one of them has no boundary") {
    const ServedFile file;
    file.write("scenes/default.json", R"({"version": 1, "volume": {"path": "../whole.h5"}, "image": {"size": [64, 48]}})");
    REQUIRE(file.run("render scenes/default.json -o whole.png").status == 0);
    // Two of the 4 x 3 x 3 elements lie inside.
    const Elements inner{17, 18};
    Elements others;
    for (std::uint64_t element = 0; element < n_elements_in_file; ++element) {
        if (!std::ranges::binary_search(inner, element)) {
            others.push_back(element);
        }
    }
    const std::string plan = R"({"version": 1, "outputs": [{"name": "default", "scene": "default.json"}]})";
    REQUIRE(run_ranks(file, {inner, others}, plan, file.path("scenes")) == std::vector<std::string>(2));
    CHECK(file.read("scenes/default_000000.png") == file.read("whole.png"));
}

TEST_CASE("Along borders between ranks lines are open, unless they serve the elements around their own, too") {
    const ServedFile file;
    file.write(
        "scenes/lines.json",
        R"({"version": 1, "volume": {"path": "../whole.h5"}, "image": {"size": [160, 120]}, "color_map": {"range": [-1, 1]},
        "surfaces": [{"type": "plane", "plane": [1, 0.2, 0.1, 0.1], "mesh_lines": {}, "contours": {"count": 7}}]})");
    REQUIRE(file.run("render scenes/lines.json -o whole.png --buffers whole_buffers.h5").status == 0);
    const std::string plan = R"({"version": 1, "outputs": [{"name": "lines", "scene": "lines.json", "buffers": true}]})";
    REQUIRE(run_ranks(file, shares(3), plan, file.path("scenes"), Around::not_served) == std::vector<std::string>(3));
    const std::vector<std::uint32_t> whole = flags_in(file.path("whole_buffers.h5")),
                                     ranks = flags_in(file.path("scenes/lines_000000.h5"));
    REQUIRE(whole.size() == ranks.size());
    constexpr std::uint32_t lines = pixel_flag::contour | pixel_flag::mesh_line;
    constexpr std::uint32_t open = pixel_flag::contour_undecided | pixel_flag::mesh_line_undecided;
    std::size_t n_lines = 0, n_silent = 0, n_open = 0;
    for (std::size_t pixel = 0; pixel < whole.size(); ++pixel) {
        n_lines += (whole[pixel] & lines) != 0 ? 1 : 0;
        n_open += (ranks[pixel] & open) != 0 ? 1 : 0;
        n_silent += ((whole[pixel] ^ ranks[pixel]) & lines) != 0 && ((whole[pixel] | ranks[pixel]) & open) == 0 ? 1 : 0;
    }
    std::printf("lines on three ranks: %zu pixels with lines, %zu open, %zu others than in the whole and not flagged\n",
                n_lines, n_open, n_silent);
    CHECK(n_lines > 1000);
    CHECK(n_silent == 0);
    CHECK(n_open < n_lines);
    // With the elements around them nothing is open that is not in the parts of a file.
    REQUIRE(file.run("render scenes/lines.json --parts 3 -o parts.png --buffers parts_buffers.h5").status == 0);
    CHECK(ranks != flags_in(file.path("parts_buffers.h5")));
    REQUIRE(run_ranks(file, shares(3), plan, file.path("scenes"), Around::served) == std::vector<std::string>(3));
    CHECK(file.read("scenes/lines_000000.png") == file.read("parts.png"));
    CHECK(flags_in(file.path("scenes/lines_000000.h5")) == flags_in(file.path("parts_buffers.h5")));
    // Every other element: what a rank serves is then scattered among all.
    std::vector<Elements> every_other(2);
    std::string partition;
    for (std::uint64_t element = 0; element < n_elements_in_file; ++element) {
        every_other[element % 2].push_back(element);
        partition += std::to_string(element % 2) + "\n";
    }
    file.write("partition.txt", partition);
    REQUIRE(file.run("render scenes/lines.json --parts partition.txt -o other.png --buffers other.h5").status == 0);
    REQUIRE(run_ranks(file, every_other, plan, file.path("scenes"), Around::served) == std::vector<std::string>(2));
    CHECK(file.read("scenes/lines_000000.png") == file.read("other.png"));
    CHECK(flags_in(file.path("scenes/lines_000000.h5")) == flags_in(file.path("other.h5")));
}

TEST_CASE("Tables that cannot be those of one volume are refused on all ranks with the same words") {
    const ServedFile file;
    const std::string plan = R"({"version": 1, "outputs": []})";
    const auto refused = [&](const std::string& why, const std::function<void(std::uint32_t, elvis_runtime&)>& change) {
        const std::vector<std::string> errors = run_ranks(file, shares(2), plan, ".", Around::not_served, change);
        INFO(errors[0]);
        CHECK(errors[0] == errors[1]);
        CHECK(errors[0].find(why) != std::string::npos);
    };
    refused("are not those of rank 0", [](std::uint32_t rank, elvis_runtime& table) {
        table.get_field_ranges = rank == 1 ? nullptr : table.get_field_ranges;
    });
    refused("does not say that records belong to elements", [](std::uint32_t, elvis_runtime& table) {
        table.get_snippet = [](elvis_volume* volume, std::uint32_t element_class, elvis_snippet* out) {
            const elvis_result result = native::runtime_table()->get_snippet(volume, element_class, out);
            out->capabilities &= ~std::uint32_t{ELVIS_SNIPPET_ELEMENT_RECORDS};
            return result;
        };
    });
    refused("two elements have the number 0", [](std::uint32_t, elvis_runtime& table) {
        table.get_element_numbers = [](elvis_volume*, std::uint64_t first, std::uint64_t count, std::int64_t* numbers) {
            std::iota(numbers, numbers + count, static_cast<std::int64_t>(first));
            return elvis_result{ELVIS_OK};
        };
    });
    const std::vector<std::string> errors = run_ranks(file, {{0, 1}, {1, 2}}, plan, ".");
    CHECK(errors[0] == errors[1]);
    CHECK(errors[0].find("an element is one rank's own") != std::string::npos);
    // Rank 0 serves element 12, which is around its own, and nobody's.
    const std::vector<std::string> lonely = run_ranks(file, {{0}, {1, 2}}, plan, ".", Around::served);
    CHECK(lonely[0] == lonely[1]);
    CHECK(lonely[0].find("is no rank's own") != std::string::npos);
    elvis_context* context = nullptr;
    elvis_insitu* insitu = nullptr;
    elvis_context_create(&file.context_options, &context);
    const elvis_runtime table = native_table();
    const std::vector<std::uint8_t> none(n_elements_in_file, 0);
    CHECK(elvis_insitu_open_runtime(context, nullptr, &table, file.served, none.data(), plan.c_str(), nullptr, &insitu) !=
          ELVIS_OK);
    CHECK(std::string(elvis_context_error(context)).find("has elements that are not its own") != std::string::npos);
    elvis_context_release(context);
}
