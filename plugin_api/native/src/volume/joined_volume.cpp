#include <elvis/native/joined_volume.hpp>

#include "../basis/space_change.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace elvis::native {

namespace {

/** Elements that are compared at once. */
constexpr std::uint64_t block = 4096;

std::string count_of(std::uint64_t n, const char* what) { return std::to_string(n) + " " + what + (n == 1 ? "" : "s"); }

/** The geometry of some elements of a class, in a space that holds it. */
std::vector<double> geometry_in(const Space& space, const VolumeSource& source, std::size_t element_class, std::uint64_t first,
                                std::uint64_t count) {
    const Space& own = source.description().classes[element_class].geometry;
    const std::size_t n_own = n_modes(own), n = n_modes(space);
    std::vector<double> read(3 * n_own * count), changed(3 * n * count);
    source.read_geometry(element_class, first, count, read);
    const SpaceChange change(own, space);
    for (std::size_t row = 0; row < 3 * count; ++row)
        change.add(std::span(read).subspan(row * n_own, n_own), 1, std::span(changed).subspan(row * n, n));
    return changed;
}

/** Throws std::invalid_argument if elements of a class are elsewhere. */
void check_geometry(const VolumeSource& source, const VolumeSource& other, std::size_t element_class) {
    const ElementClass& ours = source.description().classes[element_class];
    const Space space = common_space(ours.geometry, other.description().classes[element_class].geometry);
    const std::size_t n_coefficients = 3 * n_modes(space);
    for (std::uint64_t first = 0; first < ours.n_elements; first += block) {
        const std::uint64_t count = std::min(block, ours.n_elements - first);
        const std::vector<double> one = geometry_in(space, source, element_class, first, count);
        const std::vector<double> two = geometry_in(space, other, element_class, first, count);
        double largest = 0;
        for (const double coefficient : one)
            largest = std::max(largest, std::abs(coefficient));
        for (std::size_t i = 0; i < one.size(); ++i) {
            const double difference = std::abs(one[i] - two[i]);
            if (difference <= JoinedVolume::same_geometry * largest)
                continue;
            std::int64_t number = 0;
            source.read_numbers(element_class, first + i / n_coefficients, 1, std::span(&number, 1));
            std::ostringstream text;
            text << "has other elements: element " << number
                 << " is not where it is here (coefficients of its mapping differ by " << difference << ")";
            throw std::invalid_argument(text.str());
        }
    }
}

void check_elements(const VolumeSource& source, const VolumeSource& other) {
    const Description &here = source.description(), &there = other.description();
    if (here.dimension != there.dimension)
        throw std::invalid_argument("has " + std::to_string(there.dimension) + " dimensions, not " +
                                    std::to_string(here.dimension));
    if (here.n_elements() != there.n_elements())
        throw std::invalid_argument("has other elements: " + count_of(there.n_elements(), "element") + ", not " +
                                    std::to_string(here.n_elements()));
    const auto is_same = [](const ElementClass& a, const ElementClass& b) {
        return a.geometry.shape == b.geometry.shape && a.n_elements == b.n_elements;
    };
    if (!std::ranges::equal(here.classes, there.classes, is_same))
        throw std::invalid_argument("has its elements in other classes: other shapes, or orders that differ in other elements");
    for (std::size_t element_class = 0; element_class < here.classes.size(); ++element_class)
        check_geometry(source, other, element_class);
}

void check_time_steps(const Description& here, const Joined& joined) {
    const std::size_t n = joined.source->description().times.size();
    if (joined.time_step && *joined.time_step >= n)
        throw std::invalid_argument("has " + count_of(n, "time step") + ", no time step " + std::to_string(*joined.time_step));
    if (!joined.time_step && n != 1 && n != here.times.size())
        throw std::invalid_argument("has " + count_of(n, "time step") + ", not " + std::to_string(here.times.size()) +
                                    ": which one is meant must be said");
}

/** Runs a check; what it throws gets the name of the joined volume. */
template <class Check> void named(const std::string& name, const Check& check) {
    try {
        check();
    } catch (const std::invalid_argument& reason) {
        throw std::invalid_argument("'" + name + "' " + reason.what());
    }
}

} // namespace

/** From both fields' spaces to that of the difference, by class. */
struct JoinedVolume::Changes {
    std::vector<SpaceChange> from, less;
};

JoinedVolume::JoinedVolume(std::shared_ptr<const VolumeSource> source, std::vector<Joined> others)
    : m_source(std::move(source)), m_others(std::move(others)), m_description(m_source->description()) {
    for (std::size_t field = 0; field < m_description.fields.size(); ++field)
        m_columns.push_back({{field, nullptr}, std::nullopt, nullptr});
    for (const Joined& joined : m_others) {
        const auto has_name = [&](const Joined& other) { return other.name == joined.name; };
        named(joined.name, [&] {
            if (!is_name(joined.name))
                throw std::invalid_argument("is no name: letters, digits and _, no digit first");
            if (std::ranges::count_if(m_others, has_name) > 1)
                throw std::invalid_argument("is joined twice");
            check_time_steps(m_source->description(), joined);
            if (joined.source != m_source)
                check_elements(*m_source, *joined.source);
        });
    }
    for (const Joined& joined : m_others)
        add_fields(joined);
    for (const Joined& joined : m_others)
        add_differences(joined);
}

JoinedVolume::~JoinedVolume() = default;

bool JoinedVolume::is_name(const std::string& name) {
    const auto is_letter = [](unsigned char c) { return std::isalpha(c) != 0 || c == '_'; };
    return !name.empty() && is_letter(static_cast<unsigned char>(name.front())) &&
           std::ranges::all_of(name, [&](unsigned char c) { return is_letter(c) || std::isdigit(c) != 0; });
}

bool JoinedVolume::has_same_elements(const VolumeSource& source, const VolumeSource& other) {
    try {
        check_elements(source, other);
        return true;
    } catch (const std::invalid_argument&) {
        return false;
    }
}

void JoinedVolume::add_fields(const Joined& joined) {
    const Description& theirs = joined.source->description();
    for (std::size_t field = 0; field < theirs.fields.size(); ++field) {
        m_columns.push_back({{field, &joined}, std::nullopt, nullptr});
        m_description.fields.push_back(theirs.fields[field]);
        m_description.fields.back().name = joined.name + "." + theirs.fields[field].name;
        for (std::size_t of = 0; of < theirs.classes.size(); ++of)
            m_description.classes[of].fields.push_back(theirs.classes[of].fields[field]);
    }
}

void JoinedVolume::add_differences(const Joined& joined) {
    const Description &ours = m_source->description(), &theirs = joined.source->description();
    for (std::size_t field = 0; field < ours.fields.size(); ++field) {
        const Field& own = ours.fields[field];
        const auto is_same = [&](const Field& other) {
            return other.name == own.name && other.n_components == own.n_components && other.transform == own.transform;
        };
        const auto found = std::ranges::find_if(theirs.fields, is_same);
        if (found == theirs.fields.end())
            continue;
        const auto other = static_cast<std::size_t>(found - theirs.fields.begin());
        auto changes = std::make_shared<Changes>();
        for (std::size_t of = 0; of < ours.classes.size(); ++of) {
            const Space &one = ours.classes[of].fields[field], &two = theirs.classes[of].fields[other];
            const Space space = common_space(one, two);
            changes->from.emplace_back(one, space);
            changes->less.emplace_back(two, space);
            m_description.classes[of].fields.push_back(space);
        }
        const bool is_continuous = own.continuity == Continuity::continuous && found->continuity == Continuity::continuous;
        Field difference = own;
        difference.name = own.name + " - " + joined.name + "." + own.name;
        difference.continuity = is_continuous ? Continuity::continuous : Continuity::unknown;
        difference.max_jump = std::numeric_limits<double>::quiet_NaN();
        m_description.fields.push_back(difference);
        m_columns.push_back({{field, nullptr}, Place{other, &joined}, std::move(changes)});
    }
}

const VolumeSource& JoinedVolume::source_of(const Place& place) const {
    return place.joined != nullptr ? *place.joined->source : *m_source;
}

std::size_t JoinedVolume::step_of(const Place& place, std::size_t time_step) const {
    const bool has_one = source_of(place).description().times.size() == 1;
    return place.joined != nullptr ? place.joined->time_step.value_or(has_one ? 0 : time_step) : time_step;
}

void JoinedVolume::read_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                                 std::span<double> coefficients) const {
    m_source->read_geometry(element_class, first, count, coefficients);
}

void JoinedVolume::read(const Place& place, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                        std::uint64_t count, std::span<double> coefficients) const {
    source_of(place).read_field(place.field, step_of(place, time_step), element_class, first, count, coefficients);
}

void JoinedVolume::read_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                              std::uint64_t count, std::span<double> coefficients) const {
    const Column& column = m_columns[field];
    if (!column.less) {
        read(column.place, time_step, element_class, first, count, coefficients);
        return;
    }
    const std::size_t n_rows = m_description.fields[field].n_components * count;
    const std::size_t n_after = n_modes(m_description.classes[element_class].fields[field]);
    std::ranges::fill(coefficients, 0.0);
    const auto add = [&](const Place& place, const SpaceChange& change, double scale) {
        const std::size_t n = n_modes(source_of(place).description().classes[element_class].fields[place.field]);
        std::vector<double> numbers(n_rows * n);
        read(place, time_step, element_class, first, count, numbers);
        for (std::size_t row = 0; row < n_rows; ++row)
            change.add(std::span(numbers).subspan(row * n, n), scale, coefficients.subspan(row * n_after, n_after));
    };
    add(column.place, column.changes->from[element_class], 1);
    add(*column.less, column.changes->less[element_class], -1);
}

void JoinedVolume::read_numbers(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                                std::span<std::int64_t> numbers) const {
    m_source->read_numbers(element_class, first, count, numbers);
}

void JoinedVolume::read_faces(std::uint64_t first, std::uint64_t count, std::span<Face> faces) const {
    m_source->read_faces(first, count, faces);
}

std::vector<Extrema> JoinedVolume::read_extrema(std::size_t field, std::size_t time_step) const {
    const Place& place = m_columns[field].place;
    return m_columns[field].less ? std::vector<Extrema>()
                                 : source_of(place).read_extrema(place.field, step_of(place, time_step));
}

void JoinedVolume::read_parts(std::uint64_t first, std::span<std::uint32_t> parts) const { m_source->read_parts(first, parts); }

} // namespace elvis::native
