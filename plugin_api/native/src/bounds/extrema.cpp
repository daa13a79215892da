#include <elvis/native/extrema.hpp>

#include "bernstein_tables.hpp"
#include "cube_maximum.hpp"
#include "numbers.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace elvis::native {
namespace {

/** Elements that are read at once in the second round. */
constexpr std::uint64_t elements_at_once = 1024;

struct ElementPlace {
    std::size_t element_class = 0;
    std::uint64_t element = 0;

    friend auto operator<=>(const ElementPlace&, const ElementPlace&) = default;
};

/** An element in which a larger value may be. */
struct Candidate {
    ElementPlace place;
    double bound = 0;
};

/** One objective over all elements. */
struct Side {
    Objective objective;
    std::size_t component; // of values
    Peak best{-infinity, {}};
    ElementPlace place;
    /** Of elements that have been left: no value there is larger. */
    double bound = -infinity;
    std::vector<Candidate> candidates;
    std::size_t n_after_pruning = 0;

    Side(Objective what, std::size_t of_component) : objective(what), component(of_component) {}

    bool is_magnitude() const { return objective == Objective::magnitude || objective == Objective::negative_magnitude; }

    /** The lower place wins among equal values, whatever the order of blocks. */
    void raise(const Peak& peak, const ElementPlace& at) {
        if (peak.value > best.value || (peak.value == best.value && at < place)) {
            best = peak;
            place = at;
        }
    }

    /** Leaves elements whose bounds do not reach beyond the best value by more than the tolerance. */
    void prune(double tolerance) {
        std::erase_if(candidates, [&](const Candidate& candidate) {
            const bool is_left = candidate.bound <= best.value + tolerance;
            if (is_left)
                bound = std::max(bound, candidate.bound);
            return is_left;
        });
        n_after_pruning = candidates.size();
    }
};

/** Of one class: from coefficients to forms, and what looks for large values in them. */
struct ClassForms {
    BernsteinTables tables;
    std::size_t n_components;
    std::vector<double> workspace, forms;
    std::vector<CubeMaximum> maxima; // one a side

    ClassForms(const Space& space, std::size_t components, const std::vector<Side>& sides)
        : tables(space), n_components(components), workspace(tables.workspace_size()), forms(components * tables.size()) {
        const Sizes sizes{tables.size_outer, tables.size_mid, tables.size_inner};
        for (const Side& side : sides)
            maxima.emplace_back(space.shape, sizes, side.is_magnitude() ? components : 1, side.objective);
    }

    /** Bernstein forms of all components of an element. A bound of their error, or NaN if they are not finite. */
    double transform(std::span<const double> coefficients) {
        const std::size_t n_modes = tables.weights.size();
        double error = 0;
        for (std::size_t component = 0; component < n_components; ++component) {
            const double* const c = coefficients.data() + component * n_modes;
            double magnitude = 0;
            for (std::size_t mode = 0; mode < n_modes; ++mode)
                magnitude += std::abs(c[mode]) * tables.weights[mode];
            // Squares of them must not overflow either.
            if (!(magnitude < 1e150))
                return std::numeric_limits<double>::quiet_NaN();
            error = std::max(error, tables.gamma * magnitude);
            tables.transform<1>(c, workspace.data(), forms.data() + component * tables.size());
        }
        return error;
    }

    std::span<const double> forms_of(const Side& side) const {
        return side.is_magnitude() ? std::span<const double>(forms)
                                   : std::span(forms).subspan(side.component * tables.size(), tables.size());
    }
};

} // namespace

class ExtremaSearch::Impl {
public:
    Impl(std::span<const Space> spaces, std::uint32_t n_components) : m_n_components(n_components) {
        for (std::size_t component = 0; component < n_components; ++component)
            for (const Objective objective : {Objective::negative, Objective::value})
                m_sides.emplace_back(objective, component);
        if (n_components > 1)
            for (const Objective objective : {Objective::negative_magnitude, Objective::magnitude})
                m_sides.emplace_back(objective, 0);
        for (const Space& space : spaces)
            m_classes->emplace_back(space, n_components, m_sides);
    }

    void add(std::size_t element_class, std::uint64_t first, std::uint64_t count, std::span<const double> coefficients);
    std::vector<Extrema> finish(const Read& read);

private:
    std::size_t record_size(std::size_t element_class) const {
        return m_n_components * (*m_classes)[element_class].tables.weights.size();
    }
    /** The smallest value is the largest of the negative one: sides come in pairs. */
    double tolerance(std::size_t side) const {
        const double distance = m_sides[side ^ 1].best.value + m_sides[side].best.value;
        return std::isfinite(distance) ? extrema_tolerance * distance : 0;
    }
    std::vector<ElementPlace> blocks_to_read() const;
    void search_block(const ElementPlace& block, const Read& read);
    void search_element(std::size_t side, const ElementPlace& place, std::span<const double> coefficients);

    std::size_t m_n_components;
    std::vector<Side> m_sides;
    std::shared_ptr<std::vector<ClassForms>> m_classes = std::make_shared<std::vector<ClassForms>>();
};

void ExtremaSearch::Impl::add(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                              std::span<const double> coefficients) {
    ClassForms& forms = (*m_classes)[element_class];
    const std::size_t size = record_size(element_class);
    assert(coefficients.size() == count * size);
    for (std::uint64_t element = 0; element < count; ++element) {
        const double error = forms.transform(coefficients.subspan(element * size, size));
        if (!std::isfinite(error))
            continue;
        const ElementPlace place{element_class, first + element};
        for (std::size_t index = 0; index < m_sides.size(); ++index) {
            Side& side = m_sides[index];
            side.raise(forms.maxima[index].largest_corner(forms.forms_of(side)), place);
            const double bound = forms.maxima[index].bound(forms.forms_of(side), error);
            if (bound > side.best.value)
                side.candidates.push_back({place, bound});
            else
                side.bound = std::max(side.bound, bound);
        }
    }
    for (Side& side : m_sides)
        if (side.candidates.size() > 2 * side.n_after_pruning + elements_at_once)
            side.prune(0);
}

std::vector<ElementPlace> ExtremaSearch::Impl::blocks_to_read() const {
    std::vector<ElementPlace> blocks;
    for (const Side& side : m_sides)
        for (const Candidate& candidate : side.candidates)
            blocks.push_back({candidate.place.element_class, candidate.place.element / elements_at_once});
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    return blocks;
}

void ExtremaSearch::Impl::search_element(std::size_t index, const ElementPlace& place, std::span<const double> coefficients) {
    ClassForms& forms = (*m_classes)[place.element_class];
    Side& side = m_sides[index];
    const double error = forms.transform(coefficients);
    Peak peak = side.best;
    const double bound = forms.maxima[index].search(forms.forms_of(side), error, tolerance(index), peak);
    if (peak.value > side.best.value)
        side.raise(peak, place);
    side.bound = std::max(side.bound, bound);
}

void ExtremaSearch::Impl::search_block(const ElementPlace& block, const Read& read) {
    struct Wanted {
        std::size_t side;
        Candidate candidate;
    };
    std::vector<Wanted> wanted;
    std::uint64_t first = std::numeric_limits<std::uint64_t>::max(), end = 0;
    const ElementPlace start{block.element_class, block.element * elements_at_once};
    for (std::size_t index = 0; index < m_sides.size(); ++index) {
        const std::vector<Candidate>& all = m_sides[index].candidates;
        for (auto candidate = std::ranges::lower_bound(all, start, {}, &Candidate::place);
             candidate != all.end() && candidate->place.element_class == start.element_class &&
             candidate->place.element < start.element + elements_at_once;
             ++candidate) {
            wanted.push_back({index, *candidate});
            first = std::min(first, candidate->place.element);
            end = std::max(end, candidate->place.element + 1);
        }
    }
    const std::size_t size = record_size(block.element_class);
    std::vector<double> coefficients((end - first) * size);
    read(block.element_class, first, end - first, coefficients);
    // The best ones first: what they give spares others.
    std::stable_sort(wanted.begin(), wanted.end(),
                     [](const Wanted& a, const Wanted& b) { return a.candidate.bound > b.candidate.bound; });
    for (const auto& [index, candidate] : wanted) {
        Side& side = m_sides[index];
        if (candidate.bound <= side.best.value + tolerance(index))
            side.bound = std::max(side.bound, candidate.bound);
        else
            search_element(index, candidate.place,
                           std::span(coefficients).subspan((candidate.place.element - first) * size, size));
    }
}

std::vector<Extrema> ExtremaSearch::Impl::finish(const Read& read) {
    for (std::size_t index = 0; index < m_sides.size(); ++index) {
        Side& side = m_sides[index];
        side.prune(tolerance(index));
        std::ranges::sort(side.candidates, {}, &Candidate::place);
    }
    for (const ElementPlace& block : blocks_to_read())
        search_block(block, read);
    std::vector<Extrema> result;
    for (std::size_t index = 0; index < m_sides.size(); ++index) {
        const Side& side = m_sides[index];
        if (index % 2 == 0)
            result.emplace_back();
        if (!std::isfinite(side.best.value))
            continue;
        const double sign = index % 2 == 0 ? -1 : 1;
        (index % 2 == 0 ? result.back().minimum
                        : result.back().maximum) = {sign * side.best.value, sign * std::max(side.bound, side.best.value),
                                                    side.place.element_class, side.place.element, side.best.xi};
    }
    return result;
}

ExtremaSearch::ExtremaSearch(std::span<const Space> spaces, std::uint32_t n_components)
    : m_impl(std::make_unique<Impl>(spaces, n_components)) {}
ExtremaSearch::~ExtremaSearch() = default;
ExtremaSearch::ExtremaSearch(const ExtremaSearch& other) : m_impl(std::make_unique<Impl>(*other.m_impl)) {}
ExtremaSearch::ExtremaSearch(ExtremaSearch&&) noexcept = default;
ExtremaSearch& ExtremaSearch::operator=(ExtremaSearch&&) noexcept = default;

void ExtremaSearch::add(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                        std::span<const double> coefficients) {
    m_impl->add(element_class, first, count, coefficients);
}

std::vector<Extrema> ExtremaSearch::finish(const Read& read) { return m_impl->finish(read); }

std::vector<Extrema> find_extrema(const VolumeSource& reader, std::size_t field, std::size_t time_step) {
    const Description& description = reader.description();
    const std::uint32_t n_components = description.fields[field].n_components;
    std::vector<Space> spaces;
    for (const ElementClass& element_class : description.classes)
        spaces.push_back(element_class.fields[field]);
    ExtremaSearch search(spaces, n_components);
    const ExtremaSearch::Read read = [&](std::size_t element_class, std::uint64_t first, std::uint64_t count,
                                         std::span<double> coefficients) {
        reader.read_field(field, time_step, element_class, first, count, coefficients);
    };
    constexpr std::uint64_t elements_at_once = 4096;
    std::vector<double> coefficients;
    for (std::size_t index = 0; index < description.classes.size(); ++index) {
        const std::uint64_t n_elements = description.classes[index].n_elements;
        for (std::uint64_t first = 0; first < n_elements; first += elements_at_once) {
            const std::uint64_t count = std::min(elements_at_once, n_elements - first);
            coefficients.resize(count * n_components * n_modes(spaces[index]));
            read(index, first, count, coefficients);
            search.add(index, first, count, coefficients);
        }
    }
    return search.finish(read);
}

} // namespace elvis::native
