// Where a pixel's ray meets a surface: reference coordinates in a local element.
struct core_hit_point {
    elvis_real x, y, z;
    uint element;
};
