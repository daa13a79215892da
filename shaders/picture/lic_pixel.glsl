// What line integral convolution needs of a pixel (core/render/picture/lic_pass.hpp).

struct core_lic_pixel {
    // Where the vector at the pixel's point leads in the picture, in columns and rows, of length 1; zero where it leads nowhere.
    elvis_real across, down;
    // Bits of core_lic_bit.
    uint bits;
};

// Of the pixel that is so many columns and rows away, -1 to 1: the surface goes on to it, and there are vectors here and there.
// With (0, 0): there is a vector here.
uint core_lic_bit(ivec2 way) { return 1u << uint(3 * way.y + way.x + 4); }
