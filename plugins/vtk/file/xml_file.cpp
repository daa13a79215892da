#include "xml_file.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <fstream>

namespace elvis_vtk {

namespace {

std::string read_all(const std::string& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : -1;
    // A folder opens, and has no sensible size.
    if (size < 0 || size > std::streamoff(1) << 46) {
        throw elvis::api::Error(ELVIS_ERROR_FILE, path, "cannot be opened");
    }
    std::string content(static_cast<std::size_t>(size), '\0');
    file.seekg(0);
    if (!file.read(content.data(), size)) {
        throw elvis::api::Error(ELVIS_ERROR_FILE, path, "cannot be read");
    }
    return content;
}

std::size_t line_of(std::string_view content, std::ptrdiff_t offset) {
    const std::size_t end = std::min(content.size(), static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
    return 1 + static_cast<std::size_t>(std::count(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
}

} // namespace

XmlFile::XmlFile(const std::string& path) : m_path(path), m_content(read_all(path)) {
    // Raw appended data may hold any byte: they are cut out, and what is left is XML.
    std::string xml;
    const std::size_t tag = m_content.find("<AppendedData");
    if (tag != std::string::npos) {
        const std::size_t tag_end = m_content.find('>', tag);
        const std::size_t first = tag_end == std::string::npos ? tag_end : m_content.find('_', tag_end);
        const std::size_t last = m_content.rfind("</AppendedData");
        if (first == std::string::npos || last == std::string::npos || last <= first) {
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, path,
                                    "line " + std::to_string(line_of(m_content, static_cast<std::ptrdiff_t>(tag))) +
                                        ": AppendedData without its underscore or without its end: the file is not complete");
        }
        m_appended = std::string_view(m_content).substr(first + 1, last - first - 1);
        xml = m_content.substr(0, tag_end + 1) + m_content.substr(last);
    }
    const std::string& text = tag == std::string::npos ? m_content : xml;
    const pugi::xml_parse_result result = m_document.load_buffer(text.data(), text.size());
    if (!result) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path,
                                "line " + std::to_string(line_of(text, result.offset)) + ": not XML: " + result.description());
    }
    m_root = m_document.child("VTKFile");
    if (!m_root) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path, "has no element VTKFile");
    }
    read_root();
}

void XmlFile::read_root() {
    const std::string order = m_root.attribute("byte_order").as_string("LittleEndian");
    if (order != "LittleEndian" && order != "BigEndian") {
        fail(m_root, "byte_order is '" + order + "', neither LittleEndian nor BigEndian");
    }
    m_encoding.swap_bytes = (order == "BigEndian") != (std::endian::native == std::endian::big);

    const std::string header = m_root.attribute("header_type").as_string("UInt32");
    if (header != "UInt32" && header != "UInt64") {
        fail(m_root, "header_type is '" + header + "', neither UInt32 nor UInt64");
    }
    m_encoding.header_size = header == "UInt64" ? 8 : 4;

    const std::string compressor = m_root.attribute("compressor").as_string();
    if (compressor == "vtkZLibDataCompressor") {
        m_encoding.compressor = Compressor::zlib;
    } else if (compressor == "vtkLZ4DataCompressor") {
        m_encoding.compressor = Compressor::lz4;
    } else if (!compressor.empty()) {
        fail(m_root, "compressor '" + compressor + "' is not supported (vtkZLibDataCompressor and vtkLZ4DataCompressor are)");
    }

    const std::string version = m_root.attribute("version").as_string("0.1");
    const char* const end = version.data() + version.size();
    const auto [dot, error] = std::from_chars(version.data(), end, m_major);
    if (error != std::errc{} || dot == end || *dot != '.' || std::from_chars(dot + 1, end, m_minor).ec != std::errc{}) {
        fail(m_root, "version is '" + version + "', not two numbers");
    }

    const std::string encoding = m_root.child("AppendedData").attribute("encoding").as_string("base64");
    if (encoding != "raw" && encoding != "base64") {
        fail(m_root.child("AppendedData"), "encoding is '" + encoding + "', neither raw nor base64");
    }
    m_appended_is_base64 = encoding == "base64";
}

bool XmlFile::is_at_least(int major, int minor) const { return m_major > major || (m_major == major && m_minor >= minor); }

void XmlFile::fail(pugi::xml_node where, const std::string& what) const {
    std::string name = where.name();
    if (const char* label = where.attribute("Name").as_string(nullptr)) {
        name += " '" + std::string(label) + "'";
    }
    throw elvis::api::Error(ELVIS_ERROR_FORMAT, m_path,
                            "line " + std::to_string(line_of(m_content, where.offset_debug())) + ", " + name + ": " + what);
}

pugi::xml_node XmlFile::child(pugi::xml_node parent, const char* name) const {
    const pugi::xml_node found = parent.child(name);
    if (!found) {
        fail(parent, "has no element " + std::string(name));
    }
    return found;
}

std::size_t XmlFile::count(pugi::xml_node node, const char* attribute) const {
    const std::string_view text = node.attribute(attribute).as_string();
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) {
        fail(node, std::string(attribute) + " is '" + std::string(text) + "', not a number of things");
    }
    return value;
}

std::uint32_t probe(const char* path) {
    std::ifstream file(path, std::ios::binary);
    std::string head(2048, '\0');
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
    const std::size_t root = head.find("<VTKFile");
    if (root == std::string::npos) {
        return 0;
    }
    const std::string tag = head.substr(root, head.find('>', root) - root);
    // Files of other types are recognized to be refused with a reason.
    return tag.find("UnstructuredGrid\"") != std::string::npos || tag.find("\"Collection\"") != std::string::npos ? 100 : 50;
}

} // namespace elvis_vtk
