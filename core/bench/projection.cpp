#include <core/bench/projection.hpp>

#include <core/base/bounds.hpp>
#include <core/base/error.hpp>
#include <core/bench/plot.hpp>
#include <core/segment/tables.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

namespace elvis {

namespace {

/** Of the diagonal: depths farther apart belong to other sheets. */
constexpr double same_sheet = 1e-2;

FrameRequest request_of(const std::array<double, 6>& bounds, double diagonal, double isovalue, std::uint32_t size) {
    FrameRequest request;
    request.width = request.height = size;
    const Vector3 from_centre = {1.0, 0.7, 0.55};
    request.camera.look_at = middle_of(bounds);
    request.camera.eye = plus(request.camera.look_at, scaled(from_centre, diagonal));
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = 40;
    Surface surface;
    surface.geometry = Isosurfaces{{}, {isovalue}};
    surface.colors.points = {{isovalue, {1, 1, 1}}};
    request.surfaces = {surface};
    return request;
}

void compare(const Frame& frame, const Frame& exact, double diagonal, ProjectionRow& row) {
    std::uint64_t n_same = 0;
    for (std::size_t pixel = 0; pixel < frame.depth.size(); ++pixel) {
        const bool is_hit = frame.element[pixel] >= 0, is_meant = exact.element[pixel] >= 0;
        const double off = std::abs(frame.depth[pixel] - exact.depth[pixel]) / diagonal;
        row.n_missing += is_hit != is_meant ? 1 : 0;
        row.n_other += is_hit && is_meant && off > same_sheet ? 1 : 0;
        if (!is_hit || !is_meant || off > same_sheet) {
            continue;
        }
        double square = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            square += std::pow(frame.normal[3 * pixel + axis] - exact.normal[3 * pixel + axis], 2);
        }
        n_same += 1;
        row.mean_depth_error += off;
        row.largest_depth_error = std::max(row.largest_depth_error, off);
        row.mean_normal_error += std::sqrt(square);
        row.largest_normal_error = std::max(row.largest_normal_error, std::sqrt(square));
    }
    row.mean_depth_error /= static_cast<double>(std::max<std::uint64_t>(n_same, 1));
    row.mean_normal_error /= static_cast<double>(std::max<std::uint64_t>(n_same, 1));
}

double share(std::uint64_t number, std::uint64_t of) {
    return of == 0 ? 0 : static_cast<double>(number) / static_cast<double>(of);
}

} // namespace

const char* name_of(IsosurfaceMethod method) {
    return method == IsosurfaceMethod::interval    ? "interval"
           : method == IsosurfaceMethod::bernstein ? "bernstein"
                                                   : "companion";
}

std::vector<ProjectionRow> bench_projection(const Device& device, const PluginRegistry& registry, const BenchFolder& folder,
                                            const ProjectionOptions& options,
                                            const std::function<void(const ProjectionRow&)>& report) {
    const RuntimeVolume volume = options.volume.empty() ? waves_volume(registry, folder, options.elements_a_side, options.order)
                                                        : RuntimeVolume(registry.runtime_for(options.volume), options.volume);
    Renderer renderer(device, volume, Precision::float64);
    const std::array<double, 6> bounds = renderer.ranges().bounds();
    const double diagonal = diagonal_of(bounds);
    const FieldRange range = renderer.ranges().range({}, 0);
    FrameRequest request =
        request_of(bounds, diagonal, options.isovalue.value_or(0.5 * (range.lower + range.upper)), options.size);
    Isosurfaces& isosurfaces = std::get<Isosurfaces>(request.surfaces[0].geometry);

    std::vector<ProjectionRow> rows;
    Frame exact;
    const auto draw = [&](IsosurfaceMethod method, std::uint32_t degree) {
        isosurfaces.method = method;
        isosurfaces.degree = degree;
        // Once more, with everything compiled.
        renderer.render(request);
        const Frame frame = renderer.render(request);
        if (rows.empty()) {
            exact = frame;
        }
        const FrameCounts& counts = frame.counts;
        ProjectionRow row;
        row.method = method;
        row.degree = degree;
        row.mean_degree = share(counts.fit_degrees, counts.fits);
        row.evaluations_a_segment = share(counts.field_evaluations, counts.fits);
        row.n_segments = counts.fits;
        row.n_verified = counts.verified_fits;
        row.n_certified = counts.certified_segments;
        row.n_projected_pixels = counts.projected_pixels;
        row.n_hits = counts.isosurface_pixels;
        row.n_undecided = counts.undecided_isosurface_pixels;
        row.milliseconds = frame.device_milliseconds;
        compare(frame, exact, diagonal, row);
        rows.push_back(row);
        report(row);
    };
    draw(IsosurfaceMethod::bernstein, 0);
    draw(IsosurfaceMethod::companion, 0);
    draw(IsosurfaceMethod::interval, 0);
    for (std::uint32_t degree = 2; degree <= segment::max_degree; ++degree) {
        draw(IsosurfaceMethod::bernstein, degree);
    }
    return rows;
}

void write_projection(const std::filesystem::path& folder, const std::vector<ProjectionRow>& rows) {
    std::filesystem::create_directories(folder);
    const std::filesystem::path path = folder / "projection.csv";
    std::ofstream file(path);
    file << "method,degree,mean_degree,evaluations_a_segment,segments,verified,certified,projected_pixels,hits,missing,other,"
            "undecided,mean_depth_error,largest_depth_error,mean_normal_error,largest_normal_error,milliseconds\n";
    PlotSeries mean{"mean depth", {}}, largest{"largest depth", {}}, normal{"mean normal", {}}, wrong{"missing or other", {}};
    for (const ProjectionRow& row : rows) {
        file << name_of(row.method) << ',' << row.degree << ',' << row.mean_degree << ',' << row.evaluations_a_segment << ','
             << row.n_segments << ',' << row.n_verified << ',' << row.n_certified << ',' << row.n_projected_pixels << ','
             << row.n_hits << ',' << row.n_missing << ',' << row.n_other << ',' << row.n_undecided << ','
             << row.mean_depth_error << ',' << row.largest_depth_error << ',' << row.mean_normal_error << ','
             << row.largest_normal_error << ',' << row.milliseconds << '\n';
        if (row.degree != 0) {
            const double degree = row.degree;
            mean.points.push_back({degree, row.mean_depth_error});
            largest.points.push_back({degree, row.largest_depth_error});
            normal.points.push_back({degree, row.mean_normal_error});
            wrong.points.push_back({degree, static_cast<double>(row.n_missing + row.n_other)});
        }
    }
    file.close();
    if (!file) {
        throw Error(path.string(), "cannot be written");
    }
    write_svg(folder / "error-by-degree.svg",
              {"Error of projection", {"degree"}, {"of the diagonal, or of the unit normal", true}, {mean, largest, normal}});
    write_svg(folder / "pixels-by-degree.svg",
              {"Pixels that show another surface, or none", {"degree"}, {"pixels", true}, {wrong}});
}

} // namespace elvis
