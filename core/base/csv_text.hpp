/**
 * @file csv_text.hpp
 * Parts of comma-separated values (RFC 4180).
 */
#pragma once

#include <string>

namespace elvis {

/** A name; in quotes if it has commas, quotes or line ends. */
std::string csv_name(const std::string& name);

/** Appends a comma and the number, in as few digits as give the same number again; nothing but the comma if it is not finite.
 */
void append_csv_number(std::string& row, double number);

} // namespace elvis
