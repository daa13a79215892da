/**
 * @file source_checks.cpp
 * Checks of conversion plugins: what a source says, where it is sampled, how exact its conversion is.
 */
#include <core/base/cancel.hpp>
#include <core/base/counted.hpp>
#include <core/base/error.hpp>
#include <core/base/temporary_folder.hpp>
#include <core/conformance/check.hpp>
#include <core/conformance/description.hpp>
#include <core/conformance/differences.hpp>
#include <core/conformance/pieces.hpp>
#include <core/conformance/random.hpp>
#include <core/conformance/reference_points.hpp>
#include <core/convert/convert.hpp>
#include <elvis/native/space.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

namespace elvis::conformance {

namespace {

SourceVolume open_source(Context& context, const TaskControl* control = nullptr) {
    context.need_source();
    context.progress("open");
    return SourceVolume(context.plugin(), context.subject().files, context.subject().options, control);
}

/** Elements to look at: all of small sources, else as the seed says. */
std::vector<std::uint64_t> chosen_elements(const SourceVolume& source, std::uint64_t seed) {
    const std::uint64_t n = source.info().n_elements;
    std::vector<std::uint64_t> elements;
    Random random(seed);
    for (std::uint64_t i = 0; i < std::min<std::uint64_t>(n, 64); ++i) {
        elements.push_back(n <= 64 ? i : random.below(n));
    }
    return elements;
}

elvis_source_element element_of(const SourceVolume& source, std::uint64_t element) {
    elvis_source_element described{};
    source.elements(element, 1, std::span(&described, 1));
    return described;
}

void check_description(Context& context) {
    const SourceVolume source = open_source(context);
    const std::uint64_t n = std::min<std::uint64_t>(source.info().n_elements, 1u << 18);
    std::vector<elvis_source_element> elements(n);
    source.elements(0, n, elements);
    for (std::uint32_t field = 0; field < source.fields().size(); ++field) {
        std::vector<elvis_source_space> spaces(n);
        source.spaces(field, 0, n, spaces);
    }
    if (source.fields().empty()) {
        context.fail("get_info counts no field; there is nothing to convert");
    }
    if (source.info().mantissa_bits < 4 || source.info().mantissa_bits > 53) {
        context.fail("get_info: mantissa_bits is " + std::to_string(source.info().mantissa_bits) +
                     "; doubles have 53, floats 24, six decimals about 20");
    }
    for (std::size_t step = 1; step < source.times().size(); ++step) {
        if (!(source.times()[step] >= source.times()[step - 1])) {
            context.fail("get_time: step " + std::to_string(step) + " is not later than the one before");
            break;
        }
    }
    context.note(counted(source.info().n_elements, "element") + ", " + counted(source.fields().size(), "field"));
}

void check_source_pieces(Context& context) {
    const SourceVolume source = open_source(context);
    check_pieces(context, queries(source, 512));
}

void check_source_threads(Context& context) {
    const SourceVolume source = open_source(context);
    check_threads(context, queries(source, 512));
}

void check_corners(Context& context) {
    const SourceVolume source = open_source(context);
    if (source.info().n_corner_ids == 0) {
        throw Skipped("corners have no ids");
    }
    std::map<std::int64_t, Point> positions;
    const std::uint64_t n = std::min<std::uint64_t>(source.info().n_elements, 20000);
    int n_complaints = 0;
    for (std::uint64_t element = 0; element < n && n_complaints < 5; ++element) {
        const elvis_source_element described = element_of(source, element);
        const native::Shape shape{described.shape};
        const auto n_corners = static_cast<std::size_t>(native::n_corners(shape));
        std::vector<double> xi;
        for (std::size_t corner = 0; corner < n_corners; ++corner) {
            const Point at = native::corner(shape, static_cast<int>(corner));
            xi.insert(xi.end(), at.begin(), at.end());
        }
        std::vector<double> x(xi.size());
        source.evaluate_mapping(element, xi, x);
        double size = 0;
        for (std::size_t i = 3; i < x.size(); ++i) {
            size = std::max(size, std::abs(x[i] - x[i % 3]));
        }
        for (std::size_t corner = 0; corner < n_corners; ++corner) {
            const Point here{x[3 * corner], x[3 * corner + 1], x[3 * corner + 2]};
            const auto [known, is_new] = positions.try_emplace(described.corners[corner], here);
            const Point& there = known->second;
            const double distance = length(minus(here, there));
            if (!is_new && !(distance <= 1e-4 * size)) {
                ++n_complaints;
                context.fail("get_elements: corner id " + std::to_string(described.corners[corner]) + " of element " +
                             std::to_string(element) + " lies at " + text_of(here) + ", in an earlier element at " +
                             text_of(there) + " (corners are in the order of element.h)");
            }
        }
    }
}

void check_sampling(Context& context) {
    const SourceVolume source = open_source(context);
    int n_complaints = 0;
    for (const std::uint64_t element : chosen_elements(source, context.subject().seed)) {
        const elvis_source_element described = element_of(source, element);
        // Corners, faces and interior: sources are sampled in the closed shape.
        const std::vector<Point> points = points_in(described.shape, 40, context.subject().seed + element);
        const std::vector<double> xi = flat(points);
        context.progress("sample of element " + std::to_string(element) + ", faces and corners included");
        std::vector<double> positions(xi.size());
        source.evaluate_mapping(element, xi, positions);
        std::vector<double> values(points.size() * source.n_values(), 0x1p900);
        source.sample(0, element, xi, values);
        double size = 0;
        for (const double value : values) {
            size = std::isfinite(value) ? std::max(size, std::abs(value)) : size;
        }
        for (std::size_t i = 0; i < points.size() && n_complaints < 5; ++i) {
            std::vector<double> alone(source.n_values(), 0x1p900);
            Point x{};
            source.evaluate_mapping(element, points[i], x);
            source.sample(0, element, points[i], alone);
            for (std::size_t n = 0; n < source.n_values(); ++n) {
                const double value = values[i * source.n_values() + n];
                const std::string which = "element " + std::to_string(element) + " at xi " + text_of(points[i]) + ", number " +
                                          std::to_string(n) + " of the point";
                if (value == 0x1p900) {
                    ++n_complaints;
                    context.fail("sample: " + which +
                                 " is not written; all components of all fields are wanted for every point");
                    break;
                }
                const bool is_same = value == alone[n] || (std::isnan(value) && std::isnan(alone[n])) ||
                                     std::abs(value - alone[n]) <= 1e-12 * size;
                if (!is_same) {
                    ++n_complaints;
                    context.fail("sample: " + which + " is " + text_of(value) + " among others and " + text_of(alone[n]) +
                                 " alone");
                    break;
                }
            }
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (std::abs(x[axis] - positions[3 * i + axis]) > 1e-12 * (1 + std::abs(x[axis])) && n_complaints++ < 5) {
                    context.fail("evaluate_mapping: element " + std::to_string(element) + " at xi " + text_of(points[i]) +
                                 " gives another position alone than among others");
                }
            }
        }
        if (n_complaints >= 5) {
            return;
        }
    }
}

void check_exactness(Context& context) {
    const SourceVolume source = open_source(context);
    const TemporaryFolder scratch;
    const TaskControl control;
    context.progress("conversion");
    const ConvertReport report = convert(source, scratch.path("converted.h5"), {}, control);
    const std::uint64_t n = std::min<std::uint64_t>(source.info().n_elements, 1u << 18);
    for (std::uint32_t field = 0; field < source.fields().size(); ++field) {
        std::vector<elvis_source_space> spaces(n);
        source.spaces(field, 0, n, spaces);
        const bool claims =
            std::all_of(spaces.begin(), spaces.end(), [](const auto& space) { return space.is_contained != 0; });
        const FieldReport& found = report.fields[field];
        context.note("field " + found.name + ": residual " + short_text(found.residual) + " of its range, " +
                     (found.exact ? "exact"
                      : claims    ? "said to be exact"
                                  : "not said to be exact"));
        // Rounding in the source, a few bits more in the projection; the report decides the same way.
        const double rounding = std::ldexp(1.0, -static_cast<int>(std::min(source.info().mantissa_bits, 53u)) + 12);
        if (claims && !found.exact && !(found.residual <= rounding)) {
            context.fail("get_spaces says that the native space contains field " + found.name +
                         ", but its conversion leaves a residual of " + short_text(found.residual) + " of the range");
        }
    }
    const std::uint32_t bits = std::min(source.info().mantissa_bits, 53u);
    if (!(report.geometry_residual <= std::max(1e-9, std::ldexp(1.0, 8 - static_cast<int>(bits))))) {
        context.fail("get_elements: the mapping is not in the space of geometry_order: residual " +
                     short_text(report.geometry_residual) + " of the volume's extent");
    }
}

void check_conversion_repeated(Context& context) {
    const TemporaryFolder scratch;
    const TaskControl control;
    std::vector<ConvertReport> reports;
    for (int run = 0; run < 2; ++run) {
        context.progress("conversion number " + std::to_string(run + 1));
        const SourceVolume source = open_source(context);
        reports.push_back(convert(source, scratch.path("run.h5"), {}, control));
    }
    for (std::size_t field = 0; field < reports[0].fields.size(); ++field) {
        const FieldReport& a = reports[0].fields[field];
        const FieldReport& b = reports[1].fields[field];
        if (a.residual != b.residual || a.lower != b.lower || a.upper != b.upper) {
            context.fail("converted twice, field " + a.name + " has another residual or range the second time");
        }
    }
    // Stopped when a part is done, at several places; then nothing may be left and the plugin must still be in order.
    const std::string output = scratch.path("cancelled.h5");
    for (const int stop_at : {0, 1, 3, 10}) {
        TaskControl stopping;
        int n_reports = 0;
        stopping.on_progress = [&](double, std::string_view) {
            if (++n_reports > stop_at) {
                stopping.cancelled = true;
            }
        };
        context.progress("conversion stopped at progress report " + std::to_string(stop_at));
        try {
            const SourceVolume source(context.plugin(), context.subject().files, context.subject().options, &stopping);
            convert(source, output, {}, stopping);
        } catch (const Cancelled&) {
            if (std::filesystem::exists(output)) {
                context.fail("a stopped conversion leaves its output behind");
            }
        }
        std::filesystem::remove(output);
    }
    context.progress("conversion after stopped ones");
    const SourceVolume source = open_source(context);
    const ConvertReport last = convert(source, scratch.path("last.h5"), {}, control);
    for (std::size_t field = 0; field < last.fields.size(); ++field) {
        if (last.fields[field].residual != reports[0].fields[field].residual) {
            context.fail("after stopped conversions, field " + last.fields[field].name + " has another residual");
        }
    }
}

} // namespace

std::vector<Check> source_checks() {
    return {
        {"source-description", "counts, elements and spaces of the source are sound", check_description},
        {"source-pieces", "any range of elements gives the same answers as the whole", check_source_pieces},
        {"source-threads", "elements, mapping and samples are the same when asked from several threads", check_source_threads},
        {"source-corners", "corners with the same id lie in the same place", check_corners},
        {"source-sampling", "samples inside and on the boundary are complete and the same alone and together", check_sampling},
        {"source-exactness", "conversion is exact where get_spaces says so, and geometry has the order it states",
         check_exactness},
        {"source-conversion", "repeated conversions agree, and stopped ones leave nothing behind", check_conversion_repeated},
    };
}

} // namespace elvis::conformance
