/**
 * @file pdf_text.hpp
 * Text in a PDF: fonts of the glyphs that are used, and lines set in them.
 */
#pragma once

#include <core/annotation/mask.hpp>
#include <core/annotation/pdf_file.hpp>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace elvis {

/**
 * Glyphs become fonts of type 3 (ISO 32000-1, 9.6.5), which are drawn as their outlines and can be made of any font file; maps
 * to Unicode let readers search and copy the text. A font has 255 glyphs at most: further ones go into a next font.
 */
class PdfFonts {
public:
    /** Operators that show the line, at a place in pixels with y downwards, in the colour of fills. */
    std::string show(const TextLine& line, const Point2& place);

    /** What the operators refer to: entries of a dictionary of fonts. */
    std::string write(PdfFile& file) const;

private:
    /** By outline and character: one glyph may stand for several characters. */
    using Glyph = std::pair<std::shared_ptr<const GlyphOutline>, char32_t>;

    std::size_t index_of(const PlacedGlyph& glyph);
    int write_font(PdfFile& file, std::size_t first, std::size_t end) const;

    std::vector<Glyph> m_glyphs;
    std::map<Glyph, std::size_t> m_index;
};

/** Operators that make the line's outlines the current path. */
std::string pdf_outlines(const TextLine& line, const Point2& place);

} // namespace elvis
