#include <core/render/frame.hpp>
#include <core/scene/output/pixel_flags.hpp>

namespace elvis {

namespace {

constexpr PixelFlag all_flags[] = {
    {pixel_flag::contour, "contour", "the pixel meets a contour"},
    {pixel_flag::contour_undecided, "contour_undecided", "it is open whether the pixel meets a contour"},
    {pixel_flag::mesh_line, "mesh_line", "the pixel meets a boundary of elements"},
    {pixel_flag::newton_failure, "newton_failure", "the mapping of an element could not be inverted there"},
    {pixel_flag::nan, "nan", "the field is not finite there"},
    {pixel_flag::isosurface, "isosurface", "what is seen is an isosurface"},
    {pixel_flag::isosurface_undecided, "isosurface_undecided",
     "it is open whether the ray meets an isosurface, or one before what is seen"},
    {pixel_flag::volume_tolerance, "volume_tolerance", "volume rendering did not reach its tolerance"},
    {pixel_flag::undecided, "undecided",
     "rounding decides whether the pixel is inside, which surface it shows, or from which side"},
    {pixel_flag::mesh_line_undecided, "mesh_line_undecided", "it is open whether the pixel meets a boundary of elements"},
    {pixel_flag::work_limit, "work_limit", "the work was cut short: the pixel may be wrong"},
    {pixel_flag::estimated, "estimated", "the pixel rests on sampled estimates, not on bounds"},
    {pixel_flag::range_too_fine, "range_too_fine", "the colour map's range is too narrow for single precision"},
    {pixel_flag::overlap, "overlap", "elements overlap here, and which of them is seen means nothing"},
};

} // namespace

std::span<const PixelFlag> pixel_flags() { return all_flags; }

} // namespace elvis
