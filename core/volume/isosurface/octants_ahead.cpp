#include <core/volume/isosurface/octants_ahead.hpp>

namespace elvis {

namespace {

/** A device takes hardly longer for so many than for one; 4 MiB are read. */
constexpr std::size_t most_ahead = 1u << 15;

std::uint64_t key_of(std::uint32_t element, std::uint32_t code) { return std::uint64_t{element} << 32u | code; }

} // namespace

std::vector<std::uint32_t> OctantsAhead::with_parts(std::span<const std::uint32_t> elements_and_codes) const {
    std::vector<std::uint32_t> wanted(elements_and_codes.begin(), elements_and_codes.end());
    for (std::size_t level = 0, end = wanted.size(); m_looks_ahead && level < end; level = end, end = wanted.size()) {
        std::vector<std::uint32_t> parts;
        for (std::size_t i = level; i < end && (wanted.size() + parts.size()) / 2 <= most_ahead; i += 2) {
            if (can_divide(wanted[i + 1])) {
                add_octants(parts, wanted[i], wanted[i + 1], m_shape);
            }
        }
        if ((wanted.size() + parts.size()) / 2 <= most_ahead) {
            wanted.insert(wanted.end(), parts.begin(), parts.end());
        }
    }
    return wanted;
}

void OctantsAhead::keep(std::span<const std::uint32_t> elements_and_codes, std::vector<std::uint32_t> words) {
    m_words = std::move(words);
    m_places.clear();
    m_places.reserve(elements_and_codes.size() / 2);
    for (std::size_t i = 0; i < elements_and_codes.size(); i += 2) {
        m_places.emplace(key_of(elements_and_codes[i], elements_and_codes[i + 1]), i / 2);
    }
}

std::vector<std::uint32_t> OctantsAhead::operator()(std::span<const std::uint32_t> elements_and_codes) {
    const auto place_of = [&](std::size_t i) {
        return m_places.find(key_of(elements_and_codes[i], elements_and_codes[i + 1]));
    };
    bool are_known = !elements_and_codes.empty();
    for (std::size_t i = 0; are_known && i < elements_and_codes.size(); i += 2) {
        are_known = place_of(i) != m_places.end();
    }
    if (!are_known) {
        if (!m_looks_ahead) {
            return m_evaluate(elements_and_codes);
        }
        const std::vector<std::uint32_t> wanted = with_parts(elements_and_codes);
        keep(wanted, m_evaluate(wanted));
    }
    std::vector<std::uint32_t> words;
    words.reserve(elements_and_codes.size() / 2 * octant_words);
    for (std::size_t i = 0; i < elements_and_codes.size(); i += 2) {
        const auto begin = m_words.begin() + static_cast<std::ptrdiff_t>(place_of(i)->second * octant_words);
        words.insert(words.end(), begin, begin + octant_words);
    }
    return words;
}

} // namespace elvis
