#include <core/spirv/known_values.hpp>

#include <algorithm>

namespace elvis {

namespace {

bool lies_within(const Place& place, const Place& outer) {
    return place.size() >= outer.size() && std::equal(outer.begin(), outer.end(), place.begin());
}

} // namespace

std::optional<std::uint32_t> KnownValues::at(const Place& place) const {
    const auto found = m_values.find(place);
    return found == m_values.end() ? std::nullopt : std::optional(found->second);
}

bool KnownValues::knows_within(const Place& place) const {
    const auto found = m_values.lower_bound(place);
    return found != m_values.end() && lies_within(found->first, place);
}

void KnownValues::set(const Place& place, std::uint32_t value) { change(place, value); }

void KnownValues::forget(const Place& place) { change(place, {}); }

void KnownValues::forget_within(const Place& place) {
    for (auto found = m_values.lower_bound(place); found != m_values.end() && lies_within(found->first, place);) {
        m_changes.push_back({found->first, found->second});
        found = m_values.erase(found);
    }
}

void KnownValues::change(const Place& place, std::optional<std::uint32_t> value) {
    const std::optional<std::uint32_t> before = at(place);
    if (before == value) {
        return;
    }
    m_changes.push_back({place, before});
    if (value) {
        m_values[place] = *value;
    } else {
        m_values.erase(place);
    }
}

void KnownValues::go_back(std::size_t moment) {
    while (m_changes.size() > moment) {
        const Change& last = m_changes.back();
        if (last.before) {
            m_values[last.place] = *last.before;
        } else {
            m_values.erase(last.place);
        }
        m_changes.pop_back();
    }
}

KnownValues::Values KnownValues::changed_since(std::size_t moment) const {
    Values values;
    for (std::size_t i = moment; i < m_changes.size(); ++i) {
        values[m_changes[i].place] = at(m_changes[i].place);
    }
    return values;
}

void KnownValues::keep_common(std::size_t moment, const Values& first) {
    // What only the second way has changed had the value of before on the first.
    std::map<Place, std::optional<std::uint32_t>> before;
    for (std::size_t i = moment; i < m_changes.size(); ++i) {
        before.emplace(m_changes[i].place, m_changes[i].before);
    }
    for (const auto& [place, value] : first) {
        before[place] = value;
    }
    for (const auto& [place, value] : before) {
        if (at(place) != value) {
            forget(place);
        }
    }
}

void KnownValues::apply(const Values& values) {
    for (const auto& [place, value] : values) {
        change(place, value);
    }
}

} // namespace elvis
