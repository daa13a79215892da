#include <core/render/field/values_by_place.hpp>

#include <core/base/in_parts.hpp>
#include <core/camera/camera_ray.hpp>
#include <core/expression/expression.hpp>
#include <core/render/field/chosen_values.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>
#include <type_traits>

namespace elvis {

namespace {

/** One core_place as the device writes it (shaders/element/place.glsl). */
template <class Real> struct Place {
    Real x, y, z;
    std::uint32_t element;
    std::uint32_t class_and_face;
};

/** Bits of Place::class_and_face: of the face, and what is known of the pixel. */
constexpr std::uint32_t face_bits = 4, known_bits = (1u << 31) | (1u << 30);

template <class Real> ReferencePoint point_of(const Place<Real>& place, const RuntimeVolume& volume) {
    const std::uint32_t element_class = (place.class_and_face & ~known_bits) >> face_bits;
    return {volume.classes()[element_class].first_element + place.element, {place.x, place.y, place.z}};
}

/** Of positions, in reference coordinates of the other volume's elements, and of values, relative to them. */
template <class Real>
constexpr ValuesByPlace::Rounding rounding_of =
    std::is_same_v<Real, float> ? ValuesByPlace::Rounding{1e-6, 2e-5} : ValuesByPlace::Rounding{1e-10, 1e-11};
constexpr std::uint64_t points_a_thread = 1024;

/** Where the ray of a pixel meets a plane. */
class PlanePoints {
public:
    PlanePoints(const CutPlane& plane, const FrameRequest& request) : m_plane(plane), m_request(request) {}

    Vector3 at(std::uint32_t column, std::uint32_t row) const {
        const auto [first_row, of_height] = m_request.place();
        const Ray ray = ray_through(m_request.camera, {static_cast<double>(m_request.width), static_cast<double>(of_height)},
                                    {column + 0.5, first_row + row + 0.5});
        const auto& [a, b, c, d] = m_plane.plane;
        const Vector3 normal{a, b, c};
        return ray.at(-(dot(normal, ray.origin) + d) / dot(normal, ray.direction));
    }

private:
    const CutPlane& m_plane;
    const FrameRequest& m_request;
};

} // namespace

ValuesByPlace::ValuesByPlace(const Device& device, const RuntimeVolume& volume)
    : m_device(device), m_volume(volume), m_finder(volume), m_evaluator(volume),
      m_background(std::max(1u, std::thread::hardware_concurrency())) {}

std::optional<ReferencePoint> ValuesByPlace::place_in(std::uint32_t number, const Vector3& position) const {
    std::optional<ReferencePoint> found;
    for (const ReferencePoint& holder : m_finder.holders(m_volume, position)) {
        std::int64_t known_as = 0;
        m_volume.element_numbers(holder.element, 1, std::span(&known_as, 1));
        if (!found || static_cast<std::uint32_t>(known_as) == number) {
            found = holder;
        }
    }
    return found;
}

void ValuesByPlace::mark_jumps(const FieldChoice& field, std::uint32_t time_step, const Rounding& rounding,
                               std::span<const ReferencePoint> points, std::span<std::uint8_t> jumps) {
    const std::vector<std::uint32_t> fields = field.expression ? field.expression->fields() : std::vector{field.field};
    in_parts(
        m_background, points.size(), points_a_thread,
        [&](std::uint64_t first, std::uint64_t count) {
            for (std::uint64_t i = first; i < first + count; ++i) {
                jumps[i] = std::ranges::any_of(fields, [&](std::uint32_t index) {
                    return m_volume.fields()[index].is_by_place &&
                           m_volume.jump_by_place(index, time_step, points[i].element, points[i].xi, rounding.reach) >
                               rounding.value;
                });
            }
        },
        [this] { m_device.check_task(); });
}

template <class Real>
void ValuesByPlace::draw(const Surface& surface, const FrameRequest& request, Real offset, const LayerTarget& target) {
    const std::size_t n_pixels = target.layer.n_pixels();
    auto samples = target.layer.samples.read_items<Sample<Real>>(n_pixels);
    auto marks = target.layer.marks.read_items<Mark>(n_pixels);
    const CutPlane* const plane = traits_of(surface.geometry).plane;
    const auto places = plane == nullptr ? target.places->read_items<Place<Real>>(n_pixels) : std::vector<Place<Real>>{};
    std::vector<std::size_t> pixels;
    std::vector<ReferencePoint> points;
    for (std::size_t pixel = 0; pixel < n_pixels; ++pixel) {
        const std::uint32_t number = samples[pixel].number;
        if (marks[pixel].surface() == 0 || number == no_number) {
            continue;
        }
        const std::optional<ReferencePoint> point =
            plane == nullptr ? point_of(places[pixel], m_volume)
                             : place_in(number, PlanePoints(*plane, request)
                                                    .at(static_cast<std::uint32_t>(pixel % target.layer.width),
                                                        static_cast<std::uint32_t>(pixel / target.layer.width)));
        samples[pixel].value = std::numeric_limits<Real>::quiet_NaN();
        marks[pixel].flags |= point ? 0 : pixel_flag::undecided;
        if (point) {
            pixels.push_back(pixel);
            points.push_back(*point);
        }
    }
    m_device.check_task();
    const std::vector<double> values = chosen_values(m_evaluator, *surface.by_place, request.time_step, points);
    std::vector<std::uint8_t> jumps(points.size());
    mark_jumps(*surface.by_place, request.time_step, rounding_of<Real>, points, jumps);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        marks[pixels[i]].flags |= jumps[i] != 0 ? pixel_flag::undecided : 0;
        samples[pixels[i]].value = static_cast<Real>(values[i] - static_cast<double>(offset));
        marks[pixels[i]].flags |= std::isfinite(values[i]) ? 0 : pixel_flag::nan;
    }
    target.layer.samples.write_items(std::span<const Sample<Real>>(samples));
    target.layer.marks.write_items(std::span<const Mark>(marks));
}

void ValuesByPlace::draw(const Surface& surface, const FrameRequest& request, double offset, Precision precision,
                         const LayerTarget& target) {
    with_real(precision, [&](auto real) { draw(surface, request, static_cast<decltype(real)>(offset), target); });
}

} // namespace elvis
