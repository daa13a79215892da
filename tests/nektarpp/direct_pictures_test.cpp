// The same picture from the files themselves and from the volume that they are converted to.
#include "direct_fixture.hpp"

#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

#include <cmath>

using namespace elvis;
using native::Basis;
using native::Shape;
using native::Space;

namespace {

FrameRequest request_for(bool is_boundary, bool is_flat) {
    FrameRequest request;
    request.width = 64;
    request.height = 48;
    request.camera.eye = {3, 2, 4};
    request.camera.look_at = {0.3, 0.3, 0.2};
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = 45;
    Surface surface;
    if (is_boundary) {
        surface.geometry = is_flat ? SurfaceGeometry(FlatElements{}) : SurfaceGeometry(BoundaryFaces{});
    } else {
        surface.geometry = CutPlane{{0.31, 0.27, 1, -0.35}};
    }
    surface.colors.points = {{-1, {0, 0, 1}}, {1, {1, 0, 0}}};
    request.surfaces = {surface};
    return request;
}

struct Difference {
    std::size_t n_hits = 0, n_elements = 0;
    double value = 0, depth = 0;
    /** Pixels whose value or depth differs by more than rounding. */
    std::size_t n_far = 0;
};

Difference difference(const Frame& a, const Frame& b, double value_rounding, double depth_rounding) {
    Difference found;
    REQUIRE(a.element.size() == b.element.size());
    for (std::size_t i = 0; i < a.element.size(); ++i) {
        found.n_hits += a.element[i] >= 0 ? 1 : 0;
        if (a.element[i] != b.element[i]) {
            ++found.n_elements;
        } else if (a.element[i] >= 0) {
            const double value = std::abs(static_cast<double>(a.value[i]) - static_cast<double>(b.value[i]));
            const double depth = std::abs(static_cast<double>(a.depth[i]) - static_cast<double>(b.depth[i]));
            found.value = std::max(found.value, value);
            found.depth = std::max(found.depth, depth);
            found.n_far += value > value_rounding || depth > depth_rounding ? 1 : 0;
        }
    }
    return found;
}

/** Draws both ways, in both precisions. `size` is that of the field; `rounding_64` of double precision, of coordinates of
 * size 1. */
void check_pictures(const std::string& mesh, const std::string& field, double size, bool has_cut = true,
                    double rounding_64 = 1e-12) {
    const TemporaryFolder folder;
    convert(open_nektar({mesh, field}), folder.path("converted.h5"), {}, {});
    const RuntimeVolume converted(Plugin::load(NATIVE_PLUGIN), folder.path("converted.h5"));
    const RuntimeVolume direct = open_direct(field);
    const Device device{};
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        // Some hundred terms are summed.
        const double rounding = precision == Precision::float32 ? 3e-6 : rounding_64;
        for (const bool is_boundary : {true, false}) {
            if (!is_boundary && !has_cut) {
                continue;
            }
            const Frame from_files =
                Renderer(device, direct, precision).render(request_for(is_boundary, direct.dimension() == 2));
            const Difference found = difference(
                from_files, Renderer(device, converted, precision).render(request_for(is_boundary, direct.dimension() == 2)),
                rounding * size, rounding * 4);
            INFO("value " << found.value << ", depth " << found.depth);
            CAPTURE(mesh, is_boundary, precision == Precision::float64, found.n_hits, found.n_elements);
            CHECK(found.n_hits > 60);
            // Of rays through an edge either may be hit.
            CHECK(found.n_elements <= (precision == Precision::float32 ? 2 : 0));
            // Where a ray grazes a curved face, rounding moves the point along it by far more.
            CHECK(found.n_far <= (is_boundary ? 1 : 0));
            CHECK(found.depth <= rounding * 4e3);
            CHECK(from_files.counts.newton_failures == 0);
        }
    }
}

} // namespace

TEST_CASE("pictures of curved elements of all shapes are those of the converted volume", "[nektarpp][direct][data]") {
    check_pictures(sample_file("cA.xml"), sample_file("cA.fld"), 2);
}

TEST_CASE("pictures of mixed orders are those of the converted volume", "[nektarpp][direct][data]") {
    check_pictures(sample_file("Helmholtz3D_Prism_VarP.xml"), sample_file("Helmholtz3D_Prism_VarP.fld"), 2);
}

TEST_CASE("pictures in other bases, and of surfaces, are those of the converted volume", "[nektarpp][direct]") {
    const auto space = GENERATE(values<Space>({
        {Shape::hexahedron, Basis::gll_lagrange, {4, 3, 5}},
        {Shape::tetrahedron, Basis::orthogonal, {3, 4, 4}},
        {Shape::pyramid, Basis::orthogonal, {4, 4, 4}},
        {Shape::quadrilateral, Basis::modified, {4, 3, 0}},
        {Shape::triangle, Basis::modified, {3, 4, 0}},
    }));
    CAPTURE(native::name(space.shape));
    const std::vector<double> coefficients = uniform_numbers(native::n_modes(space), 3);
    const TemporaryFolder folder;
    const std::string field = folder.write("one.fld", nektar_writer::field_file({block_of(space, coefficients)}));
    // The renderer's iteration on strongly bent faces ends with an error of up to some 1e-10 beside a pyramid's apex.
    const double rounding_64 = space.shape == Shape::pyramid ? 1e-9 : 1e-12;
    check_pictures(folder.write("one.xml", bent_element(space.shape)), field, 40, false, rounding_64);
}
