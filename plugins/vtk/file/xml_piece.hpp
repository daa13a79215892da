/**
 * @file xml_piece.hpp
 * The pieces of a .vtu file.
 */
#pragma once

#include "piece.hpp"
#include "xml_file.hpp"

#include <functional>
#include <optional>

namespace elvis_vtk {

/** An element Piece. The file must outlive it. */
class XmlPiece : public Piece {
public:
    XmlPiece(const XmlFile& file, pugi::xml_node node);

    const std::string& path() const override { return m_file.path(); }
    bool declares_old_hexahedra() const override { return !m_file.is_at_least(2, 1); }
    Numbers points() const override;
    PieceCells cells() const override;
    std::vector<FieldArray> arrays(Section section) const override;
    std::string named_by(Section section, const char* attribute) const override;
    std::uint32_t mantissa_bits(Section section, const FieldArray& array) const override;
    std::vector<double> values(Section section, const FieldArray& array) const override;
    [[noreturn]] void fail(Section section, const std::string& what) const override;

private:
    pugi::xml_node child(Section section) const;
    Numbers read(Section section, const FieldArray& array) const;

    const XmlFile& m_file;
    pugi::xml_node m_node;
};

/** Calls visit for every piece that has cells; gives TimeValue of the field data. */
std::optional<double> visit_xml_pieces(const std::string& path, const std::function<void(const Piece&)>& visit);

} // namespace elvis_vtk
