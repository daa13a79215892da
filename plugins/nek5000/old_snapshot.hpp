/**
 * @file old_snapshot.hpp
 * One time step in the format before 2006: one file, binary or text, all fields of an element together.
 */
#pragma once

#include "numbers.hpp"
#include "snapshot.hpp"

namespace elvis_nek5000 {

/** Where the numbers are. */
struct OldLayout {
    Content content;
    bool is_text = false;
    ByteFormat format;
    std::uint64_t first_number = 0;
    /** Of a line of text: all fields at a node, and the line's end. */
    std::uint64_t line_size = 0;
};

std::uint32_t probe_old_file(const ByteFile& file);

class OldSnapshot : public Snapshot {
public:
    OldSnapshot(const std::string& path, OpenFiles& files);

    void read(std::size_t block, std::uint64_t element, std::span<double> values) const override;
    /** Text has 7 digits, 23.3 bits. */
    Precision precision() const override { return m_layout.is_text ? Precision{24, 1e-6} : single_precision; }

private:
    OldSnapshot(const std::string& path, OldLayout layout, OpenFiles& files);
    void read_text(std::size_t first_component, std::uint64_t element, std::span<double> values) const;

    OpenFiles& m_files;
    OldLayout m_layout;
};

} // namespace elvis_nek5000
