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
                 << ' ' << (of_field.element_class == ELVIS_ALL_CLASSES ? of_field.n_records : 0) << ';';
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

/** As the rank's functions count them. */
std::vector<std::uint64_t> own_places(const RuntimeVolume& served, const std::uint8_t* is_own) {
    std::vector<std::uint64_t> places;
    for (std::uint64_t element = 0; element < served.n_elements(); ++element) {
        if (is_own == nullptr || is_own[element] != 0) {
            places.push_back(element);
        }
    }
    return places;
}

std::vector<std::uint64_t> counts_by_class(const RuntimeVolume& served, const std::vector<std::uint64_t>& own) {
    std::vector<std::uint64_t> counts;
    for (const ClassInfo& info : served.classes()) {
        counts.push_back(static_cast<std::uint64_t>(std::ranges::count_if(own, [&](std::uint64_t element) {
            return element >= info.first_element && element < info.first_element + info.n_elements;
        })));
    }
    return counts;
}

/** Of all elements by number, in the order of numbers. */
struct NumberedElement {
    std::int64_t number;
    std::uint64_t element;
};

/** Throws InvalidArgument where two have the same. */
std::vector<NumberedElement> by_number(const std::vector<std::int64_t>& numbers) {
    std::vector<NumberedElement> all;
    for (const std::int64_t number : numbers) {
        all.push_back({number, all.size()});
    }
    std::ranges::sort(all, {}, &NumberedElement::number);
    if (const auto twice = std::ranges::adjacent_find(all, {}, &NumberedElement::number); twice != all.end()) {
        throw InvalidArgument("runtime", "two elements have the number " + std::to_string(twice->number) +
                                             ": numbers are those of the whole mesh (get_element_numbers), and an element "
                                             "is one rank's own");
    }
    return all;
}

/** Collective: which elements the rank serves, and how all are numbered. `own`: as its functions count them. */
ElementsOfTable elements_of_table(const RuntimeVolume& served, const std::vector<std::uint64_t>& own,
                                  std::vector<std::uint64_t> n_elements, const Partition& partition, CommunicatorTeam& team) {
    std::vector<std::int64_t> numbers(served.n_elements());
    served.element_numbers(0, numbers.size(), numbers);
    std::vector<double> of_own;
    for (const std::uint64_t place : own) {
        of_own.push_back(static_cast<double>(numbers[place]));
    }
    const std::vector<double> of_all = in_order_of_elements(partition, team.joined(std::move(of_own)));
    ElementsOfTable all{std::move(n_elements), std::vector<std::uint64_t>(numbers.size()), {of_all.begin(), of_all.end()}};
    if (served.numbers_are_positions()) {
        if (own.size() < numbers.size()) {
            throw InvalidArgument("is_own", "elements of other ranks need numbers of the whole mesh (get_element_numbers)");
        }
        std::iota(all.numbers.begin(), all.numbers.end(), std::int64_t{0});
        all.served = partition.elements(team.rank());
        return all;
    }
    const std::vector<NumberedElement> known = by_number(all.numbers);
    for (std::size_t place = 0; place < numbers.size(); ++place) {
        const auto found = std::ranges::lower_bound(known, numbers[place], {}, &NumberedElement::number);
        if (found == known.end() || found->number != numbers[place]) {
            throw InvalidArgument("is_own", "element " + std::to_string(numbers[place]) + " is no rank's own");
        }
        all.served[place] = found->element;
    }
    return all;
}

/** Of this rank's table. */
class PartedByRanks final : public PartedVolume {
public:
    PartedByRanks(const RuntimeVolume& whole, std::vector<std::uint64_t> served, MappingReader shared_mapping)
        : m_whole(whole), m_served(std::move(served)), m_shared_mapping(std::move(shared_mapping)) {
        std::ranges::sort(m_served);
    }

    const RuntimeVolume& whole() const override { return m_whole; }
    OpenedElements open(std::span<const std::uint64_t> elements) const override {
        return {selected_volume(m_whole, {elements.begin(), elements.end()}, SelectedFaces::of_elements), [] {}};
    }
    bool can_open(std::uint64_t element) const override { return std::ranges::binary_search(m_served, element); }
    bool tells_extrema(std::uint32_t, std::uint32_t) const override { return false; }
    MappingReader shared_mapping() const override { return m_shared_mapping; }

private:
    const RuntimeVolume& m_whole;
    std::vector<std::uint64_t> m_served;
    MappingReader m_shared_mapping;
};

} // namespace

RankTableVolume::RankTableVolume(const elvis_runtime& table, elvis_volume* volume, const std::uint8_t* is_own,
                                 const std::string& name, CommunicatorTeam& team)
    : m_served(table, volume, name) {
    const RuntimeVolume& served = m_served.whole();
    need_element_records(served);
    need_same_on_all(as_text(served), team, "runtime",
                     "classes, fields, buffers, snippets or boundary groups are not those of rank 0");
    const std::vector<std::uint64_t> own = own_places(served, is_own);
    ElementsOfRanks all = elements_of_ranks(counts_by_class(served, own), team, "runtime");
    m_partition.emplace(std::move(all.partition));
    ElementsOfTable elements = elements_of_table(served, own, std::move(all.n_elements), *m_partition, team);
    const std::vector<std::uint64_t> places = elements.served;
    m_whole.emplace(open_rank_table(served, std::move(elements)));
    m_parted = std::make_unique<PartedByRanks>(*m_whole, places, mapping_of_ranks(*m_whole, *m_partition, team));
    if (!own.empty()) {
        m_own.emplace(m_parted->open(m_partition->elements(team.rank())));
    }
}

} // namespace elvis::library
