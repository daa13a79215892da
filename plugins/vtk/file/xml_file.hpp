/**
 * @file xml_file.hpp
 * One XML file of VTK: its document, what the root says about encodings, and the appended data, which are not XML.
 */
#pragma once

#include <elvis/plugin.hpp>

#include <pugixml.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace elvis_vtk {

enum class Compressor { none, zlib, lz4 };

/** How the binary arrays of a file are written. */
struct Encoding {
    bool swap_bytes = false;
    /** Bytes of an integer in the headers of arrays: 4 or 8. */
    std::size_t header_size = 4;
    Compressor compressor = Compressor::none;
};

/** A file in memory. Immutable after construction. */
class XmlFile {
public:
    /** Reads and parses. Throws elvis::api::Error. */
    explicit XmlFile(const std::string& path);
    XmlFile(const XmlFile&) = delete;
    XmlFile& operator=(const XmlFile&) = delete;

    const std::string& path() const { return m_path; }
    /** The element VTKFile. */
    pugi::xml_node root() const { return m_root; }
    /** Its attribute `type`. */
    std::string type() const { return m_root.attribute("type").as_string(); }
    const Encoding& encoding() const { return m_encoding; }
    /** What follows the underscore of AppendedData; empty if there is none. */
    std::string_view appended() const { return m_appended; }
    bool appended_is_base64() const { return m_appended_is_base64; }
    /** Attribute `version`. */
    bool is_at_least(int major, int minor) const;

    /** Throws with file, line and the element's name. */
    [[noreturn]] void fail(pugi::xml_node where, const std::string& what) const;
    /** The child of that name, or a failure. */
    pugi::xml_node child(pugi::xml_node parent, const char* name) const;
    /** An attribute that counts something, or a failure. */
    std::size_t count(pugi::xml_node node, const char* attribute) const;

private:
    void read_root();

    std::string m_path;
    std::string m_content;
    std::string_view m_appended;
    bool m_appended_is_base64 = false;
    pugi::xml_document m_document;
    pugi::xml_node m_root;
    Encoding m_encoding;
    int m_major = 0;
    int m_minor = 0;
};

/** 100 for the types of file that this plugin reads, less for other files of VTK, 0 for others. */
std::uint32_t probe(const char* path);

} // namespace elvis_vtk
