#include <core/parts/whole_ranges.hpp>

#include <core/expression/expression.hpp>
#include <core/parts/partition.hpp>
#include <core/volume/field/field_extrema.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace elvis {

namespace {

constexpr double infinitely_large = std::numeric_limits<double>::infinity();

/** Smallest, largest (with the other sign, so that the smaller is the larger) and the worse certainty, likewise. */
struct Enclosure {
    double lower = infinitely_large, minus_upper = infinitely_large, minus_certainty = -double{ELVIS_CERTIFIED};

    void take(double least, double most, elvis_certainty certainty) {
        // Without any finite value they are no numbers.
        lower = std::isnan(least) ? lower : std::min(lower, least);
        minus_upper = std::isnan(most) ? minus_upper : std::min(minus_upper, -most);
        minus_certainty = std::min(minus_certainty, -static_cast<double>(certainty));
    }
    elvis_certainty certainty() const { return static_cast<elvis_certainty>(-minus_certainty); }
};
static_assert(sizeof(Enclosure) == 3 * sizeof(double));

void unite(std::span<Enclosure> enclosures, Team& team) {
    std::vector<double> numbers;
    for (const Enclosure& one : enclosures) {
        numbers.insert(numbers.end(), {one.lower, one.minus_upper, one.minus_certainty});
    }
    team.minimum(numbers);
    for (std::size_t i = 0; i < enclosures.size(); ++i) {
        enclosures[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
    }
}

std::string key_of(const FieldChoice& field) {
    return field.expression ? "= " + field.expression->text()
                            : std::to_string(field.field) + "." + std::to_string(field.component);
}

} // namespace

WholeRanges::WholeRanges(const PartedVolume& volume, const std::vector<double>& boxes, std::span<Renderer* const> parts,
                         Team& team)
    : m_volume(volume), m_whole(volume.whole()), m_boxes(boxes), m_parts(parts), m_team(team), m_bounds(box_around(boxes)) {}

const std::vector<Vector3>& WholeRanges::outline() {
    if (m_outline.empty()) {
        m_outline = outline_points(m_whole, m_boxes, m_volume.shared_mapping());
    }
    return m_outline;
}

const FieldExtrema& WholeRanges::extrema(const FieldChoice& field, std::uint32_t time_step) {
    const std::pair name(key_of(field), time_step);
    auto known = m_extrema.find(name);
    if (known == m_extrema.end()) {
        known = m_extrema.try_emplace(name, found_extrema(field, time_step)).first;
    }
    return known->second;
}

FieldExtrema WholeRanges::found_extrema(const FieldChoice& field, std::uint32_t time_step) {
    if (!field.expression && m_volume.tells_extrema(field.field, time_step)) {
        if (const auto said = m_whole.extrema(field.field, field.component, time_step)) {
            return *said;
        }
    }
    std::array<Enclosure, 2> both; // Values, and what is beyond none.
    for (Renderer* const part : m_parts) {
        const FieldExtrema& own = part->ranges().extrema(field, time_step);
        both[0].take(own.minimum.value, own.maximum.value, own.certainty);
        both[1].take(own.minimum.bound, own.maximum.bound, own.certainty);
    }
    unite(both, m_team);
    return {{both[0].lower, both[1].lower, 0, {}}, {-both[0].minus_upper, -both[1].minus_upper, 0, {}}, both[0].certainty()};
}

FieldRange WholeRanges::range(const FieldChoice& field, std::uint32_t time_step, elvis_certainty* certainty) {
    const std::pair name(key_of(field), time_step);
    auto known = m_ranges.find(name);
    if (known == m_ranges.end()) {
        known = m_ranges.try_emplace(name, found_range(field, time_step)).first;
    }
    if (certainty != nullptr) {
        *certainty = known->second.second;
    }
    return known->second.first;
}

std::pair<FieldRange, elvis_certainty> WholeRanges::found_range(const FieldChoice& field, std::uint32_t time_step) {
    std::array<Enclosure, 1> all;
    for (Renderer* const part : m_parts) {
        elvis_certainty own = ELVIS_ESTIMATED;
        const FieldRange range = part->ranges().range(field, time_step, &own);
        all[0].take(range.lower, range.upper, own);
    }
    unite(all, m_team);
    return {{all[0].lower, -all[0].minus_upper}, all[0].certainty()};
}

double WholeRanges::value_rounding(const FieldChoice& field, std::uint32_t time_step) {
    double minus_largest = 0;
    for (Renderer* const part : m_parts) {
        const double own = part->ranges().value_rounding(field, time_step);
        minus_largest = std::isnan(own) ? minus_largest : std::min(minus_largest, -own);
    }
    m_team.minimum(std::span(&minus_largest, 1));
    return -minus_largest;
}

VolumeRanges::Ranges WholeRanges::of_components(std::uint32_t field, std::uint32_t time_step) {
    std::vector<Enclosure> components(m_whole.fields()[field].n_components);
    for (Renderer* const part : m_parts) {
        const auto& [own, certainty] = part->ranges().of_components(field, time_step);
        for (std::size_t component = 0; component < own.size(); ++component) {
            components[component].take(own[component].lower, own[component].upper, certainty);
        }
    }
    unite(components, m_team);
    VolumeRanges::Ranges ranges;
    ranges.second = components.front().certainty();
    for (const Enclosure& component : components) {
        ranges.first.push_back({component.lower, -component.minus_upper});
    }
    return ranges;
}

void WholeRanges::forget_fields() {
    m_extrema.clear();
    m_ranges.clear();
}

} // namespace elvis
