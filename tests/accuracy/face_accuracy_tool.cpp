// elvis_face_accuracy: boundaries of generated meshes against the isoparametric surfaces that they are, printed. See --help.
#include <core/accuracy/face_accuracy.hpp>
#include <tests/support/test_volumes.hpp>

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>

namespace elvis::oracle {
namespace {

int run(const std::vector<std::string>& meshes, const std::vector<std::string>& shapes, std::uint32_t size,
        std::size_t n_pixels, std::size_t n_edge_rays, int order) {
    const Device device;
    bool is_good = true;
    for (const std::string& mesh : meshes)
        for (const std::string& shape : shapes) {
            const TemporaryFile file(mesh + "-" + shape + ".h5");
            generate(R"({"generator": 1, "mesh": ")" + mesh + R"(", "shape": ")" + shape +
                         R"(", "elements": [4, 4, 12], "geometry_order": )" + std::to_string(order) +
                         R"(, "order": 1, "field": "waves"})",
                     file.path());
            const RuntimeVolume volume = open_volume(file.path());
            const Volume model(read_volume(file.path()));
            const Boundary boundary(model, faces_of(volume));
            for (const Precision precision : {Precision::float32, Precision::float64}) {
                const FaceAccuracy r = measure_faces(device, volume, boundary, precision, size, n_pixels, n_edge_rays);
                const bool is_single = precision == Precision::float32;
                std::printf(
                    "%-5s %-11s %s %zu of %u^2 pixels, %zu hits: depth %.2g of the box, grazing %.2g of the eye's distance; "
                    "missed %zu, invented %zu, touching %zu; %zu edge rays: %zu leaks, at most %.2g behind; careful %llu, "
                    "flagged %zu\n",
                    mesh.c_str(), shape.c_str(), is_single ? "float32" : "float64", r.n_pixels, size, r.n_hits, r.depth_error,
                    r.grazing_error, r.n_missed, r.n_invented, r.n_touching, r.n_edge_rays, r.n_leaks, r.leak_depth_error,
                    static_cast<unsigned long long>(r.n_careful), r.n_flagged);
                std::fflush(stdout);
                is_good = is_good && r.depth_error <= (is_single ? 1e-5 : 1e-11) &&
                          r.grazing_error <= (is_single ? 1e-6 : 1e-12) && r.n_missed == 0 && r.n_invented == 0 &&
                          r.n_leaks == 0;
            }
        }
    return is_good ? 0 : 1;
}

} // namespace
} // namespace elvis::oracle

int main(int argc, char** argv) {
    CLI::App app(
        "Boundaries of generated meshes against the isoparametric surfaces that they are; fails if a promise does not hold");
    std::vector<std::string> meshes{"ball", "torus"}, shapes{"hexahedron", "prism", "tetrahedron", "pyramid"};
    std::uint32_t size = 2000;
    std::size_t n_pixels = 100000, n_edge_rays = 10000;
    int order = 2;
    app.add_option("--meshes", meshes, "Meshes of the generator")->delimiter(',');
    app.add_option("--shapes", shapes, "Shapes of their elements")->delimiter(',');
    app.add_option("--size", size, "Side of the picture in pixels");
    app.add_option("--pixels", n_pixels, "Pixels that are compared, chosen by chance");
    app.add_option("--edge-rays", n_edge_rays, "Rays through points of edges");
    app.add_option("--geometry-order", order, "Order of the elements' mapping");
    CLI11_PARSE(app, argc, argv);
    try {
        return elvis::oracle::run(meshes, shapes, size, n_pixels, n_edge_rays, order);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "elvis_face_accuracy: %s\n", error.what());
        return 1;
    }
}
