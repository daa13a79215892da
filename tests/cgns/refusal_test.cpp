// What is not read is refused with file, place and cause.
#include "fixture.hpp"

#include <catch2/catch.hpp>

using Catch::Contains;
using namespace elvis;

TEST_CASE("what cannot be read is refused with its place", "[cgns]") {
    const std::string container = GENERATE("hdf5", "adf");
    const TemporaryFolder folder;
    const auto failure_of = [&](const std::string& kind) { return failure(write_cgns(folder, kind, container)); };
    CHECK_THAT(failure_of("ngon"), Contains("ngon_") && Contains("/Base/Box/") && Contains("NFACE_n") && Contains("polyhedra"));
    CHECK_THAT(failure_of("vertex"), Contains("/Base/Box/Cells/ElementConnectivity") && Contains("vertex 9 in element 1"));
    CHECK_THAT(failure_of("cells"), Contains("/Base/Box says that it has 2 cells; its sections hold 1"));
    CHECK_THAT(failure_of("coordinates"), Contains("/Base/Box has no GridCoordinates"));
    CHECK_THAT(failure_of("solution"), Contains("NotThere") && Contains("time step 1"));
    CHECK_THAT(failure_of("moving"), Contains("GridCoordinates#1") && Contains("move"));
    CHECK_THAT(failure_of("face"), Contains("/Base/Box/ZoneBC/Wall/PointList") && Contains("element 1"));
    CHECK_THAT(failure_of("interpolation"), Contains("/Base/HighOrder/Hexahedra") && Contains("CPEX 0045"));
    CHECK_THAT(failure_of("lines"), Contains("/Base") && Contains("lines"));
}

TEST_CASE("values at faces are left out", "[cgns]") {
    const TemporaryFolder folder;
    const SourceVolume source = open_cgns({write_cgns(folder, "location", GENERATE("hdf5", "adf"))});
    CHECK(field_names(source) == std::vector<std::string>{"Pressure", "Velocity"});
}

TEST_CASE("other files are refused", "[cgns]") {
    const TemporaryFolder folder;
    CHECK_THAT(failure(folder.path("missing.cgns")), Contains("missing.cgns"));
    CHECK_THAT(failure(folder.write("text.cgns", "no such thing")), Contains("text.cgns") && Contains("no CGNS file"));
    CHECK_THAT(failure(folder.write("empty.cgns", "")), Contains("empty.cgns"));
    const std::string path = write_cgns(folder, "plane", "hdf5");
    CHECK_THROWS_WITH(open_cgns({path, path}), Contains("name one file only"));
}
