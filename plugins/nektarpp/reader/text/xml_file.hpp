/**
 * @file xml_file.hpp
 * An XML file of Nektar++ in memory, and errors that say where in it something is wrong.
 */
#pragma once

#include <pugixml.hpp>

#include <cstdint>
#include <string>

namespace nektarpp {

class XmlFile {
public:
    /** Throws elvis::api::Error if the file cannot be read or is no XML with the root NEKTAR. */
    explicit XmlFile(const std::string& path);

    const std::string& path() const { return m_path; }
    pugi::xml_node root() const { return m_root; }

    /** Throws elvis::api::Error with the byte and the tag of `where`. */
    [[noreturn]] void fail(const pugi::xml_node& where, const std::string& what) const;

    /** Value of an attribute; an error if it is missing. */
    const char* attribute(const pugi::xml_node& node, const char* name) const;
    /** The same for an integer. */
    std::int64_t integer(const pugi::xml_node& node, const char* name) const;

    /**
     * Whether a node's content is said to be compressed, by its attributes COMPRESSED and BITSIZE; an error for any other
     * compression than base64 of zlib, little endian, 64 bits.
     */
    bool is_compressed(const pugi::xml_node& node) const;

private:
    std::string m_path;
    pugi::xml_document m_document;
    pugi::xml_node m_root;
};

/** The text inside a node, comments left out. */
std::string text_of(const pugi::xml_node& node);

/** Whether a file begins like a Nektar++ file: XML with the root NEKTAR. Reads at most 4 KiB; never throws. */
bool has_nektar_root(const char* path) noexcept;

} // namespace nektarpp
