#include <core/bench/surfaces.hpp>

#include <core/base/error.hpp>
#include <core/bench/plot.hpp>
#include <core/bench/repeated_frame.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>

namespace elvis {

namespace {

constexpr int n_surfaces_runs = 5;

/** Ten values that the waves field takes on its cut plane, none of them its value along a line by symmetry. */
Contours ten_contours() {
    Contours contours;
    for (int i = 0; i < 10; ++i) {
        contours.values.push_back(-1.35 + 0.3 * i);
    }
    return contours;
}

/** Nine bicubic patches across the volume, wavy in the third direction. */
CutShape wavy_patches() {
    constexpr std::size_t n_patches_a_side = 3;
    auto mesh = std::make_shared<PatchMesh>();
    for (std::size_t patch = 0; patch < n_patches_a_side * n_patches_a_side; ++patch) {
        BezierPatch bezier;
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = 0; j < 4; ++j) {
                const auto coordinate = [](std::size_t of_patch, std::size_t of_point) {
                    return -1 + 2 * static_cast<double>(3 * of_patch + of_point) / (3 * n_patches_a_side);
                };
                const double x = coordinate(patch % n_patches_a_side, i), y = coordinate(patch / n_patches_a_side, j);
                bezier.points[4 * i + j] = {x, y, 0.4 * std::sin(2.5 * x) * std::cos(2 * y)};
            }
        }
        mesh->patches.push_back(bezier);
    }
    return BezierSurface{mesh};
}

/** The kinds of surface that are compared; all seen from the same eye, all across the volume. */
std::vector<std::pair<std::string, FrameRequest>> kinds(std::uint32_t size) {
    const FrameRequest plane = waves_cut_plane(size);
    const auto with = [&plane](SurfaceGeometry geometry) {
        FrameRequest request = plane;
        request.surfaces[0].geometry = std::move(geometry);
        return request;
    };
    FrameRequest contours = plane;
    contours.surfaces[0].contours = ten_contours();
    FrameRequest mesh_lines = plane;
    mesh_lines.surfaces[0].mesh_lines = MeshLines{};
    return {{"plane", plane},
            {"plane, 10 contours", contours},
            {"plane, mesh lines", mesh_lines},
            {"cylinder", with(CutShape(Cylinder{{0, 0, -0.9}, {0, 0, 0.9}, 0.8, true}))},
            {"torus", with(CutShape(Torus{{0, 0, 0}, {0, 0, 1}, 0.6, 0.3}))},
            {"Bezier patches", with(wavy_patches())},
            {"boundary", waves_boundary(size)}};
}

class SurfacesBench {
public:
    SurfacesBench(const Device& device, const PluginRegistry& registry, const BenchFolder& folder,
                  const SurfacesOptions& options, double unit_nanoseconds,
                  const std::function<void(const SurfacesRow&)>& report)
        : m_device(device), m_registry(registry), m_folder(folder), m_options(options), m_unit(unit_nanoseconds),
          m_report(report) {}

    /** In double precision for one order, too: what single precision leaves undecided at every limit is its rounding. */
    void vary_subdivisions() {
        for (const std::uint32_t order : m_options.contour_orders) {
            vary_subdivisions(order, Precision::float32);
        }
        vary_subdivisions(m_options.contour_orders.back(), Precision::float64);
    }

    void vary_size() {
        const RuntimeVolume volume = waves_volume(m_registry, m_folder, m_options.elements_a_side, m_options.order);
        for (const std::uint32_t size : m_options.sizes) {
            draw_kinds("size", volume, m_options.order, size);
        }
    }

    void vary_order() {
        for (const std::uint32_t order : m_options.orders) {
            draw_kinds("order", waves_volume(m_registry, m_folder, m_options.elements_a_side, order), order, m_options.size);
        }
    }

    void vary_elements() {
        for (const std::uint32_t n : m_options.elements) {
            draw_kinds("elements", waves_volume(m_registry, m_folder, n, m_options.order), m_options.order, m_options.size);
        }
    }

    std::vector<SurfacesRow> rows;

private:
    void vary_subdivisions(std::uint32_t order, Precision precision) {
        const RuntimeVolume volume = waves_volume(m_registry, m_folder, m_options.contour_elements_a_side, order);
        Renderer renderer(m_device, volume, precision);
        FrameRequest request = waves_cut_plane(m_options.size);
        request.surfaces[0].contours = ten_contours();
        for (std::uint32_t subdivisions = 0; subdivisions <= m_options.most_subdivisions; ++subdivisions) {
            request.surfaces[0].subdivisions = subdivisions;
            measure("subdivisions", "plane, 10 contours", renderer, volume, order, request, precision);
        }
    }

    /** Each with a renderer of its own, so that memory is what the one kind takes. */
    void draw_kinds(const std::string& series, const RuntimeVolume& volume, std::uint32_t order, std::uint32_t size) {
        for (const auto& [name, request] : kinds(size)) {
            Renderer renderer(m_device, volume, Precision::float32);
            measure(series, name, renderer, volume, order, request);
        }
    }

    void measure(const std::string& series, const std::string& surface, Renderer& renderer, const RuntimeVolume& volume,
                 std::uint32_t order, const FrameRequest& request, Precision precision = Precision::float32) {
        SurfacesRow row;
        row.precision = precision;
        row.series = series;
        row.surface = surface;
        row.n_elements = volume.n_elements();
        row.order = order;
        row.size = request.width;
        row.subdivisions = request.surfaces[0].subdivisions;
        const RepeatedFrame repeated = render_repeatedly(renderer, request, n_surfaces_runs);
        const Frame& frame = repeated.frame;
        row.milliseconds = repeated.milliseconds;
        row.wall_milliseconds = repeated.wall_milliseconds;
        row.units = 1e6 * row.milliseconds / m_unit;
        row.hit_pixels = frame.counts.hit_pixels;
        row.contour_pixels = frame.counts.contour_pixels;
        row.undecided_pixels = frame.counts.undecided_contour_pixels;
        row.memory = renderer.memory();
        row.device_bytes = m_device.allocated_bytes();
        rows.push_back(row);
        m_report(row);
    }

    const Device& m_device;
    const PluginRegistry& m_registry;
    const BenchFolder& m_folder;
    const SurfacesOptions& m_options;
    double m_unit;
    const std::function<void(const SurfacesRow&)>& m_report;
};

void write_csv(const std::filesystem::path& path, const std::vector<SurfacesRow>& rows) {
    std::ofstream file(path);
    file << "series,surface,elements,order,size,subdivisions,precision,milliseconds,wall_milliseconds,units,hit_pixels,contour_"
            "pixels,"
            "undecided_contour_pixels,field_bytes,geometry_bytes,hierarchy_bytes,device_bytes\n";
    for (const SurfacesRow& row : rows) {
        file << row.series << ",\"" << row.surface << "\"," << row.n_elements << ',' << row.order << ',' << row.size << ','
             << row.subdivisions << ',' << name_of(row.precision) << ',' << row.milliseconds << ',' << row.wall_milliseconds
             << ',' << row.units << ',' << row.hit_pixels << ',' << row.contour_pixels << ',' << row.undecided_pixels << ','
             << row.memory.field_bytes << ',' << row.memory.geometry_bytes << ',' << row.memory.hierarchy_bytes << ','
             << row.device_bytes << '\n';
    }
    file.close();
    if (!file) {
        throw Error(path.string(), "cannot be written");
    }
}

/** Lines of a plot, in the order in which their names first come. */
class SeriesByName {
public:
    void add(const std::string& name, double x, double y) {
        const auto [position, is_new] = m_index.try_emplace(name, series.size());
        if (is_new) {
            series.push_back({name, {}});
        }
        series[position->second].points.push_back({x, y});
    }
    std::vector<PlotSeries> series;

private:
    std::map<std::string, std::size_t> m_index;
};

using SurfacesNumber = std::function<double(const SurfacesRow&)>;

/** One line a surface. */
std::vector<PlotSeries> lines(const std::vector<SurfacesRow>& rows, const std::string& series, const SurfacesNumber& x,
                              const SurfacesNumber& y) {
    SeriesByName result;
    for (const SurfacesRow& row : rows) {
        if (row.series == series) {
            result.add(row.surface, x(row), y(row));
        }
    }
    return result.series;
}

/** Memory of the pictures of one surface, by what it is for. */
std::vector<PlotSeries> memory_lines(const std::vector<SurfacesRow>& rows, const std::string& series, const SurfacesNumber& x) {
    constexpr double megabyte = 1e6;
    SeriesByName result;
    for (const SurfacesRow& row : rows) {
        if (row.series != series || row.surface != "plane, 10 contours") {
            continue;
        }
        result.add("field", x(row), static_cast<double>(row.memory.field_bytes) / megabyte);
        result.add("geometry", x(row), static_cast<double>(row.memory.geometry_bytes) / megabyte);
        result.add("hierarchy", x(row), static_cast<double>(row.memory.hierarchy_bytes) / megabyte);
        result.add("all", x(row), static_cast<double>(row.device_bytes) / megabyte);
    }
    return result.series;
}

} // namespace

std::vector<SurfacesRow> bench_surfaces(const Device& device, const PluginRegistry& registry, const BenchFolder& folder,
                                        const SurfacesOptions& options, double unit_nanoseconds,
                                        const std::function<void(const SurfacesRow&)>& report) {
    SurfacesBench bench(device, registry, folder, options, unit_nanoseconds, report);
    bench.vary_subdivisions();
    bench.vary_size();
    bench.vary_order();
    bench.vary_elements();
    return bench.rows;
}

void write_surfaces(const std::filesystem::path& folder, const std::vector<SurfacesRow>& rows) {
    std::filesystem::create_directories(folder);
    write_csv(folder / "surfaces.csv", rows);

    const auto draw = [&folder](const char* name, const char* title, const PlotAxis& x, const PlotAxis& y,
                                const std::vector<PlotSeries>& series) {
        write_svg(folder / (std::string(name) + ".svg"), {title, x, y, series});
    };
    SeriesByName undecided, subdivision_time;
    for (const SurfacesRow& row : rows) {
        if (row.series == "subdivisions") {
            const std::string name =
                "order " + std::to_string(row.order) + (row.precision == Precision::float64 ? ", float64" : "");
            undecided.add(name, row.subdivisions, static_cast<double>(row.undecided_pixels));
            subdivision_time.add(name, row.subdivisions, row.units);
        }
    }
    const PlotAxis limit{"subdivision limit", false};
    draw("undecided-by-subdivisions", "Undecided contour pixels", limit, {"pixels", true}, undecided.series);
    draw("time-by-subdivisions", "Time of ten contours", limit, {"time / U", false}, subdivision_time.series);

    const SurfacesNumber size = [](const SurfacesRow& row) { return static_cast<double>(row.size); };
    const SurfacesNumber order = [](const SurfacesRow& row) { return static_cast<double>(row.order); };
    const SurfacesNumber elements = [](const SurfacesRow& row) { return static_cast<double>(row.n_elements); };
    const SurfacesNumber units = [](const SurfacesRow& row) { return row.units; };
    const PlotAxis size_axis{"side of the picture (pixels)", false};
    const PlotAxis order_axis{"order of the field", false};
    const PlotAxis elements_axis{"elements", true};
    const PlotAxis time{"time / U", true};
    const PlotAxis memory{"memory (MB)", false};
    const PlotAxis log_memory{"memory (MB)", true};
    draw("time-by-size", "Time by size of the picture", size_axis, time, lines(rows, "size", size, units));
    draw("time-by-order", "Time by order of the field", order_axis, time, lines(rows, "order", order, units));
    draw("time-by-elements", "Time by number of elements", elements_axis, time, lines(rows, "elements", elements, units));
    draw("memory-by-size", "Memory by size of the picture", size_axis, memory, memory_lines(rows, "size", size));
    draw("memory-by-order", "Memory by order of the field", order_axis, memory, memory_lines(rows, "order", order));
    draw("memory-by-elements", "Memory by number of elements", elements_axis, log_memory,
         memory_lines(rows, "elements", elements));
}

} // namespace elvis
