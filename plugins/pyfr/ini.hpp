/**
 * @file ini.hpp
 * The INI texts in which PyFR keeps the configuration and the statistics of a run.
 */
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace elvis_pyfr {

class Ini {
public:
    /** Lines that are none of an INI file are passed over. */
    explicit Ini(const std::string& text);

    /** The value; lines that continue it are separated by '\n'. */
    std::optional<std::string> find(const std::string& section, const std::string& key) const;

private:
    std::map<std::pair<std::string, std::string>, std::string> m_values;
};

/** Parts of a text between separators, without blanks around them. */
std::vector<std::string> split(const std::string& text, char separator);

} // namespace elvis_pyfr
