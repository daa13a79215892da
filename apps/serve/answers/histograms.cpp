#include "histograms.hpp"
#include "draw.hpp"

#include <chrono>

namespace elvis::serve {

namespace {

/** So many, then they are forgotten; each takes a tenth of a mebibyte. */
constexpr std::size_t most_histograms = 100;
constexpr std::chrono::milliseconds patience{50};

} // namespace

nlohmann::json Histograms::grow(const Served& served, const Scene& scene, const std::string& field, const task& watch) {
    const elvis::scene shown = served.library_scene(scene);
    const std::string text = shown.expression(field);
    const std::uint32_t time_step = view::time_step_of(scene);
    // What its values depend on.
    const std::string key = std::to_string(time_step) + "|" + text + "|" + view::part_of(scene, "warp").dump();
    const std::lock_guard lock(m_mutex);
    auto found = m_entries.find(key);
    if (found == m_entries.end()) {
        const elvis_range range = served.volume.range(text, time_step);
        if (m_entries.size() >= most_histograms) {
            m_entries.clear();
        }
        found = m_entries.emplace(key, Entry{view::Histogram(range.minimum, range.maximum)}).first;
    }
    Entry& entry = found->second;
    const auto end = std::chrono::steady_clock::now() + patience;
    while (entry.n_pieces < ELVIS_SAMPLE_PIECES && !(watch.is_cancelled && watch.is_cancelled()) &&
           std::chrono::steady_clock::now() < end) {
        entry.histogram.add(served.volume.sample(shown, field, entry.n_pieces));
        ++entry.n_pieces;
    }
    const view::Histogram& known = entry.histogram;
    return {{"lower", known.lower()},
            {"upper", known.upper()},
            {"bins", known.bins()},
            {"quantiles", {known.quantile(0.02), known.quantile(0.1), known.quantile(0.9), known.quantile(0.98)}},
            {"is_complete", entry.n_pieces == ELVIS_SAMPLE_PIECES}};
}

} // namespace elvis::serve
