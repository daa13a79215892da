#include <core/render/field/values_by_place.hpp>

#include <core/camera/camera_ray.hpp>
#include <core/render/field/chosen_values.hpp>
#include <core/vulkan/real_array.hpp>

#include <cmath>
#include <limits>

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
    for (std::size_t i = 0; i < pixels.size(); ++i) {
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
