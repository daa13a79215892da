#include "number_text.hpp"

#include <charconv>
#include <cmath>

namespace nektarpp {

bool NumberText::at_end() {
    m_at = m_text.find_first_not_of(" \t\r\n", m_at);
    m_at = std::min(m_at, m_text.size());
    return m_at == m_text.size();
}

template <class Number> Number NumberText::read(const char* kind) {
    if (at_end()) {
        fail(std::string("there are only ") + std::to_string(m_n_read) + " numbers");
    }
    const char* first = m_text.data() + m_at;
    const char* last = m_text.data() + m_text.size();
    // from_chars knows no leading plus.
    if (*first == '+' && first + 1 < last && first[1] != '-') {
        ++first;
    }
    Number value{};
    const auto [end, error] = std::from_chars(first, last, value);
    if (error != std::errc() || (end != last && std::string_view(" \t\r\n").find(*end) == std::string_view::npos)) {
        constexpr std::size_t longest = 24;
        fail("'" + m_text.substr(m_at, std::min(longest, m_text.find_first_of(" \t\r\n", m_at) - m_at)) + "' is no " + kind);
    }
    m_at = static_cast<std::size_t>(end - m_text.data());
    ++m_n_read;
    return value;
}

double NumberText::real() {
    const auto value = read<double>("number");
    if (!std::isfinite(value)) {
        fail("the number is not finite");
    }
    return value;
}

std::int64_t NumberText::integer() { return read<std::int64_t>("integer"); }

void NumberText::expect_end() {
    if (!at_end()) {
        fail("more than the expected " + std::to_string(m_n_read) + " numbers");
    }
}

void NumberText::fail(const std::string& what) const {
    m_file.fail(m_node, "number " + std::to_string(m_n_read + 1) + ": " + what);
}

} // namespace nektarpp
