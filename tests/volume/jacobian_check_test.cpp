// Signs of Jacobians as the core sees them: from the native plugin, and from samples where a plugin bounds nothing.
#include "../native_plugin/volume_fixture.hpp"

#include <core/plugin_host/plugin.hpp>
#include <core/volume/element/jacobian_check.hpp>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

using namespace elvis;
using test::ClassPlan;
using test::TestVolume;

namespace {

TestVolume bent_volume(double bend) {
    std::vector<ClassPlan> classes;
    for (const native::Space& space : test::spaces_of_order(2))
        classes.push_back({space, {}, 40});
    return {classes, {}, {0.0}, 0, bend};
}

double determinant_at(const RuntimeVolume& volume, std::uint64_t element, const std::array<double, 3>& xi) {
    std::array<double, 9> jacobian{};
    volume.evaluate_mapping(element, xi, {}, jacobian);
    return Eigen::Map<const Eigen::Matrix3d>(jacobian.data()).determinant();
}

} // namespace

TEST_CASE("certified signs come through the plugin, and witnesses are negative where the mapping is evaluated") {
    // Bent so much that both signs occur in every shape.
    const TestVolume file = bent_volume(0.5);
    const RuntimeVolume volume = file.open();
    REQUIRE(can_check_jacobians(volume));
    const JacobianReport report = check_jacobians(volume);
    CHECK(report.certainty == ELVIS_CERTIFIED);
    REQUIRE(report.signs.size() == volume.n_elements());
    CHECK(report.n_positive + report.n_negative + report.n_undecided == volume.n_elements());
    CHECK(report.findings.size() == report.n_negative + report.n_undecided);
    for (const ClassInfo& element_class : volume.classes()) {
        const auto first = report.signs.begin() + static_cast<std::ptrdiff_t>(element_class.first_element);
        const auto last = first + static_cast<std::ptrdiff_t>(element_class.n_elements);
        INFO("shape " << element_class.shape);
        CHECK(std::count(first, last, ELVIS_JACOBIAN_NEGATIVE) > 0);
    }
    CHECK(report.n_positive > 0);
    for (const auto& [element, check] : report.findings) {
        CHECK(report.signs[element] == check.sign);
        if (check.sign == ELVIS_JACOBIAN_NEGATIVE) {
            const double there = determinant_at(volume, element, check.xi);
            CHECK(there < 0);
            CHECK(there == Approx(check.determinant).epsilon(1e-9));
        }
    }
}

TEST_CASE("a part of the elements is told as the whole") {
    const TestVolume file = bent_volume(0.5);
    const RuntimeVolume volume = file.open();
    const JacobianReport report = check_jacobians(volume);
    // Across the end of a class.
    std::vector<JacobianCheck> checks(45);
    volume.check_jacobians(33, default_jacobian_tolerance, checks);
    for (std::size_t i = 0; i < checks.size(); ++i)
        CHECK(checks[i].sign == report.signs[33 + i]);
}

TEST_CASE("a mesh of bent elements that overlap nowhere is positive throughout") {
    const TestVolume file = bent_volume(0.02);
    const JacobianReport report = check_jacobians(file.open());
    CHECK(report.n_positive == report.signs.size());
    CHECK(report.findings.empty());
}

TEST_CASE("without the plugin's word, signs are sampled and called estimated") {
    const auto report_of = [](const std::string& options) {
        const RuntimeVolume volume(Plugin::load(ELVIS_FIXTURES "/sampled.so"), "a.cube", options);
        REQUIRE_FALSE(volume.has_jacobian_checks());
        REQUIRE(can_check_jacobians(volume));
        return check_jacobians(volume);
    };
    const JacobianReport straight = report_of("");
    CHECK(straight.certainty == ELVIS_ESTIMATED);
    CHECK(straight.signs == std::vector<elvis_jacobian_sign>{ELVIS_JACOBIAN_POSITIVE});
    CHECK(straight.findings.empty());
    const JacobianReport bent = report_of("bent");
    CHECK(bent.certainty == ELVIS_ESTIMATED);
    CHECK(bent.signs == std::vector<elvis_jacobian_sign>{ELVIS_JACOBIAN_NEGATIVE});
    REQUIRE(bent.findings.size() == 1);
    CHECK(bent.findings[0].second.xi[2] == 1);
    CHECK(bent.findings[0].second.determinant == Approx(-0.2));
    CHECK(report_of("nan").signs == std::vector<elvis_jacobian_sign>{ELVIS_JACOBIAN_UNDECIDED});
}

TEST_CASE("a plugin that neither bounds nor evaluates is not asked") {
    const RuntimeVolume volume(Plugin::load(ELVIS_FIXTURES "/good.so"), "a.cube");
    CHECK_FALSE(can_check_jacobians(volume));
}

TEST_CASE("a check of Jacobians stops when asked to") {
    const TestVolume file = bent_volume(0.02);
    const RuntimeVolume volume = file.open();
    TaskControl control;
    control.cancelled = true;
    CHECK_THROWS(check_jacobians(volume, default_jacobian_tolerance, &control));
}
