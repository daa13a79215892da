// Names in records of fixed size.
#pragma once

#include <algorithm>
#include <string>

namespace elvis_cgns {

/** The text before its first zero, without blanks at its end. */
inline std::string trimmed(std::string text) {
    text.resize(std::min(text.find('\0'), text.size()));
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
}

} // namespace elvis_cgns
