#include "rank_table_volume.hpp"
#include "ranks.hpp"

#include <core/api/call.hpp>
#include <core/plugin_host/selected_volume.hpp>

#include <algorithm>
#include <numeric>
#include <sstream>

namespace elvis::library {

namespace {

void add_fields(const RuntimeVolume& volume, std::ostream& text) {
    for (std::uint32_t field = 0; field < volume.fields().size(); ++field) {
        const FieldInfo& info = volume.fields()[field];
        text << info.name << '\n' << info.n_components << ' ' << info.continuity << ' ' << info.transform << ';';
        for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
            const ClassFieldInfo of_class = volume.class_field(index, field);
            text << of_class.order[0] << ' ' << of_class.order[1] << ' ' << of_class.order[2] << ';';
            for (const auto& [name, value] : of_class.constants) {
                text << name << ' ' << value << ';';
            }
        }
        for (std::uint32_t buffer = 0; buffer < volume.n_buffers(); ++buffer) {
            const BufferInfo of_field = volume.buffer(buffer, field);
            text << of_field.name << '\n'
                 << of_field.kind << ' ' << of_field.element_class << ' ' << of_field.depends << ' ' << of_field.record_size
                 << ';';
        }
    }
}

/** All that has to be the same on all ranks. */
std::string as_text(const RuntimeVolume& volume) {
    std::ostringstream text;
    text << volume.dimension() << volume.has_evaluation() << volume.has_field_ranges() << volume.has_derivative_bounds()
         << volume.has_apex_bounds() << volume.has_jacobian_checks() << volume.numbers_are_positions() << ';';
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        const ClassInfo& info = volume.classes()[index];
        text << info.shape << ' ' << info.geometry_order[0] << ' ' << info.geometry_order[1] << ' ' << info.geometry_order[2]
             << ' ' << info.is_affine << ';';
        const Snippet snippet = volume.snippet(index);
        text << snippet.capabilities << snippet.prefix << '\n';
        for (const SnippetText& source : snippet.sources) {
            text << source.name << '\n' << source.text << '\n';
        }
    }
    add_fields(volume, text);
    for (const std::string& group : volume.boundary_groups()) {
        text << group << '\n';
    }
    return text.str();
}

std::vector<std::uint64_t> counts_by_class(const RuntimeVolume& volume) {
    std::vector<std::uint64_t> counts;
    for (const ClassInfo& info : volume.classes()) {
        counts.push_back(info.n_elements);
    }
    return counts;
}

/** Collective: of all elements. Throws InvalidArgument where two have the same. */
std::vector<std::int64_t> numbers_of_all(const RuntimeVolume& served, const Partition& partition, CommunicatorTeam& team) {
    std::vector<std::int64_t> own(served.n_elements());
    served.element_numbers(0, own.size(), own);
    const std::vector<double> all = in_order_of_elements(partition, team.joined({own.begin(), own.end()}));
    std::vector<std::int64_t> numbers(all.begin(), all.end());
    if (served.numbers_are_positions()) {
        std::iota(numbers.begin(), numbers.end(), std::int64_t{0});
    }
    std::vector<std::int64_t> sorted = numbers;
    std::ranges::sort(sorted);
    if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end()) {
        throw InvalidArgument("runtime", "two elements have the number " + std::to_string(*twice) +
                                             ": numbers are those of the whole mesh (get_element_numbers)");
    }
    return numbers;
}

} // namespace

RankTableVolume::RankTableVolume(const elvis_runtime& table, elvis_volume* volume, const std::string& name,
                                 CommunicatorTeam& team)
    : m_served(table, volume, name) {
    const RuntimeVolume& served = m_served.whole();
    need_element_records(served);
    need_same_on_all(as_text(served), team, "runtime",
                     "classes, fields, buffers, snippets or boundary groups are not those of rank 0");
    ElementsOfRanks all = elements_of_ranks(counts_by_class(served), team, "runtime");
    m_partition.emplace(std::move(all.partition));
    ElementsOfTable elements{std::move(all.n_elements), m_partition->elements(team.rank()),
                             numbers_of_all(served, *m_partition, team)};
    const std::vector<std::uint64_t> own = elements.own;
    m_whole.emplace(open_rank_table(served, std::move(elements)));
    m_parted = parted_by_plugin(*m_whole, mapping_of_ranks(*m_whole, *m_partition, team));
    m_own.emplace(selected_volume(*m_whole, own, SelectedFaces::of_elements));
}

} // namespace elvis::library
