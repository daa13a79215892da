#include "volume.hpp"

#include <elvis/native/extrema.hpp>

#include <algorithm>

namespace elvis::native_plugin {
namespace {

using native::Basis;
using native::Space;
using native::Transform;

/** Elements in a block that evaluation reads at once: small enough for a single probe, large enough for a scan. */
constexpr std::uint64_t elements_per_block = 64;
/** That are read ahead where elements are asked for one after the other: enough for whole chunks of a file. */
constexpr std::uint64_t blocks_ahead = 16;
/** 256 MB of doubles. */
constexpr std::size_t cache_numbers = std::size_t{1} << 25;

/** Highest order that the snippets are compiled for: beyond, unrolled loops take a compiler seconds. */
constexpr std::uint32_t max_device_order = 16;

void check_space(const std::string& path, const Space& space, const std::string& what) {
    const std::uint32_t order = *std::max_element(space.order.begin(), space.order.end());
    if (order > max_device_order)
        throw api::Error(ELVIS_ERROR_UNSUPPORTED, path,
                         what + " has order " + std::to_string(order) + "; this plugin draws orders up to " +
                             std::to_string(max_device_order));
}

} // namespace

api::Error without_name(const native::FileError& error) {
    std::string what = error.what();
    if (what.starts_with(error.file() + ": "))
        what.erase(0, error.file().size() + 2);
    return {ELVIS_ERROR_FORMAT, error.file(), what};
}

Volume::Volume(const api::Host& host, std::string path, std::shared_ptr<const native::VolumeSource> source)
    : m_host(host), m_path(std::move(path)), m_source(std::move(source)), m_cache(cache_numbers) {
    m_first_elements.push_back(0);
    for (std::size_t i = 0; i < description().classes.size(); ++i) {
        const native::ElementClass& element_class = description().classes[i];
        const std::string in_class = " of element class " + std::to_string(i);
        check_space(m_path, element_class.geometry, "the geometry" + in_class);
        if (element_class.geometry.order[0] == 0)
            throw error(ELVIS_ERROR_FORMAT, "the geometry" + in_class + " has order 0, which maps the element to a point");
        for (std::size_t field = 0; field < element_class.fields.size(); ++field)
            check_space(m_path, element_class.fields[field], "field '" + description().fields[field].name + "'" + in_class);
        m_first_elements.push_back(m_first_elements.back() + element_class.n_elements);
    }
    make_constants();
}

template <class Read> void Volume::read_file(Read read) const {
    try {
        read();
    } catch (const native::FileError& failure) {
        throw without_name(failure);
    }
}

Volume::Place Volume::place(std::uint64_t element) const {
    // The last class that starts at or before the element: empty classes start where the next one does.
    const auto after = std::upper_bound(m_first_elements.begin(), m_first_elements.end(), element);
    const auto element_class = static_cast<std::size_t>(after - m_first_elements.begin()) - 1;
    return {element_class, element - m_first_elements[element_class]};
}

void Volume::make_constants() {
    const auto add = [](std::vector<elvis_constant>& list, const char* name, std::int64_t value) {
        list.push_back({sizeof(elvis_constant), 0, name, value});
    };
    const auto add_space = [&add](std::vector<elvis_constant>& list, const std::array<const char*, 7>& names,
                                  const Space& space, std::size_t width) {
        const DeviceSpace device(space);
        add(list, names[0], device.p_max);
        add(list, names[1], device.q_max);
        add(list, names[2], device.r_max);
        add(list, names[3], space.basis == Basis::tensor ? 0 : space.basis == Basis::modified ? 1 : 2);
        add(list, names[4], static_cast<std::int64_t>(device.slab_rows(width)));
        add(list, names[5], static_cast<std::int64_t>(device.n_rows(width)));
        add(list, names[6], static_cast<std::int64_t>(device.n_modes()));
    };
    for (const native::ElementClass& element_class : description().classes)
        for (std::size_t field = 0; field < element_class.fields.size(); ++field) {
            std::vector<elvis_constant> list;
            const Transform transform = description().fields[field].transform;
            add_space(list,
                      {"NATIVE_GEOMETRY_P", "NATIVE_GEOMETRY_Q", "NATIVE_GEOMETRY_R", "NATIVE_GEOMETRY_BASIS",
                       "NATIVE_GEOMETRY_SLAB_ROWS", "NATIVE_GEOMETRY_ROWS", "NATIVE_GEOMETRY_MODES"},
                      element_class.geometry, 3);
            add_space(list,
                      {"NATIVE_FIELD_P", "NATIVE_FIELD_Q", "NATIVE_FIELD_R", "NATIVE_FIELD_BASIS", "NATIVE_FIELD_SLAB_ROWS",
                       "NATIVE_FIELD_ROWS", "NATIVE_FIELD_MODES"},
                      element_class.fields[field], transform == Transform::none ? 1 : 3);
            add(list, "NATIVE_TRANSFORM", static_cast<std::int64_t>(transform));
            m_constants.push_back(std::move(list));
        }
}

std::span<const elvis_constant> Volume::constants(std::size_t element_class, std::size_t field) const {
    return m_constants[element_class * description().fields.size() + field];
}

void Volume::element_numbers(std::uint64_t first, std::span<std::int64_t> numbers) const {
    for_each_run(first, numbers.size(),
                 [&](std::size_t element_class, std::uint64_t local, std::uint64_t count, std::uint64_t offset) {
                     read_file([&] { m_source->read_numbers(element_class, local, count, numbers.subspan(offset, count)); });
                 });
}

std::int64_t Volume::position(std::int64_t number) const {
    if (number < 0)
        return number;
    const auto place = static_cast<std::uint64_t>(number - m_lowest_number);
    if (number < m_lowest_number || place >= m_positions.size() || m_positions[place] < 0)
        throw error(ELVIS_ERROR_FORMAT, "the faces name element " + std::to_string(number) + ", which does not exist");
    return m_positions[place];
}

void Volume::faces(std::uint64_t first, std::span<elvis_face> faces) const {
    if (m_positions.empty()) {
        std::vector<std::int64_t> numbers(n_elements());
        element_numbers(0, numbers);
        // Of a file each of 0 .. n-1 is there once, as its reader makes sure; some of the elements have some of the numbers.
        const auto [lowest, highest] = std::ranges::minmax(numbers);
        m_lowest_number = lowest;
        m_positions.assign(static_cast<std::size_t>(highest - lowest) + 1, -1);
        for (std::size_t i = 0; i < numbers.size(); ++i)
            m_positions[static_cast<std::size_t>(numbers[i] - lowest)] = static_cast<std::int64_t>(i);
    }
    std::vector<native::Face> read(faces.size());
    read_file([&] { m_source->read_faces(first, read.size(), read); });
    for (std::size_t i = 0; i < read.size(); ++i)
        faces[i] = {sizeof(elvis_face),          read[i].group,      position(read[i].element),
                    position(read[i].neighbour), read[i].local_face, read[i].neighbour_local_face};
}

std::vector<native::Extrema> Volume::extrema(std::size_t field, std::size_t time_step) const {
    std::vector<native::Extrema> result;
    if (description().fields[field].transform == Transform::none)
        read_file([&] {
            const std::lock_guard lock(m_extrema_mutex);
            std::vector<native::Extrema>& kept = m_extrema[{field, time_step}];
            if (kept.empty())
                kept = m_source->read_extrema(field, time_step);
            if (kept.empty())
                kept = native::find_extrema(*m_source, field, time_step);
            result = kept;
        });
    return result;
}

void Volume::forget_fields() {
    const std::lock_guard lock(m_extrema_mutex);
    m_cache.clear();
    m_extrema.clear();
}

std::vector<double> Volume::read_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count) const {
    std::vector<double> coefficients(count * 3 * native::n_modes(geometry_space(element_class)));
    read_file([&] { m_source->read_geometry(element_class, first, count, coefficients); });
    return coefficients;
}

std::vector<double> Volume::read_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                                       std::uint64_t count) const {
    const std::size_t n_modes = native::n_modes(field_space(element_class, field));
    std::vector<double> coefficients(count * description().fields[field].n_components * n_modes);
    read_file([&] { m_source->read_field(field, time_step, element_class, first, count, coefficients); });
    return coefficients;
}

Volume::Coefficients Volume::element_geometry(Place place) const {
    const std::uint64_t block = place.local / elements_per_block;
    const std::uint64_t first = block * elements_per_block;
    const std::uint64_t n_left = description().classes[place.element_class].n_elements - first;
    const std::uint64_t count = std::min(elements_per_block, n_left);
    const BlockKey key{-1, 0, place.element_class, block};
    const auto read = [&] {
        const bool is_scan = block > 0 && m_cache.has({-1, 0, place.element_class, block - 1});
        const std::uint64_t n = is_scan ? std::min(blocks_ahead * elements_per_block, n_left) : count;
        std::vector<double> coefficients =
            is_scan ? kept_geometry(place.element_class, first, n) : read_geometry(place.element_class, first, n);
        coefficients.resize(coefficients.size() / n * count);
        return coefficients;
    };
    const auto numbers = m_cache.get(key, read);
    const std::size_t size = numbers->size() / count;
    return {numbers, std::span(*numbers).subspan((place.local - first) * size, size)};
}

std::vector<double> Volume::kept_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count) const {
    std::vector<double> numbers = read_geometry(element_class, first, count);
    const std::size_t size = numbers.size() / count;
    const std::uint64_t n_elements = description().classes[element_class].n_elements, end = first + count;
    for (std::uint64_t block = (first + elements_per_block - 1) / elements_per_block; block * elements_per_block < end;
         ++block) {
        const std::uint64_t from = block * elements_per_block;
        const std::uint64_t n = std::min(elements_per_block, n_elements - from);
        if (from + n <= end)
            m_cache.get({-1, 0, element_class, block}, [&] {
                const auto its = std::span<const double>(numbers).subspan((from - first) * size, n * size);
                return std::vector<double>(its.begin(), its.end());
            });
    }
    return numbers;
}

Volume::Coefficients Volume::element_field(std::size_t field, std::size_t time_step, Place place) const {
    const std::uint64_t block = place.local / elements_per_block;
    const std::uint64_t first = block * elements_per_block;
    const std::uint64_t count = std::min(elements_per_block, description().classes[place.element_class].n_elements - first);
    const auto numbers = m_cache.get({static_cast<std::int64_t>(field), time_step, place.element_class, block},
                                     [&] { return read_field(field, time_step, place.element_class, first, count); });
    const std::size_t size = numbers->size() / count;
    return {numbers, std::span(*numbers).subspan((place.local - first) * size, size)};
}

const Conversion& Volume::conversion(const Space& space) const {
    const std::lock_guard lock(m_conversions_mutex);
    for (const auto& [known, conversion] : m_conversions)
        if (known == space)
            return *conversion;
    m_conversions.emplace_back(space, std::make_unique<const Conversion>(space));
    return *m_conversions.back().second;
}

const native::DerivativeBounder& Volume::derivative_bounder(const Space& space, native::SecondDerivatives second) const {
    const std::lock_guard lock(m_conversions_mutex);
    for (const KnownBounder& known : m_derivative_bounders)
        if (known.space == space && known.second == second)
            return *known.bounder;
    m_derivative_bounders.push_back({space, second, std::make_unique<const native::DerivativeBounder>(space, second)});
    return *m_derivative_bounders.back().bounder;
}

} // namespace elvis::native_plugin
