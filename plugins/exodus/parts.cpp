#include "parts.hpp"

#include <algorithm>

namespace elvis_exodus {

namespace {

bool have_same_fields(const std::vector<Field>& first, const std::vector<Field>& second) {
    return std::ranges::equal(first, second, [](const Field& a, const Field& b) {
        return a.name == b.name && a.is_of_elements == b.is_of_elements && a.variables.size() == b.variables.size();
    });
}

} // namespace

Parts::Parts(const std::vector<std::string>& paths, const elvis::api::Host& host) {
    for (const std::string& path : paths) {
        host.check_cancelled();
        add(std::make_unique<const Part>(path, host));
    }
}

void Parts::add(std::unique_ptr<const Part> part) {
    const auto check = [&](bool is_like_first, const char* what) {
        if (!is_like_first) {
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, part->file->path(),
                                    std::string(what) + " those of the first part, " + first().file->path());
        }
    };
    if (!m_parts.empty()) {
        check(part->mesh.dimension() == first().mesh.dimension(), "its elements' dimensions are not");
        check(have_same_fields(part->variables.fields(), first().variables.fields()), "its variables are not");
        check(part->variables.times() == first().variables.times(), "its time steps are not");
    }
    std::vector<std::int32_t>& numbers = m_part_groups.emplace_back();
    for (const std::string& name : part->mesh.groups()) {
        const auto found = std::ranges::find(m_groups, name);
        numbers.push_back(static_cast<std::int32_t>(found - m_groups.begin()));
        if (found == m_groups.end()) {
            m_groups.push_back(name);
        }
    }
    m_mantissa_bits = std::min(m_mantissa_bits, part->mesh.mantissa_bits());
    m_first_elements.push_back(m_first_elements.back() + part->mesh.n_elements());
    m_parts.push_back(std::move(part));
}

Parts::Place Parts::place(std::uint64_t element) const {
    const auto after = std::ranges::upper_bound(m_first_elements, element);
    const auto part = static_cast<std::size_t>(after - m_first_elements.begin()) - 1;
    return {*m_parts[part], element - m_first_elements[part], m_part_groups[part]};
}

} // namespace elvis_exodus
