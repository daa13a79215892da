/**
 * @file utf8.hpp
 * Characters of a text.
 */
#pragma once

#include <string>
#include <string_view>

namespace elvis {

/** Decodes UTF-8; what is not valid (cut off, overlong, a surrogate, beyond U+10FFFF) becomes U+FFFD, never an error. */
std::u32string decode_utf8(std::string_view text);

/** The inverse. Characters are not above U+10FFFF. */
std::string encode_utf8(std::u32string_view text);

} // namespace elvis
