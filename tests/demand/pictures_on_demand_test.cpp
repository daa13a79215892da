// Pictures of chosen elements against those of the whole volume: the same to the bit.

#include "demand_fixture.hpp"

#include <core/base/error.hpp>

#include <catch2/catch.hpp>

#include <cstdio>
#include <span>

using namespace elvis;
using namespace elvis::test;

namespace {

constexpr MemoryBudget unlimited{};

struct NamedKeys {
    const char* name;
    const char* keys;
};

/** A plane in faces, oblique ones, from near and far, with lines, several and such as are seen through. */
const NamedKeys plane_pictures[] = {
    {"plane in faces", R"("surfaces": [{"type": "plane", "plane": [0, 0, 1, 0]}], "mesh_lines": {})"},
    {"oblique plane", R"("surfaces": [{"type": "plane", "plane": [0.3, -0.5, 0.8, 0.05]}])"},
    {"oblique plane with lines",
     R"("surfaces": [{"type": "plane", "plane": [0.3, -0.5, 0.8, 0.05]}], "mesh_lines": {"width": 2}, "contours": {"count": 7})"},
    {"grazing plane from inside",
     R"("surfaces": [{"type": "plane", "plane": [0, 0.02, 1, -0.01]}], "mesh_lines": {}, "contours": {"count": 5},
        "camera": {"eye": [0.31, -0.63, 0.07], "look_at": [0.1, 0.4, 0], "up": [0, 0, 1], "field_of_view": 70})"},
    {"three planes, one of them transparent",
     R"("surfaces": [{"type": "plane", "plane": [1, 0, 0, 0.11]}, {"type": "plane", "plane": [0, 1, 0, -0.07], "opacity": 0.5},
                     {"type": "plane", "plane": [0.5, 0.5, 0.7, 0.2], "clip": [[1, 0, 0, 0]]}], "mesh_lines": {})"},
    {"close-up", R"("surfaces": [{"type": "plane", "plane": [0.1, 0.2, 1, 0.03]}], "mesh_lines": {}, "contours": {"count": 9},
        "camera": {"eye": [0.4, 0.3, 1], "look_at": [0.4, 0.35, 0], "up": [0, 1, 0], "type": "orthographic", "height": 0.2})"},
};

/** Of the field sinc. */
const NamedKeys isosurface_pictures[] = {
    {"another colour, a plane, a boundary",
     R"("surfaces": [{"type": "isosurface", "values": [0.2], "color_field": "2 * sinc + x", "color_map": {"range": [-1, 3]}},
                     {"type": "plane", "plane": [0.3, -0.5, 0.8, 0.3]}, {"type": "boundary", "groups": ["z-"]}])"},
    {"several, transparent", R"("surfaces": [{"type": "isosurface", "values": [-0.15, 0.2], "opacity": 0.5}])"},
    {"by projection", R"("surfaces": [{"type": "isosurface", "values": [-0.15, 0.2], "method": "bernstein"}])"},
};

void compare(const char* volume, DemandStage& stage, const NamedKeys& picture, const MemoryBudget& budget = unlimited) {
    const Scene scene = stage.scene(picture.keys);
    const Frame whole = stage.as_whole(scene);
    const Frame chosen = stage.within(budget, scene);
    const std::string different = differences(whole, chosen);
    std::printf("%-24s %-38s %5llu of %5llu elements, %u bands, hit %6llu, undecided %4llu: %s\n", volume, picture.name,
                static_cast<unsigned long long>(stage.work.n_on_device), static_cast<unsigned long long>(stage.work.n_elements),
                stage.work.n_bands, static_cast<unsigned long long>(whole.counts.hit_pixels),
                static_cast<unsigned long long>(whole.counts.undecided_pixels),
                different.empty() ? "the same bits" : different.c_str());
    INFO(volume << ", " << picture.name);
    CHECK(whole.counts.hit_pixels > 1000);
    CHECK(different.empty());
    CHECK(stage.work.n_on_device < stage.work.n_elements);
}

struct NamedVolume {
    const char* name;
    const char* description;
};

const NamedVolume all_volumes[] = {
    {"mixed, curved",
     R"({"generator":1,"mesh":"waves","shape":"mixed","elements":[6,6,6],"order":3,"geometry_order":2,"field":"sinc"})"},
    {"pyramids, jumps",
     R"({"generator":1,"mesh":"box","shape":"pyramid","box":[[-1,-1,-1],[1,1,1]],"elements":[5,5,5],"order":2,"geometry_order":1,"field":"jump"})"},
    {"ball",
     R"({"generator":1,"mesh":"ball","shape":"hexahedron","elements":[4,4,4],"order":3,"geometry_order":3,"field":"sphere"})"},
    {"hexahedra",
     R"({"generator":1,"mesh":"box","shape":"hexahedron","box":[[-1,-1,-1],[1,1,1]],"elements":[8,7,6],"order":3,"geometry_order":1,"field":"sinc"})"},
    {"prisms",
     R"({"generator":1,"mesh":"waves","shape":"prism","elements":[6,5,6],"order":2,"geometry_order":2,"field":"taylor-green"})"},
    {"tetrahedra",
     R"({"generator":1,"mesh":"waves","shape":"tetrahedron","elements":[5,5,5],"order":3,"geometry_order":3,"field":"sinc"})"},
};

} // namespace

TEST_CASE("Planes show the same bits whether all elements are there or those that they need") {
    const NamedVolume& mixed = all_volumes[0];
    DemandStage single(mixed.description);
    for (const NamedKeys& picture : plane_pictures) {
        compare(mixed.name, single, picture);
    }
    DemandStage in_double(all_volumes[1].description, Precision::float64);
    for (const NamedKeys& picture : std::span(plane_pictures).first(2)) {
        compare(all_volumes[1].name, in_double, picture);
    }
}

TEST_CASE("Planes through every shape show the same bits in both precisions", "[.long]") {
    for (const NamedVolume& volume : all_volumes) {
        for (const Precision precision : {Precision::float32, Precision::float64}) {
            DemandStage stage(volume.description, precision);
            for (const NamedKeys& picture : plane_pictures) {
                compare(volume.name, stage, picture);
            }
        }
    }
}

TEST_CASE("Several samples a pixel are the same bits whether all elements are there or those that they need") {
    DemandStage stage(all_volumes[3].description);
    compare(all_volumes[3].name, stage,
            {"three by three samples",
             R"("image": {"size": [80, 60], "samples": 3}, "mesh_lines": {},
                "surfaces": [{"type": "plane", "plane": [0.3, -0.5, 0.8, 0.05]}])"});
}

TEST_CASE("What needs all elements is drawn where they fit, and refused with figures where not") {
    DemandStage stage(all_volumes[1].description);
    const Scene scene = stage.scene(R"("surfaces": [{"type": "sphere", "center": [0, 0, 0], "radius": 0.6}])");
    const Frame whole = stage.as_whole(scene);
    stage.forget_whole();
    CHECK(differences(whole, stage.within({std::uint64_t{1} << 30, {}}, scene)).empty());
    CHECK(stage.work.n_on_device == stage.work.n_elements);
    const NamedKeys others[] = {
        {"a surface that is no plane, boundary or isosurface",
         R"("surfaces": [{"type": "sphere", "center": [0, 0, 0], "radius": 0.6}])"},
        {"an isosurface of an expression",
         R"("surfaces": [{"type": "isosurface", "values": [0.5], "field": "jump + x"}], "color_map": {"range": [-1, 1]})"},
        {"an isosurface with lines on it", R"("surfaces": [{"type": "isosurface", "values": [0.5]}], "mesh_lines": {})"},
        {"an isosurface for which no elements are skipped",
         R"("surfaces": [{"type": "isosurface", "values": [0.5], "range_skipping": false}])"},
    };
    for (const NamedKeys& other : others) {
        CHECK_THROWS_WITH(stage.within({std::uint64_t{1} << 20, {}}, stage.scene(other.keys)),
                          Catch::Contains(std::string(other.name) + " needs all") &&
                              Catch::Contains("and the budget is 1024 KiB"));
    }
}

namespace {

const NamedKeys boundary_pictures[] = {
    {"boundary", R"("surfaces": [{"type": "boundary"}], "mesh_lines": {}, "contours": {"count": 5})"},
    {"boundary and a plane behind it",
     R"("surfaces": [{"type": "boundary", "opacity": 0.5}, {"type": "plane", "plane": [0.2, 0.1, 1, 0.1]}])"},
    {"one group, by an expression",
     R"("surfaces": [{"type": "boundary", "groups": ["z+"]}, {"type": "plane", "plane": [0, 1, 0.1, 0]}], "field": "2 * sinc + x",
        "color_map": {"name": "viridis", "range": [-1, 3]})"},
};

} // namespace

TEST_CASE("Boundaries show the same bits whether all elements are there or those that they need") {
    DemandStage single(all_volumes[0].description);
    for (const NamedKeys& picture : boundary_pictures) {
        compare(all_volumes[0].name, single, picture);
    }
    DemandStage in_double(all_volumes[0].description, Precision::float64);
    compare(all_volumes[0].name, in_double, boundary_pictures[0]);
}

TEST_CASE("All boundaries show the same bits in double precision", "[.long]") {
    DemandStage stage(all_volumes[0].description, Precision::float64);
    for (const NamedKeys& picture : boundary_pictures) {
        compare(all_volumes[0].name, stage, picture);
    }
}

TEST_CASE("Isosurfaces show the same bits whether all elements are there or those that may hold an isovalue") {
    DemandStage tetrahedra(all_volumes[5].description);
    compare(all_volumes[5].name, tetrahedra, isosurface_pictures[0]);
    DemandStage hexahedra(all_volumes[3].description, Precision::float64);
    compare(all_volumes[3].name, hexahedra, isosurface_pictures[1]);
    // In faces, in which rounding alone tells in which of two elements an isovalue is taken.
    DemandStage in_faces(
        R"({"generator":1,"mesh":"box","shape":"hexahedron","box":[[-1,-1,-1],[1,1,1]],"elements":[8,8,8],"order":2,"geometry_order":1,"field":"polynomial","coefficients":[[1,0,0,0.3],[2,0,0,0.1]]})");
    compare("hexahedra", in_faces, {"in faces", R"("surfaces": [{"type": "isosurface", "values": [0]}])"});
}

TEST_CASE("Isosurfaces in every shape show the same bits in both precisions", "[.long]") {
    for (const std::size_t of_sinc : {0u, 3u, 5u}) {
        const NamedVolume& volume = all_volumes[of_sinc];
        for (const Precision precision : {Precision::float32, Precision::float64}) {
            DemandStage stage(volume.description, precision);
            for (const NamedKeys& picture : isosurface_pictures) {
                compare(volume.name, stage, picture);
            }
        }
    }
    DemandStage vectors(all_volumes[4].description);
    compare(all_volumes[4].name, vectors,
            {"length of a vector", R"("surfaces": [{"type": "isosurface", "values": [0.6], "field": "velocity"}])"});
}

TEST_CASE("Planes that do not fit a budget are drawn in bands, to the same bits") {
    // Of straight tetrahedra nothing is kept but their records.
    const char* const straight =
        R"({"generator":1,"mesh":"box","shape":"tetrahedron","elements":[20,20,20],"order":2,"geometry_order":1,"field":"sinc"})";
    DemandStage stage(straight);
    const NamedKeys& picture = plane_pictures[1];
    const Scene scene = stage.scene(picture.keys);
    const Frame whole = stage.as_whole(scene);
    stage.forget_whole();
    CHECK(differences(whole, stage.within(unlimited, scene)).empty());
    const std::uint64_t taken = stage.work.device_bytes;
    std::uint32_t n_bands = 1;
    for (std::uint64_t budget = 2 * taken; budget > 0; budget = budget / 8 * 7) {
        try {
            const Frame chosen = stage.within({budget, {}}, scene);
            std::printf("%llu of %llu bytes on the device, budget %llu: %u bands\n",
                        static_cast<unsigned long long>(stage.work.device_bytes), static_cast<unsigned long long>(taken),
                        static_cast<unsigned long long>(budget), stage.work.n_bands);
            CHECK(differences(whole, chosen).empty());
            CHECK(stage.work.device_bytes <= budget);
            n_bands = std::max(n_bands, stage.work.n_bands);
        } catch (const Error& too_large) {
            std::printf("budget %llu: %s\n", static_cast<unsigned long long>(budget), too_large.what());
            CHECK(n_bands > 2);
            CHECK(std::string(too_large.what()).find("the cut plane (surface 0) needs") != std::string::npos);
            return;
        }
    }
}
