/**
 * @file number_text.hpp
 * Numbers separated by blanks in the text of an XML node.
 */
#pragma once

#include "xml_file.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace nektarpp {

/** Reads front to back. Errors name the node and the number's place in the text. The file must outlive it. */
class NumberText {
public:
    NumberText(const XmlFile& file, const pugi::xml_node& node) : NumberText(file, node, text_of(node)) {}
    NumberText(const XmlFile& file, const pugi::xml_node& node, std::string text)
        : m_file(file), m_node(node), m_text(std::move(text)) {}

    /** Skips blanks. */
    bool at_end();
    /** A finite number. */
    double real();
    std::int64_t integer();
    void expect_end();

private:
    template <class Number> Number read(const char* kind);
    [[noreturn]] void fail(const std::string& what) const;

    const XmlFile& m_file;
    pugi::xml_node m_node;
    std::string m_text;
    std::size_t m_at = 0;
    std::size_t m_n_read = 0;
};

} // namespace nektarpp
