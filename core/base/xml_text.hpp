/**
 * @file xml_text.hpp
 * Text in XML files.
 */
#pragma once

#include <string>

namespace elvis {

/** As it stands between tags, and in attributes. */
inline std::string xml_text(const std::string& text) {
    std::string result;
    for (const char letter : text) {
        switch (letter) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += letter;
        }
    }
    return result;
}

} // namespace elvis
