#include "twins.hpp"

#include <core/oracle/samples/random.hpp>
#include <core/surface/shape_frame.hpp>

#include <elvis/native/volume_file.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <variant>
#include <vector>

namespace elvis::hunt {
namespace {

/** A larger space, and which of its modes are those of a smaller one. */
struct Raised {
    native::Space space;
    std::vector<std::size_t> modes;
};

/** Of one order more if all modes are found there, which those of Lagrange bases are not; else the space itself. */
Raised raise(const native::Space& space, bool is_wanted) {
    Raised same{space, std::vector<std::size_t>(native::n_modes(space))};
    std::iota(same.modes.begin(), same.modes.end(), std::size_t{0});
    native::Space higher = space;
    for (int d = 0; d < native::dimension(space.shape); ++d)
        ++higher.order[static_cast<std::size_t>(d)];
    if (!is_wanted || *std::ranges::max_element(higher.order) > native::max_order)
        return same;
    const std::size_t n = native::n_modes(space), n_higher = native::n_modes(higher);
    // Modes that agree at some points are the same.
    constexpr int n_points = 6;
    std::vector<double> low(n), high(n_higher);
    std::vector<bool> is_same(n * n_higher, true);
    oracle::Random random(1);
    for (int i = 0; i < n_points; ++i) {
        const oracle::Vector eta = random.in_cube();
        const native::Point xi = native::expand(space.shape, {eta.x(), eta.y(), eta.z()});
        native::evaluate_modes(space, xi, low);
        native::evaluate_modes(higher, xi, high);
        for (std::size_t a = 0; a < n; ++a)
            for (std::size_t b = 0; b < n_higher; ++b)
                if (!(std::abs(low[a] - high[b]) <= 1e-12 * (1 + std::abs(low[a]))))
                    is_same[a * n_higher + b] = false;
    }
    Raised raised{higher, {}};
    for (std::size_t a = 0; a < n; ++a) {
        const auto row = is_same.begin() + static_cast<std::ptrdiff_t>(a * n_higher);
        if (std::count(row, row + static_cast<std::ptrdiff_t>(n_higher), true) != 1)
            return same;
        raised.modes.push_back(
            static_cast<std::size_t>(std::find(row, row + static_cast<std::ptrdiff_t>(n_higher), true) - row));
    }
    return raised;
}

/** Every other record from `first` on, with the coefficients of each mode where the larger space has them. */
std::vector<double> records(const std::vector<double>& all, std::size_t n_components, std::size_t first, const Raised& raised) {
    const std::size_t n_modes = raised.modes.size(), size = n_components * n_modes, n_raised = native::n_modes(raised.space);
    std::vector<double> some;
    for (std::size_t element = first; element < all.size() / size; element += 2)
        for (std::size_t component = 0; component < n_components; ++component) {
            some.resize(some.size() + n_raised);
            for (std::size_t mode = 0; mode < n_modes; ++mode)
                some[some.size() - n_raised + raised.modes[mode]] = all[element * size + component * n_modes + mode];
        }
    return some;
}

/** A class of the new volume: elements first, first + 2, ... of one of the old. */
struct Half {
    std::size_t source = 0, first = 0;
    Raised geometry;
    std::vector<Raised> fields;
};

void write_half(const native::Reader& reader, native::Writer& writer, std::size_t target, const Half& half) {
    const native::Description& description = reader.description();
    const native::ElementClass& source = description.classes[half.source];
    const std::size_t n = source.n_elements, n_half = (n + 1 - half.first) / 2;
    std::vector<double> all(n * 3 * native::n_modes(source.geometry));
    reader.read_geometry(half.source, 0, n, all);
    writer.write_geometry(target, 0, n_half, records(all, 3, half.first, half.geometry));
    for (std::size_t field = 0; field < source.fields.size(); ++field)
        for (std::size_t step = 0; step < description.times.size(); ++step) {
            const std::size_t n_components = description.fields[field].n_components;
            all.resize(n * n_components * native::n_modes(source.fields[field]));
            reader.read_field(field, step, half.source, 0, n, all);
            writer.write_field(field, step, target, 0, n_half, records(all, n_components, half.first, half.fields[field]));
        }
    std::vector<std::int64_t> numbers(n), some;
    reader.read_numbers(half.source, 0, n, numbers);
    for (std::size_t element = half.first; element < n; element += 2)
        some.push_back(numbers[element]);
    writer.write_numbers(target, 0, n_half, some);
}

} // namespace

std::optional<FrameRequest> smaller_picture(const FrameRequest& request) {
    if (std::ranges::any_of(request.surfaces, [](const Surface& surface) { return surface.has_lines(); }))
        return {};
    const std::uint32_t common = std::gcd(request.width, request.height);
    for (std::uint32_t part = 3; part <= common; part += 2)
        if (common % part == 0) {
            FrameRequest smaller = request;
            smaller.width /= part;
            smaller.height /= part;
            for (double& shift : smaller.camera.image_shift)
                shift /= part;
            return smaller;
        }
    return {};
}

std::size_t pixel_with_same_ray(const FrameRequest& larger, const FrameRequest& smaller, std::size_t pixel) {
    const std::size_t part = larger.width / smaller.width, row = pixel / smaller.width, column = pixel % smaller.width;
    return (part * row + part / 2) * larger.width + part * column + part / 2;
}

void split_classes(const std::string& from, const std::string& to, bool raises_geometry) {
    const native::Reader reader(from);
    native::Description description = reader.description();
    std::vector<Half> halves;
    description.classes.clear();
    for (std::size_t c = 0; c < reader.description().classes.size(); ++c) {
        const native::ElementClass& source = reader.description().classes[c];
        for (std::size_t first = 0; first < std::min<std::uint64_t>(2, source.n_elements); ++first) {
            const bool is_second = first == 1;
            Half half{c, first, raise(source.geometry, is_second && raises_geometry), {}};
            native::ElementClass target{half.geometry.space, {}, (source.n_elements + 1 - first) / 2};
            for (const native::Space& field : source.fields) {
                half.fields.push_back(raise(field, is_second));
                target.fields.push_back(half.fields.back().space);
            }
            description.classes.push_back(target);
            halves.push_back(std::move(half));
        }
    }
    native::Writer writer(to, description);
    for (std::size_t target = 0; target < halves.size(); ++target)
        write_half(reader, writer, target, halves[target]);
    std::vector<native::Face> faces(description.n_faces);
    reader.read_faces(0, faces.size(), faces);
    writer.write_faces(0, faces.size(), faces);
    writer.commit();
}

bool hangs_on_bounds(const FrameRequest& request) {
    return std::ranges::any_of(request.surfaces, [](const Surface& surface) {
        const auto* shape = std::get_if<CutShape>(&surface.geometry);
        const bool is_endless =
            std::holds_alternative<CutPlane>(surface.geometry) || (shape != nullptr && std::isinf(shape_bounds(*shape).back()));
        return surface.outside && is_endless;
    });
}

} // namespace elvis::hunt
