/**
 * @file pdf_file.hpp
 * The frame of a PDF file: numbered objects, streams, and where they lie (ISO 32000-1, 7.3 and 7.5).
 */
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace elvis {

class PdfFile {
public:
    /** Objects are known by numbers from 1 on. `object`: what stands between obj and endobj. */
    int add(std::string object);
    /** Compressed here. `dictionary`: its entries but for length and filter. */
    int add_stream(const std::string& dictionary, std::string_view bytes);
    /** Bytes that are as the dictionary says. */
    int add_stream_as_is(const std::string& dictionary, std::string_view bytes);

    /** The whole file; `catalog` is the object from which everything is reached. */
    std::string bytes(int catalog) const;

private:
    std::vector<std::string> m_objects;
};

/** With four digits behind the point at most, and a blank after each. PDF knows no exponents. */
std::string pdf_numbers(std::initializer_list<double> numbers);

/** "7 0 R" */
std::string pdf_reference(int object);

/** By zlib. */
std::string deflated(std::string_view bytes);

} // namespace elvis
