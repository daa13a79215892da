#include "geometry_data.hpp"

namespace nektarpp {

std::uint32_t n_sides(Shape shape) { return static_cast<std::uint32_t>(elvis::native::n_faces(shape)); }

} // namespace nektarpp
