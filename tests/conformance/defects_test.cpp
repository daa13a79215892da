// `elvis check-plugin` finds every defect planted in a plugin, and nothing in the plugin without one.

#include <tests/support/program_folder.hpp>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <string>

using namespace elvis::test;

namespace {

struct Planted {
    const char* check;
    const char* defect;
    const char* outcome = "failed";
};

/** At least one for every check. */
constexpr Planted all_planted[] = {
    {"descriptor", "crash-on-load", "crashed"},
    {"descriptor", "fresh-descriptor"},
    {"descriptor", "every-interface"},
    {"descriptor", "nameless"},
    {"tables", "table-size"},
    {"probe-foreign", "probe-all"},
    {"probe-foreign", "probe-slow"},
    {"probe-foreign", "probe-crash", "crashed"},
    {"probe-own", "probe-none"},
    {"open-bad-files", "open-silent"},
    {"open-bad-files", "open-wrong-code"},
    {"open-bad-files", "open-anything"},
    {"open-damaged", "damage-crash", "crashed"},
    {"open-damaged", "damage-nonsense"},
    {"open-options", "options-crash", "crashed"},
    {"open-repeated", "leak"},
    {"open-repeated", "leak-file"},
    {"open-repeated", "changing"},
    {"open-parallel", "open-race"},
    {"open-cancel", "cancel-ignored"},
    {"open-cancel", "cancel-code"},
    {"open-cancel", "cancel-uncalled"},
    {"struct-sizes", "overwrite-size"},
    {"struct-sizes", "stride"},
    {"source-struct-sizes", "source-stride"},
    {"volume-description", "nonsense-count"},
    {"volume-description", "crash", "crashed"},
    {"volume-description", "hang", "timed-out"},
    {"volume-description", "twice-constant"},
    {"volume-description", "time-backwards"},
    {"volume-description", "same-number"},
    {"volume-buffers", "buffer-name"},
    {"volume-buffers", "buffer-overrun"},
    {"volume-buffers", "buffer-changes"},
    {"volume-buffers", "buffer-time"},
    {"volume-pieces", "piece-first"},
    {"volume-threads", "threads"},
    {"volume-faces", "face-twice"},
    {"volume-faces", "face-neighbour"},
    {"volume-faces", "face-missing"},
    {"bounds", "small-bounds"},
    {"field-ranges", "small-range"},
    {"derivative-bounds", "small-slope"},
    {"derivative-bounds", "small-bend"},
    {"jacobian-signs", "jacobian-negative"},
    {"jacobian-signs", "jacobian-lower"},
    {"cpu-derivatives", "cpu-jacobian"},
    {"cpu-derivatives", "cpu-gradient"},
    {"orders", "low-geometry-order"},
    {"orders", "low-field-order"},
    {"orders", "affine"},
    {"snippet-compiles", "glsl-syntax"},
    {"snippet-compiles", "glsl-name"},
    {"snippet-compiles", "glsl-float-only"},
    {"snippet-values", "glsl-single"},
    {"snippet-values", "glsl-shift"},
    {"snippet-values", "no-origin"},
    {"snippet-jacobian", "glsl-transposed"},
    {"snippet-jacobian", "glsl-pair"},
    {"snippet-gradient", "glsl-gradient"},
    {"snippet-hessians", "glsl-hessian"},
    {"snippet-hessians", "glsl-mapping-hessian"},
    {"snippet-inverse", "glsl-inverse"},
    {"snippet-inverse", "glsl-inverse-false"},
    {"snippet-inside", "glsl-newton"},
    {"snippet-own-shape", "glsl-own-gradient"},
    {"snippet-own-shape", "glsl-own-bound"},
    {"snippet-own-shape", "glsl-own-side"},
    {"snippet-own-shape", "glsl-own-nowhere"},
    {"snippet-precision", "glsl-cancellation"},
    {"snippet-outside", "glsl-nan-outside"},
    {"snippet-outside", "glsl-jump-outside"},
    {"snippet-hostile", "glsl-endless"},
    {"snippet-outputs", "glsl-unset"},
    {"snippet-indices", "glsl-index"},
    {"snippet-indices", "glsl-record"},
    {"snippet-outputs", "glsl-own-unset"},
    {"snippet-offset", "glsl-no-offset"},
    {"element-records", "glsl-counts"},
    {"source-description", "source-bits"},
    {"source-pieces", "source-piece"},
    {"source-threads", "source-threads"},
    {"source-corners", "source-corner"},
    {"source-sampling", "source-unwritten"},
    {"source-sampling", "source-batch"},
    {"source-exactness", "source-claims"},
    {"source-exactness", "source-geometry"},
    {"source-conversion", "source-changing"},
};

class Workplace : public ProgramFolder {
public:
    Workplace() { write("volume.defective", "defective 1\n0.75\n"); }

    /** What a run with a defect prints; exit status in `status`. */
    std::string print(const std::string& defect, const std::string& arguments, int& status) const {
        const Outcome checked =
            run("check-plugin '" DEFECTIVE_PLUGIN "' --volume volume.defective " + arguments, "ELVIS_DEFECT='" + defect + "'");
        status = checked.status;
        return checked.out;
    }

    nlohmann::json check(const std::string& defect, const std::string& arguments, int& status) const {
        return nlohmann::json::parse(print(defect, "--json " + arguments, status));
    }
};

} // namespace

TEST_CASE("A plugin without a defect passes every check") {
    const Workplace place;
    int status = -1;
    const auto answer = place.check("", "", status);
    INFO(answer.dump(2));
    CHECK(status == 0);
    CHECK(answer["failed"] == 0);
    CHECK(answer["skipped"] == 0); // It has everything optional, so that nothing is left out.
}

TEST_CASE("Every planted defect is caught by the check that is made for it") {
    const Workplace place;
    std::size_t n_caught = 0;
    for (const Planted& planted : all_planted) {
        int status = -1;
        const std::string timeout = std::string(planted.outcome) == "timed-out" ? " --timeout 3" : "";
        const auto answer = place.check(planted.defect, std::string("--check ") + planted.check + timeout, status);
        INFO(planted.check << " with defect " << planted.defect << ": " << answer.dump(2));
        const bool is_caught =
            status == 1 && answer["checks"][0]["outcome"] == planted.outcome && !answer["checks"][0]["findings"].empty();
        n_caught += is_caught ? 1 : 0;
        CHECK(is_caught);
    }
    std::printf("defects caught: %zu of %zu planted\n", n_caught, std::size(all_planted));
}

TEST_CASE("Faces in one place without neighbours are noted, and may be a crack") {
    const Workplace place;
    int status = -1;
    const auto answer = place.check("face-crack", "--check volume-faces", status);
    INFO(answer.dump(2));
    CHECK(status == 0);
    CHECK(answer["checks"][0]["notes"].dump().find("warning: 1 pair of faces") != std::string::npos);
    CHECK(place.check("", "--check volume-faces", status)["checks"][0]["notes"].dump().find("warning") == std::string::npos);
}

TEST_CASE("Checks that fail for one reason say it once") {
    const Workplace place;
    int status = -1;
    const std::string text = place.print("nonsense-count", "--check volume-description --check bounds --check orders", status);
    INFO(text);
    CHECK(status == 1);
    CHECK(text.find("for the same reason as volume-description") != std::string::npos);
    CHECK(text.find("2 further checks failed for the same reason") != std::string::npos);
}

TEST_CASE("A forgotten origin is told from a wrong mapping") {
    const Workplace place;
    int status = -1;
    const auto forgotten = place.check("no-origin", "--check snippet-values", status)["checks"][0]["findings"].dump();
    CHECK(forgotten.find("elvis_fill_request.origins") != std::string::npos);
    const auto wrong = place.check("glsl-shift", "--check snippet-values", status)["checks"][0]["findings"].dump();
    CHECK(wrong.find("elvis_fill_request.origins") == std::string::npos);
}

TEST_CASE("Every check has a planted defect") {
    const Outcome list = ProgramFolder().run("check-plugin --list --json");
    REQUIRE(list.status == 0);
    for (const auto& check : nlohmann::json::parse(list.out)) {
        const std::string name = check["name"];
        INFO(name);
        CHECK(std::any_of(std::begin(all_planted), std::end(all_planted),
                          [&](const Planted& planted) { return name == planted.check; }));
    }
}
