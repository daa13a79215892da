// What the workbench asks of the volume for panels: a line, numbers, ranges, transfer functions, histograms.
#include "workbench.hpp"

#include <algorithm>
#include <utility>

namespace elvis::view {

namespace {

/** Kept, of a tenth of a mebibyte each: time steps that are played would bring ever more. */
constexpr std::size_t most_histograms = 100;

} // namespace

const LineAnswer* Workbench::line_answer() {
    if (!line || !m_model.volume()) {
        return nullptr;
    }
    std::string key = field_key(line->field ? line->field : said<std::string>(m_model.scene(), "field"));
    for (const Vector3& end : {line->from, line->to}) {
        key.append(reinterpret_cast<const char*>(end.data()), sizeof end);
    }
    // One question at a time: while the hand drags an end, places that it has left are not asked.
    if (key != m_line_key && !m_is_asking_line) {
        m_line_key = key;
        m_is_asking_line = true;
        const auto take = [this, number = m_volume_number](LineAnswer answer) {
            m_is_asking_line = false;
            if (number == m_volume_number) {
                m_line_answer = std::move(answer);
            }
        };
        m_worker.post(
            "following the line",
            [scene = m_model.scene(), asked = *line, take](Session& session) -> FrameWorker::Answer {
                return [take, answer = session.along(scene, asked)] { take(answer); };
            },
            [take, asked = *line](const std::string& error) {
                LineAnswer answer;
                answer.line = asked;
                answer.error = error;
                take(std::move(answer));
            });
    }
    return m_line_answer ? &*m_line_answer : nullptr;
}

void Workbench::find_numbers() {
    stop_numbers();
    m_numbers.clear();
    if (!m_model.volume()) {
        return;
    }
    for (NumbersQuestion& question : questions_of(m_model.scene(), *m_model.volume())) {
        m_numbers.push_back({std::move(question), {}, {}, {}, false});
    }
    if (!m_numbers.empty()) {
        m_is_searching = true;
        find_row(0, m_model.scene());
    }
}

void Workbench::stop_numbers() {
    ++m_numbers_search;
    m_is_searching = false;
}

bool Workbench::is_finding_numbers() const {
    return m_is_searching && std::ranges::any_of(m_numbers, [](const Numbers& row) { return !row.is_done; });
}

bool Workbench::has_present_numbers() const {
    if (!m_model.volume()) {
        return false;
    }
    const std::vector<NumbersQuestion> wanted = questions_of(m_model.scene(), *m_model.volume());
    return std::ranges::equal(m_numbers, wanted, {}, &Numbers::question);
}

void Workbench::find_row(std::size_t row, const Scene& scene) {
    const std::uint64_t search = m_numbers_search;
    const auto take = [this, row, scene, search](const Numbers& found) {
        if (search != m_numbers_search) {
            return;
        }
        m_numbers[row] = found;
        if (row + 1 < m_numbers.size()) {
            find_row(row + 1, scene);
        }
    };
    m_worker.post_later(
        "integrating",
        [this, scene, question = m_numbers[row].question, row, search, take](Session& session) -> FrameWorker::Answer {
            // A picture that is wanted does not wait: the row is begun again after it.
            const auto is_stopped = [this, search] { return search != m_numbers_search || m_worker.drawing().has_value(); };
            try {
                return [take, found = session.numbers(scene, question, is_stopped)] { take(found); };
            } catch (const cancelled&) {
                return [this, row, scene, search] {
                    if (search == m_numbers_search) {
                        find_row(row, scene);
                    }
                };
            }
        },
        [](const std::string&) {}); // Rows hold their errors.
}

std::string Workbench::field_key(const std::optional<std::string>& field) const {
    const Scene& scene = m_model.scene();
    std::string key = std::to_string(time_step_of(scene));
    // Derivatives are those in the displaced coordinates.
    key += part_of(scene, "warp").dump();
    const std::string text = field.value_or("");
    // Distances are to surfaces of the scene, which may move.
    if (text.find("distance") != std::string::npos) {
        key += ' ';
        key += std::to_string(m_model.revision());
    }
    key += '|';
    key += text;
    return key;
}

const Json& Workbench::transfer(const Json& color_map, const Json& volume_rendering, const std::array<double, 2>& range) {
    const Scene scene{{"version", 1}, {"color_map", color_map}, {"volume_rendering", volume_rendering}};
    const std::string key = scene.dump() + Json(range).dump();
    constexpr std::size_t most_transfers = 100;
    if (m_transfers.size() >= most_transfers && !m_transfers.contains(key)) {
        m_transfers.clear();
    }
    const auto [found, is_new] = m_transfers.try_emplace(key);
    if (is_new) {
        try {
            found->second = m_session->transfer(scene, range, m_model.volume()->diagonal());
        } catch (const std::exception&) {
            found->second = {{"color", Json::array()}, {"density", Json::array()}};
        }
    }
    return found->second;
}

std::optional<FieldRange> Workbench::range(const std::optional<std::string>& field) {
    if (!m_model.volume()) {
        return std::nullopt;
    }
    const std::string key = field_key(field);
    const auto [found, is_new] = m_ranges.try_emplace(key);
    if (is_new) {
        const Scene& scene = m_model.scene();
        m_worker.post(
            "finding a range",
            [this, scene, field, key, number = m_volume_number](Session& session) -> FrameWorker::Answer {
                const FieldRange range = session.range(scene, field);
                return [this, range, key, number] {
                    if (number == m_volume_number) {
                        m_ranges[key] = range;
                    }
                };
            },
            [](const std::string&) {}); // The picture says it.
    }
    return found->second;
}

const Histogram* Workbench::histogram(const std::optional<std::string>& field) {
    const std::optional<FieldRange> ends = range(field);
    if (!ends || m_model.volume()->dimension == 2) {
        return nullptr;
    }
    const std::string key = field_key(field);
    if (m_histograms.size() >= most_histograms && !m_histograms.contains(key)) {
        m_histograms.clear();
    }
    const auto [found, is_new] = m_histograms.try_emplace(key);
    if (is_new) {
        found->second.emplace(ends->lower, ends->upper);
        sample(field, key, 0);
    }
    return found->second->n_values() > 0 ? &*found->second : nullptr;
}

void Workbench::sample(const std::optional<std::string>& field, const std::string& key, unsigned piece) {
    const Scene& scene = m_model.scene();
    m_worker.post_later(
        "sampling the field",
        [this, scene, field, key, piece, number = m_volume_number](Session& session) -> FrameWorker::Answer {
            return [this, values = session.samples(scene, field, piece), field, key, piece, number] {
                const auto found = m_histograms.find(key);
                if (number != m_volume_number || found == m_histograms.end()) {
                    return;
                }
                found->second->add(values);
                if (piece + 1 < ELVIS_SAMPLE_PIECES) {
                    sample(field, key, piece + 1);
                }
            };
        },
        [](const std::string&) {});
}

} // namespace elvis::view
