// Faces seen nearly along a tangent.
#include <tests/support/files.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

namespace elvis::oracle {

TEST_CASE("a face whose tangent runs along the ray is not lost in single precision") {
    // Curved prisms; of the parametric directions of one face, one is nearly that of the ray through column 67 of row 100.
    const TemporaryFile file("toroid.h5");
    const std::string folder = test::data_file("mfem/poisson-toroid-wedge-p4");
    const SourceVolume source(plugins().converter_for(folder + "/mesh.mesh"), {folder + "/mesh.mesh", folder + "/sol.gf"});
    convert(source, file.path(), {}, {});
    const RuntimeVolume volume = open_volume(file.path());
    FrameRequest request;
    request.width = 200;
    request.height = 150;
    request.camera.eye = {2.437764055259642, -2.8953653997686137, -1.9868098708314066};
    request.camera.look_at = {-0.03043261893556424, 0.18040864618964997, 0.2759554610969789};
    request.camera.up = {-1.6695323878757418, -0.5921506766216257, -1.2965076198621228};
    request.camera.field_of_view = 50.061555863240244;
    request.surfaces = {Surface{BoundaryFaces{}}};
    request.surfaces[0].colors.points = {{0, {0, 0, 0}}};
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        const Frame frame = Renderer(device(), volume, precision).render(request);
        CHECK(frame.depth[100 * 200 + 67] == Approx(3.7311325982).margin(1e-4));
    }
}

} // namespace elvis::oracle
