// What rounding does to the points that pixels show.

// Where a ray meets a surface is known to a few roundings of its depth, and a pixel is at least 1e-4 of the depth wide: to 1/256 of a pixel
// in single precision, on surfaces of any inclination.
#define CORE_PLACE_ERROR (elvis_real(65536) * CORE_ROUNDOFF)
// Of the height of such a point above a plane, over its depth and its distance from the reference point.
#define CORE_HEIGHT_ERROR (elvis_real(64) * CORE_ROUNDOFF)
