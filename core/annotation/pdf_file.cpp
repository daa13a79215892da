#include <core/annotation/pdf_file.hpp>

#include <zlib.h>

#include <cstdio>
#include <stdexcept>
#include <utility>

namespace elvis {

int PdfFile::add(std::string object) {
    m_objects.push_back(std::move(object));
    return static_cast<int>(m_objects.size());
}

int PdfFile::add_stream(const std::string& dictionary, std::string_view bytes) {
    return add_stream_as_is(dictionary + " /Filter /FlateDecode", deflated(bytes));
}

int PdfFile::add_stream_as_is(const std::string& dictionary, std::string_view bytes) {
    std::string object = "<< " + dictionary;
    object.append(" /Length ").append(std::to_string(bytes.size())).append(" >>\nstream\n");
    return add(object.append(bytes).append("\nendstream"));
}

std::string PdfFile::bytes(int catalog) const {
    // A comment with bytes above 127 tells programs that the file is not text.
    std::string file = "%PDF-1.5\n%\xC3\xA9\xC3\xA9\n";
    std::string table;
    for (std::size_t index = 0; index < m_objects.size(); ++index) {
        char entry[32];
        std::snprintf(entry, sizeof entry, "%010zu 00000 n \n", file.size());
        table += entry;
        file.append(std::to_string(index + 1)).append(" 0 obj\n").append(m_objects[index]).append("\nendobj\n");
    }
    const std::string size = std::to_string(m_objects.size() + 1), begin = std::to_string(file.size());
    file.append("xref\n0 ").append(size).append("\n0000000000 65535 f \n").append(table);
    file.append("trailer\n<< /Size ").append(size).append(" /Root ").append(pdf_reference(catalog)).append(" >>\nstartxref\n");
    return file.append(begin).append("\n%%EOF\n");
}

std::string pdf_numbers(std::initializer_list<double> numbers) {
    std::string all;
    for (const double number : numbers) {
        char digits[64];
        std::snprintf(digits, sizeof digits, "%.4f", number);
        std::string text = digits;
        text.erase(text.find_last_not_of('0') + 1);
        text.erase(text.find_last_not_of('.') + 1);
        all.append(text == "-0" || text.empty() ? "0" : text).append(" ");
    }
    return all;
}

std::string pdf_reference(int object) { return std::to_string(object) + " 0 R"; }

std::string deflated(std::string_view bytes) {
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::string packed(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                  static_cast<uLong>(bytes.size()), Z_BEST_COMPRESSION) != Z_OK) {
        throw std::bad_alloc();
    }
    packed.resize(size);
    return packed;
}

} // namespace elvis
