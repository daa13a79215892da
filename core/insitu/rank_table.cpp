#include "rank_table.hpp"

#include <core/base/error.hpp>
#include <core/plugin_host/plugin.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace elvis::library {

namespace {

[[noreturn]] const elvis::RuntimeVolume& no_file(const std::string& path) {
    throw api::Error(ELVIS_ERROR_UNSUPPORTED, path, "a volume of several ranks is no file");
}

} // namespace

RankTable::RankTable(const api::Host& host, const std::string& path, const std::string&) : RankTable(host, no_file(path), {}) {}

RankTable::RankTable(const api::Host& host, const elvis::RuntimeVolume& served, ElementsOfTable elements)
    : HandedOnTable(host, served, elements.n_elements), m_elements(std::move(elements)) {
    for (std::uint64_t there = 0; there < m_elements.served.size(); ++there) {
        m_places.push_back({m_elements.served[there], there});
    }
    std::ranges::sort(m_places, {}, &Place::element);
    std::vector<elvis_face> faces;
    read_faces([&](elvis_face face) {
        face.element = place_here(face.element);
        face.neighbour = place_here(face.neighbour);
        faces.push_back(face);
    });
    set_faces(std::move(faces));
}

std::int64_t RankTable::place_here(std::int64_t served) const {
    return served < 0 ? served : static_cast<std::int64_t>(m_elements.served[static_cast<std::size_t>(served)]);
}

bool RankTable::is_known(std::uint64_t element) const {
    return std::ranges::binary_search(m_places, element, {}, &Place::element);
}

void RankTable::for_each_run(std::uint64_t first, std::uint64_t count, const Read& read) const {
    const auto begin = std::ranges::lower_bound(m_places, first, {}, &Place::element);
    const auto end = std::ranges::lower_bound(begin, m_places.end(), first + count, {}, &Place::element);
    if (static_cast<std::uint64_t>(end - begin) != count) {
        throw Error(asked().path(), "an element is asked for that this rank does not serve");
    }
    for (auto next = begin; next != end;) {
        auto last = next + 1;
        while (last != end && last->there == std::prev(last)->there + 1) {
            ++last;
        }
        read(next->there, static_cast<std::uint64_t>(last - next), next->element - first);
        next = last;
    }
}

void RankTable::get_element_numbers(std::uint64_t first, std::span<std::int64_t> numbers) {
    std::ranges::copy(std::span(m_elements.numbers).subspan(first, numbers.size()), numbers.begin());
}

RuntimeVolume open_rank_table(const RuntimeVolume& served, ElementsOfTable elements) {
    const auto open = [&](const elvis_host* host) {
        return reinterpret_cast<elvis_volume*>(new RankTable(api::Host(host), served, std::move(elements)));
    };
    const elvis_apex_bounds* const apex_bounds = served.has_apex_bounds() ? api::apex_bounds_table<RankTable>() : nullptr;
    return {Plugin::of_program(table_like<RankTable>(served), served.plugin().id(), apex_bounds), served.path(), open};
}

} // namespace elvis::library
