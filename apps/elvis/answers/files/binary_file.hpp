/**
 * @file binary_file.hpp
 * Numbers as bytes, into a file that appears whole or not at all. Little-endian machines only, which is what the formats want.
 */
#pragma once

#include <core/base/error.hpp>
#include <core/base/output_file.hpp>

#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>

namespace elvis::commands {

class BinaryFile {
public:
    explicit BinaryFile(const std::string& path)
        : m_path(path), m_output(path), m_file(m_output.temporary(), std::ios::binary) {
        static_assert(std::endian::native == std::endian::little);
    }

    void text(std::string_view text) { m_file.write(text.data(), static_cast<std::streamsize>(text.size())); }
    template <class Number> void number(Number number) { m_file.write(reinterpret_cast<const char*>(&number), sizeof number); }
    /** As Number. */
    template <class Number, class Numbers> void numbers(const Numbers& numbers) {
        for (const auto one : numbers) {
            number(static_cast<Number>(one));
        }
    }
    std::ofstream& stream() { return m_file; }

    void commit() {
        m_file.close();
        if (!m_file) {
            throw Error(m_path, std::string("cannot be written: ") + std::strerror(errno));
        }
        m_output.commit();
    }

private:
    std::string m_path;
    OutputFile m_output;
    std::ofstream m_file;
};

} // namespace elvis::commands
