#include "sample_files.hpp"
#include <apps/elvis/answers/sample_curve.hpp>

#include <core/base/output_file.hpp>
#include <core/bench/plot.hpp>

namespace elvis::commands {

void write_svg_plot(const SampleTable& table, const std::string& path) {
    Plot plot;
    plot.x.label = "arc length";
    for (SampledCurve& curve : curves_of(table)) {
        plot.series.push_back({std::move(curve.name), std::move(curve.points), true});
    }
    plot.y.label = plot.series.size() == 1 ? plot.series.front().name : "value";
    plot.title = plot.series.size() == 1 ? plot.series.front().name + " along a line" : "Along a line";
    write_text_file(path, to_svg(plot));
}

} // namespace elvis::commands
