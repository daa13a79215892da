#include "fixture.hpp"
#include <catch2/catch.hpp>
#include <elvis/native/space.hpp>
using namespace elvis;
TEST_CASE("tmp") {
    for (std::string name : {"poisson-fichera-mixed-p2-p3","poisson-inline-tet-p6", "poisson-fichera-q3-p5"}) {
    const auto source = open_mfem({mfem_data(name + "/mesh.mesh"), mfem_data(name + "/sol.gf")});
    double worst = 0, most = 0; std::size_t n=0;
    for (std::uint64_t e = 0; e < source.info().n_elements; ++e) {
        elvis_source_element el{}; el.struct_size = sizeof el;
        source.elements(e, 1, std::span(&el, 1));
        auto shape = static_cast<native::Shape>(el.shape);
        for (int f = 0; f < native::n_faces(shape); ++f) {
            std::array<double,3> xi{0,0,0}; auto c = native::face_corners(shape, f);
            double w[4] = {.3,.25,.35,.1}; if (c.size()==3) w[2]=.45;
            for (std::size_t k = 0; k < c.size(); ++k) for (int d = 0; d < 3; ++d) xi[d] += w[k]*native::corner(shape, c[k])[d];
            std::array<double,1> v; source.sample(0, e, xi, v);
            most = std::max(most, std::abs(v[0]));
            if (el.face_groups[f] >= 0) { ++n; worst = std::max(worst, std::abs(v[0])); }
        }
    }
    printf("%s: %zu boundary faces, max on boundary %g, max %g\n", name.c_str(), n, worst, most);
    }
}
