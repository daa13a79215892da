#include <core/bench/plot.hpp>

#include <core/base/error.hpp>
#include <core/base/plot_ticks.hpp>
#include <core/base/xml_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <fstream>
#include <limits>

namespace elvis {

namespace {

constexpr double width = 720, height = 440;
constexpr double left = 98, right = 190, top = 44, bottom = 60;

/** M. Okabe, K. Ito, "Color Universal Design": told apart by colour-blind people. */
constexpr const char* colors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#8a7000"};

std::string format(const char* text, ...) __attribute__((format(printf, 1, 2)));
std::string format(const char* text, ...) {
    std::va_list arguments;
    va_start(arguments, text);
    char buffer[512];
    std::vsnprintf(buffer, sizeof buffer, text, arguments);
    va_end(arguments);
    return buffer;
}

/** Text in the file's coordinates. */
std::string label(double x, double y, const char* anchor, const std::string& text, const char* more = "") {
    return format("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" %s>", x, y, anchor, more) + xml_text(text) + "</text>\n";
}

/** The next 1, 2 or 5 times a power of ten, down or up. */
double round_number(double value, bool is_up) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    double best = is_up ? 10 * power : power;
    for (const double digit : {1.0, 2.0, 5.0}) {
        const double candidate = digit * power;
        if (is_up ? candidate >= value * (1 - 1e-9) && candidate < best : candidate <= value * (1 + 1e-9)) {
            best = candidate;
        }
    }
    return best;
}

/** From values to the file's coordinates. */
class Scale {
public:
    Scale(const Plot& plot, std::size_t coordinate, const PlotAxis& axis, double from, double to)
        : m_is_logarithmic(axis.is_logarithmic), m_from(from), m_to(to) {
        m_lower = std::numeric_limits<double>::infinity();
        m_upper = -m_lower;
        for (const PlotSeries& series : plot.series) {
            for (const auto& point : series.points) {
                const double value = point[coordinate];
                if (!std::isfinite(value)) {
                    continue;
                }
                if (m_is_logarithmic && value <= 0) {
                    m_has_zero = true;
                    continue;
                }
                m_lower = std::min(m_lower, value);
                m_upper = std::max(m_upper, value);
            }
        }
        if (!(m_lower <= m_upper)) {
            m_lower = m_upper = 1;
        }
        if (m_is_logarithmic) {
            // To 1, 2 or 5 times a power of ten; a decade more below them for zero.
            m_lower = round_number(m_lower, false) / (m_has_zero ? 10 : 1);
            m_upper = std::max(round_number(m_upper, true), 10 * m_lower);
        } else {
            // From zero, unless all values lie far from it.
            m_lower = m_lower > 0 && m_lower < 0.7 * m_upper ? 0 : m_lower;
            if (m_lower == m_upper) {
                m_upper += std::max(1.0, std::abs(m_upper));
            }
            m_upper += 0.03 * (m_upper - m_lower);
        }
    }

    double operator()(double value) const {
        const double share = m_is_logarithmic ? std::log(std::max(value, m_lower) / m_lower) / std::log(m_upper / m_lower)
                                              : (value - m_lower) / (m_upper - m_lower);
        return m_from + share * (m_to - m_from);
    }
    bool is_off(double value) const { return m_is_logarithmic && value <= 0; }

    std::vector<double> ticks() const { return plot_ticks(m_lower, m_upper, m_is_logarithmic); }
    std::string tick_text(double value) const {
        if (m_has_zero && value <= m_lower * 1.0001) {
            return "0";
        }
        const bool is_plain = value == 0 || (std::abs(value) >= 1e-3 && std::abs(value) < 1e7);
        return is_plain ? format("%.10g", value) : format("%.0e", value);
    }

private:
    bool m_is_logarithmic;
    bool m_has_zero = false;
    double m_from, m_to;
    double m_lower, m_upper;
};

} // namespace

std::string to_svg(const Plot& plot) {
    const Scale x(plot, 0, plot.x, left, width - right);
    const Scale y(plot, 1, plot.y, height - bottom, top);
    std::string svg =
        format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" "
               "font-family=\"sans-serif\" font-size=\"13\">\n",
               width, height, width, height);
    svg += format("<rect width=\"%.0f\" height=\"%.0f\" fill=\"white\"/>\n", width, height);
    svg += label((left + width - right) / 2, 24, "middle", plot.title, "font-size=\"15\" font-weight=\"bold\"");

    for (const double tick : x.ticks()) {
        svg += format("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#dddddd\"/>\n", x(tick), top, x(tick),
                      height - bottom);
        svg += label(x(tick), height - bottom + 18, "middle", x.tick_text(tick));
    }
    for (const double tick : y.ticks()) {
        svg += format("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#dddddd\"/>\n", left, y(tick),
                      width - right, y(tick));
        svg += label(left - 8, y(tick) + 4, "end", y.tick_text(tick));
    }
    svg += format("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" stroke=\"black\"/>\n", left, top,
                  width - right - left, height - bottom - top);
    svg += label((left + width - right) / 2, height - 16, "middle", plot.x.label);
    const double middle = (top + height - bottom) / 2;
    svg += label(20, middle, "middle", plot.y.label, format("transform=\"rotate(-90 20 %.1f)\"", middle).c_str());

    for (std::size_t index = 0; index < plot.series.size(); ++index) {
        const PlotSeries& series = plot.series[index];
        const char* const color = colors[index % std::size(colors)];
        // A second pattern once the colours are used up.
        const char* const dashes = index < std::size(colors) ? "" : " stroke-dasharray=\"6 3\"";
        std::string path, marks;
        const auto end_path = [&] {
            svg += path.empty()
                       ? std::string()
                       : format("<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"1.6\"%s points=\"", color, dashes) +
                             path + "\"/>\n";
            path.clear();
        };
        for (const auto& [px, py] : series.points) {
            if (std::isfinite(px) && std::isfinite(py)) {
                path += format("%.1f,%.1f ", x(px), y(py));
                marks += format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.5\" stroke=\"%s\" fill=\"%s\"/>\n", x(px), y(py), color,
                                x.is_off(px) || y.is_off(py) ? "white" : color);
            } else if (series.is_curve) {
                end_path();
            }
        }
        end_path();
        svg += series.is_curve ? std::string() : marks;
        const double row = top + 14 + 20 * static_cast<double>(index);
        svg += format("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"2\"%s/>\n",
                      width - right + 14, row - 4, width - right + 36, row - 4, color, dashes);
        svg += label(width - right + 42, row, "start", series.name);
    }
    return svg + "</svg>\n";
}

void write_svg(const std::filesystem::path& path, const Plot& plot) {
    std::ofstream file(path);
    file << to_svg(plot);
    file.close();
    if (!file) {
        throw Error(path.string(), "cannot be written");
    }
}

} // namespace elvis
