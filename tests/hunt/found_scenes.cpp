#include "found_scenes.hpp"
#include "volumes.hpp"

#include <core/oracle/samples/exact_volumes.hpp>

#include <iomanip>
#include <iostream>
#include <sstream>

namespace elvis::hunt {

Tally judge_picture(const std::string& path, const FrameRequest& request, Precision precision) {
    const RuntimeVolume volume = oracle::open_volume(path);
    std::vector<elvis_face> faces(volume.n_faces());
    volume.faces(0, faces.size(), faces);
    oracle::SceneVolume answers(path, faces);
    std::string reason;
    Judge judge(answers, request, reason);
    judge.draw();
    Renderer renderer(test::device(), volume, precision);
    const Judgement j = judge.judge(renderer.render(request), precision);
    if (!j.findings.empty())
        std::cout << j.findings[0].row << " " << j.findings[0].column << " wrong " << j.findings[0].wrong << "\n"
                  << j.findings[0].shown << "\n"
                  << j.findings[0].truth << "\n";
    return j.tally;
}

std::string text_of(double number) {
    std::ostringstream text;
    text << std::setprecision(17) << number;
    return text.str();
}

double field(const oracle::Vector& x) { return x.x() + x.y() * x.z(); }

void write_hexahedra(const std::string& path, const std::vector<oracle::Map>& maps, const std::vector<native::Face>& faces,
                     const oracle::Function& values) {
    const native::Space space = oracle::space_of(native::Shape::hexahedron, 2);
    oracle::VolumeData data;
    data.classes.push_back(oracle::make_class(space, space, maps, values));
    write_volume(path, data, faces);
}

std::vector<native::Face> faces_of_one() {
    std::vector<native::Face> faces;
    for (std::int32_t face = 0; face < 6; ++face)
        faces.push_back({0, -1, face, -1, -1});
    return faces;
}

FrameRequest request_from(const oracle::Vector& eye, const Vector3& look_at) {
    FrameRequest request;
    request.width = 80;
    request.height = 60;
    request.camera.eye = {eye.x(), eye.y(), eye.z()};
    request.camera.look_at = look_at;
    request.camera.up = {0, 1, 0};
    request.camera.field_of_view = 100;
    request.camera.near = 2e-4;
    return request;
}

FrameRequest rows_of_parallel_view(std::uint32_t first_row) {
    FrameRequest request;
    request.width = 800;
    request.height = part_rows;
    request.part = {first_row, 600};
    request.camera.orthographic = true;
    return request;
}

std::size_t pixel_in_rows(std::uint32_t first_row, std::size_t row, std::size_t column) {
    return (row - first_row) * 800 + column;
}

Surface colored_surface() {
    Surface surface;
    surface.colors.points = {{-3, {0, 0.1, 0.9}}, {3, {1, 0.8, 0.1}}};
    return surface;
}

} // namespace elvis::hunt
