// What line integral convolution needs of a pixel (core/render/picture/lic_pass.hpp).

struct core_lic_pixel {
    // Where the vector at the pixel's point leads in the picture, in columns and rows, of length 1; zero where it leads nowhere.
    elvis_real across, down;
    // CORE_LIC_...
    uint bits;
};

// The pixel shows a point at which there is a vector.
#define CORE_LIC_HAS_VECTOR 1u
// The surface goes on from here to the pixel on the right, and to the one below, and there are vectors on both sides.
#define CORE_LIC_GOES_ACROSS 2u
#define CORE_LIC_GOES_DOWN 4u
