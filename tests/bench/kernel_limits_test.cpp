/*
 * What the compiler of a GPU (navi21) makes of the kernels of four pictures gets no worse than kernel_limits.csv allows. No GPU
 * is needed: Mesa's RADV compiles for hardware that is not there. Hexahedra alone are tested, and double precision, which takes
 * minutes, only where all is; the file has all shapes.
 */
#include <core/base/error.hpp>
#include <core/bench/kernel_limits.hpp>
#include <tests/support/error_of.hpp>
#include <tests/support/files.hpp>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <fstream>
#include <sstream>

using namespace elvis;
using Catch::Contains;

namespace {

/** RADV shows a device without hardware while this lives. */
class NullHardware {
public:
    NullHardware() { ::setenv("RADV_FORCE_FAMILY", "navi21", 1); }
    ~NullHardware() { ::unsetenv("RADV_FORCE_FAMILY"); }
    NullHardware(const NullHardware&) = delete;
    NullHardware& operator=(const NullHardware&) = delete;

    static bool is_there() {
        for (const DeviceSummary& device : list_devices()) {
            if (device.only_compiles) {
                return true;
            }
        }
        WARN("skipped: Mesa's RADV with its null device is not installed (Debian package mesa-vulkan-drivers)");
        return false;
    }
};

void check_limits(Precision precision) {
    const NullHardware hardware;
    if (!NullHardware::is_there()) {
        return;
    }
    ::setenv("ELVIS_PLUGIN_PATH", ELVIS_TEST_PLUGINS, 1);
    const KernelLimits allowed = read_limits(ELVIS_KERNEL_LIMITS);
    const KernelInspector inspector("navi21");
    if (inspector.summary().driver != allowed.driver) {
        WARN("skipped: the limits are those of " << allowed.driver << ", this is " << inspector.summary().driver);
        return;
    }
    const PluginRegistry registry;
    const BenchFolder folder("");
    KernelsOptions options;
    options.shapes = {"hexahedron"};
    options.precisions = {precision};
    options.size = 64;
    std::vector<KernelRow> rows;
    bench_kernels(inspector, registry, folder, options, [&](const KernelRow& row) { rows.push_back(row); });
    CHECK(rows.size() > 20);
    const KernelLimits found = limits_of(rows, inspector.summary().driver);
    for (const std::string& line : worse_kernels(found, allowed)) {
        FAIL_CHECK(line);
    }
}

KernelRow row_of(std::uint64_t spills, std::uint64_t scratch_bytes, std::uint64_t waves) {
    KernelRow row;
    row.kernel = "room/kernel";
    row.shape = "prism";
    row.statistics.spills = spills;
    row.statistics.scratch_bytes = scratch_bytes;
    row.statistics.waves = waves;
    return row;
}

KernelLimits limits(std::uint64_t spills, std::uint64_t scratch_bytes, std::uint64_t waves) {
    return limits_of(std::vector{row_of(spills, scratch_bytes, waves)}, "driver 1.2");
}

} // namespace

TEST_CASE("No kernel of hexahedra needs more of a GPU than its limit, in single precision") {
    check_limits(Precision::float32);
}

TEST_CASE("No kernel of hexahedra needs more of a GPU than its limit, in double precision", "[.long]") {
    check_limits(Precision::float64);
}

TEST_CASE("A kernel is worse that spills more, takes more scratch memory or leaves fewer waves") {
    const KernelLimits allowed = limits(3, 1024, 8);
    CHECK(worse_kernels(limits(3, 1024, 8), allowed).empty());
    CHECK(worse_kernels(limits(0, 0, 16), allowed).empty());
    CHECK(worse_kernels(limits(4, 1024, 8), allowed).size() == 1);
    CHECK(worse_kernels(limits(3, 1025, 8), allowed).size() == 1);
    CHECK(worse_kernels(limits(3, 1024, 7), allowed).size() == 1);
    CHECK_THAT(worse_kernels(limits(0, 0, 16), KernelLimits{}).at(0), Contains("no limit is known"));
}

TEST_CASE("Of several variants of a kernel, the worst counts") {
    const KernelLimits of_two = limits_of(std::vector{row_of(0, 1024, 4), row_of(3, 0, 8)}, "");
    REQUIRE(of_two.of.size() == 1);
    const KernelLimit& worst = of_two.of.begin()->second;
    CHECK(worst.spills == 3);
    CHECK(worst.scratch_bytes == 1024);
    CHECK(worst.waves == 4);
}

TEST_CASE("Limits are read as they were written, and a file that is none is refused") {
    const test::TemporaryFolder folder;
    const std::string path = (folder.path() / "limits.csv").string();
    std::ofstream(path) << [] {
        std::ostringstream text;
        write_limits(text, limits(3, 1024, 8));
        return text.str();
    }();
    const KernelLimits read = read_limits(path);
    CHECK(read.driver == "driver 1.2");
    CHECK(worse_kernels(read, limits(3, 1024, 8)).empty());
    CHECK(worse_kernels(limits(3, 1024, 8), read).empty());
    std::ofstream(path, std::ios::app) << "room/kernel,prism,float16,1,2,3\n";
    CHECK_THAT(test::error_of([&] { read_limits(path); }), Contains("line 4"));
    CHECK_THAT(test::error_of([&] { read_limits(path + ".none"); }), Contains("first line"));
}

TEST_CASE("A device that only compiles is marked, compiled for, and refused to draw on") {
    const NullHardware hardware;
    if (!NullHardware::is_there()) {
        return;
    }
    CHECK_THAT(test::error_of([] { Device device("navi21"); }), Contains("it only compiles") && Contains("no memory"));
    // Its type says that it is a better one, but it is not what draws by default.
    CHECK_FALSE(choose_device("").only_compiles);
    CHECK(KernelInspector("navi21").summary().only_compiles);
    CHECK_FALSE(KernelInspector("").summary().only_compiles);
}
