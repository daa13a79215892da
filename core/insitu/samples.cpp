#include "samples.hpp"

#include <core/base/csv_text.hpp>

#include <cstring>
#include <limits>
#include <span>

namespace elvis::library {

namespace {

std::vector<const char*> pointers_to(const std::vector<std::string>& texts) {
    std::vector<const char*> list;
    for (const std::string& text : texts) {
        list.push_back(text.c_str());
    }
    return list;
}

/** Names of the table's columns. */
std::vector<std::string> heads(const PlannedSamples& planned, const Columns& columns) {
    std::vector<std::string> names{"step", "time", "x", "y", "z", "element"};
    for (std::size_t index = 0; index < planned.values.size(); ++index) {
        const std::uint32_t n = columns.columns[index].n_values;
        for (std::uint32_t component = 0; component < n; ++component) {
            std::string& name = names.emplace_back(planned.values[index]);
            if (n > 1) {
                name.append("[").append(std::to_string(component)).append("]");
            }
        }
    }
    return names;
}

} // namespace

/** What is sent of a point that lies in an element; values follow. */
struct Samples::Row {
    std::uint64_t point = 0;
    std::int64_t element = 0;
};

Samples::Samples(const PlannedSamples& planned, const std::string& path, const InsituVolume& volume, CommunicatorTeam& team)
    : m_planned(planned), m_team(team), m_columns(columns_of(volume.whole(), pointers_to(planned.values).data(),
                                                             static_cast<std::uint32_t>(planned.values.size()))) {
    m_columns.wishes.with_gradients = false;
    if (team.is_first()) {
        m_file.emplace(path, heads(planned, m_columns));
    }
}

std::vector<std::byte> Samples::own_rows(Prober* prober) const {
    std::vector<std::byte> bytes;
    const auto put = [&](const auto& item) {
        const auto raw = std::as_bytes(std::span(&item, 1));
        bytes.insert(bytes.end(), raw.begin(), raw.end());
    };
    const std::vector<ProbedPoint> points =
        prober != nullptr ? prober->probe(m_planned.points, 0, m_columns.wishes) : std::vector<ProbedPoint>{};
    for (std::size_t at = 0; at < points.size(); ++at) {
        if (!points[at].element) {
            continue;
        }
        put(Row{at, *points[at].element});
        for (const Column& column : m_columns.columns) {
            for (std::uint32_t component = 0; component < column.n_values; ++component) {
                put(column.is_field ? points[at].fields[column.field].values[component]
                                    : points[at].expressions[column.expression].value);
            }
        }
    }
    return bytes;
}

void Samples::write(Prober* prober, std::uint64_t step, double time) {
    const std::vector<std::vector<std::byte>> of_ranks = m_team.gathered(own_rows(prober));
    if (!m_team.is_first()) {
        return;
    }
    // Of elements that share a point the one with the lowest number.
    constexpr std::int64_t none = -1;
    std::vector<std::int64_t> elements(m_planned.points.size(), none);
    std::vector<double> values(elements.size() * m_columns.n_values, std::numeric_limits<double>::quiet_NaN());
    const std::size_t row_size = sizeof(Row) + m_columns.n_values * sizeof(double);
    for (const std::vector<std::byte>& bytes : of_ranks) {
        for (std::size_t at = 0; at < bytes.size(); at += row_size) {
            Row row;
            std::memcpy(&row, &bytes[at], sizeof row);
            if (elements[row.point] == none || row.element < elements[row.point]) {
                elements[row.point] = row.element;
                std::memcpy(&values[row.point * m_columns.n_values], &bytes[at + sizeof row], row_size - sizeof row);
            }
        }
    }
    std::string rows;
    for (std::size_t point = 0; point < elements.size(); ++point) {
        rows += std::to_string(step);
        append_csv_number(rows, time);
        for (const double coordinate : m_planned.points[point]) {
            append_csv_number(rows, coordinate);
        }
        rows.append(",").append(std::to_string(elements[point]));
        for (std::uint32_t value = 0; value < m_columns.n_values; ++value) {
            append_csv_number(rows, values[point * m_columns.n_values + value]);
        }
        rows += '\n';
    }
    m_file->append(rows);
}

} // namespace elvis::library
