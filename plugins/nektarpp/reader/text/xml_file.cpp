#include "xml_file.hpp"

#include "number_text.hpp"

#include <elvis/plugin.hpp>

#include <cstring>
#include <fstream>

namespace nektarpp {

namespace {

/** Files in HDF5, the other container of Nektar++, begin with these bytes. */
constexpr char hdf5_mark[] = "\x89HDF\r\n\x1a\n";

bool is_hdf5(const std::string& path) {
    char head[8] = {};
    std::ifstream file(path, std::ios::binary);
    return file.read(head, sizeof head) && std::memcmp(head, hdf5_mark, sizeof head) == 0;
}

/** "<TAG ID="7">", as far as there is one. */
std::string name_of(const pugi::xml_node& node) {
    std::string name = std::string("<") + node.name();
    if (const pugi::xml_attribute id = node.attribute("ID")) {
        // Lists of ids can be very long.
        constexpr std::size_t longest = 40;
        const std::string value = id.value();
        name += " ID=\"" + (value.size() <= longest ? value : value.substr(0, longest) + "...") + "\"";
    }
    return name + ">";
}

} // namespace

XmlFile::XmlFile(const std::string& path) : m_path(path) {
    if (is_hdf5(path)) {
        throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, path,
                                "is an HDF5 file; only XML files of Nektar++ can be read (convert it with FieldConvert)");
    }
    const pugi::xml_parse_result result = m_document.load_file(path.c_str());
    if (!result) {
        const bool is_absent = result.status == pugi::status_file_not_found || result.status == pugi::status_io_error;
        throw elvis::api::Error(is_absent ? ELVIS_ERROR_FILE : ELVIS_ERROR_FORMAT, path,
                                is_absent ? std::string("cannot be read")
                                          : "at byte " + std::to_string(result.offset) + ": " + result.description());
    }
    m_root = m_document.child("NEKTAR");
    if (!m_root) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path, "has no root element NEKTAR");
    }
}

void XmlFile::fail(const pugi::xml_node& where, const std::string& what) const {
    throw elvis::api::Error(ELVIS_ERROR_FORMAT, m_path,
                            "at byte " + std::to_string(where.offset_debug()) + ", " + name_of(where) + ": " + what);
}

const char* XmlFile::attribute(const pugi::xml_node& node, const char* name) const {
    const pugi::xml_attribute found = node.attribute(name);
    if (!found) {
        fail(node, std::string("attribute ") + name + " is missing");
    }
    return found.value();
}

std::int64_t XmlFile::integer(const pugi::xml_node& node, const char* name) const {
    NumberText text(*this, node, attribute(node, name));
    const std::int64_t value = text.integer();
    text.expect_end();
    return value;
}

bool XmlFile::is_compressed(const pugi::xml_node& node) const {
    const pugi::xml_attribute compression = node.attribute("COMPRESSED");
    if (!compression) {
        return false;
    }
    if (std::strcmp(compression.value(), "B64Z-LittleEndian") != 0) {
        fail(node, std::string("compression \"") + compression.value() + "\" is not B64Z-LittleEndian");
    }
    if (node.attribute("BITSIZE") && std::strcmp(node.attribute("BITSIZE").value(), "64") != 0) {
        fail(node, std::string("numbers of ") + node.attribute("BITSIZE").value() + " bits; only 64 are supported");
    }
    return true;
}

std::string text_of(const pugi::xml_node& node) {
    std::string text;
    for (const pugi::xml_node& part : node.children()) {
        if (part.type() == pugi::node_pcdata || part.type() == pugi::node_cdata) {
            // A comment between two numbers separates them.
            text += text.empty() ? "" : " ";
            text += part.value();
        }
    }
    return text;
}

bool has_nektar_root(const char* path) noexcept {
    std::ifstream file(path, std::ios::binary);
    char head[4096];
    file.read(head, sizeof head);
    const std::string_view text(head, static_cast<std::size_t>(file.gcount()));
    return text.find("<NEKTAR") != std::string_view::npos;
}

} // namespace nektarpp
