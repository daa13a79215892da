/**
 * @file warped_volume.hpp
 * A native volume whose geometry is displaced by a field of its own.
 */
#pragma once

#include <elvis/native/volume_source.hpp>

#include <cstddef>
#include <memory>
#include <optional>

namespace elvis::native {

/**
 * Each point x moves to x + factor * (cos(phase) u(x) - sin(phase) v(x)): v is the imaginary part of a field whose real part
 * is u, or absent. A field with as many components as the volume has dimensions is a displacement; in two dimensions three
 * components lead out of the plane, too, and one component is a height above it.
 */
struct Warp {
    std::size_t field = 0;
    std::optional<std::size_t> imaginary;
    std::size_t time_step = 0;
    double factor = 1;
    /** Radians. */
    double phase = 0;
};

/**
 * Exact: the mapping is in the smallest space that holds both the geometry and the displacement. The fields keep their values
 * in reference coordinates, so that each point takes its value along; derivatives are those in the displaced coordinates.
 */
class WarpedVolume : public VolumeSource {
public:
    /**
     * Throws std::invalid_argument for fields that are no displacement, and for volumes with fields that have a transform:
     * their values would change with the mapping.
     */
    WarpedVolume(std::shared_ptr<const VolumeSource> source, const Warp& warp);
    ~WarpedVolume() override;

    const Description& description() const override { return m_description; }
    void read_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                       std::span<double> coefficients) const override;
    void read_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                    std::uint64_t count, std::span<double> coefficients) const override;
    void read_numbers(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                      std::span<std::int64_t> numbers) const override;
    void read_faces(std::uint64_t first, std::uint64_t count, std::span<Face> faces) const override;
    std::vector<Extrema> read_extrema(std::size_t field, std::size_t time_step) const override;
    void read_parts(std::uint64_t first, std::span<std::uint32_t> parts) const override;

private:
    struct Changes;

    /** Adds `scale` times a field of the elements to their geometry. */
    void displace(std::size_t field, double scale, std::size_t element_class, std::uint64_t first, std::uint64_t count,
                  std::span<double> geometry) const;

    std::shared_ptr<const VolumeSource> m_source;
    Warp m_warp;
    Description m_description;
    std::unique_ptr<const Changes> m_changes;
};

} // namespace elvis::native
