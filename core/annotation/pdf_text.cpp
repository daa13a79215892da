#include <core/annotation/pdf_text.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>

namespace elvis {

namespace {

constexpr std::size_t glyphs_a_font = 255;
/** Glyph space has so many units an em, as most fonts have it. */
constexpr double units = 1000;

std::string in_hex(const char* format, unsigned number) {
    char text[16];
    std::snprintf(text, sizeof text, format, number);
    return text;
}

/** UTF-16, most significant byte first. */
std::string utf16(char32_t character) {
    if (character < 0x10000) {
        return in_hex("%04X", static_cast<unsigned>(character));
    }
    const auto above = static_cast<unsigned>(character) - 0x10000u;
    return in_hex("%04X", 0xD800u + (above >> 10)) + in_hex("%04X", 0xDC00u + (above & 0x3FFu));
}

/** The path of an outline whose points are mapped by `place`. */
template <class Place> std::string path_of(const GlyphOutline& outline, const Place& place) {
    std::string text;
    bool is_open = false;
    for (const GlyphOutline::Step& step : outline.steps) {
        const Point2 first = place(step.points[0]), second = place(step.points[1]), end = place(step.points[2]);
        switch (step.kind) {
        case GlyphOutline::Step::Kind::begin:
            text.append(is_open ? "h " : "").append(pdf_numbers({end[0], end[1]})).append("m ");
            is_open = true;
            break;
        case GlyphOutline::Step::Kind::line:
            text += pdf_numbers({end[0], end[1]}) + "l ";
            break;
        case GlyphOutline::Step::Kind::curve:
            text += pdf_numbers({first[0], first[1], second[0], second[1], end[0], end[1]}) + "c ";
            break;
        }
    }
    return text + (is_open ? "h " : "");
}

/** In units; of no points, all zero. */
std::array<double, 4> box_of_glyph(const GlyphOutline& outline) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::array<double, 4> box{infinity, infinity, -infinity, -infinity};
    for (const GlyphOutline::Step& step : outline.steps) {
        for (std::size_t i = step.kind == GlyphOutline::Step::Kind::curve ? 0 : 2; i < 3; ++i) {
            for (std::size_t axis = 0; axis < 2; ++axis) {
                box[axis] = std::min(box[axis], units * step.points[i][axis]);
                box[axis + 2] = std::max(box[axis + 2], units * step.points[i][axis]);
            }
        }
    }
    return outline.steps.empty() ? std::array<double, 4>{} : box;
}

std::string name_of_font(std::size_t index) { return std::string("/F") + std::to_string(index / glyphs_a_font); }
unsigned code_of(std::size_t index) { return static_cast<unsigned>(index % glyphs_a_font) + 1; }

} // namespace

std::size_t PdfFonts::index_of(const PlacedGlyph& glyph) {
    const auto [known, is_new] = m_index.emplace(Glyph{glyph.outline, glyph.character}, m_glyphs.size());
    if (is_new) {
        m_glyphs.emplace_back(glyph.outline, glyph.character);
    }
    return known->second;
}

std::string PdfFonts::show(const TextLine& line, const Point2& place) {
    std::string text = "BT ";
    // Upwards, or to the right; the text's own y points upwards in both.
    text += line.is_upwards ? pdf_numbers({0, -1, -1, 0, place[0], place[1]}) : pdf_numbers({1, 0, 0, -1, place[0], place[1]});
    text += "Tm";
    std::string font;
    double end = 0;
    for (const PlacedGlyph& glyph : line.glyphs) {
        const std::size_t index = index_of(glyph);
        if (font != name_of_font(index)) {
            text += font.empty() ? "" : "] TJ";
            font = name_of_font(index);
            text.append(" ").append(font).append(" ").append(pdf_numbers({line.size})).append("Tf [");
        }
        // Kerning: by so much the next glyph comes nearer, in thousandths of an em.
        const double nearer = 1000 * (end - glyph.x) / line.size;
        text += std::abs(nearer) > 0.05 ? pdf_numbers({nearer}) : "";
        text += in_hex("<%02X>", code_of(index));
        end = glyph.x + line.size * glyph.outline->advance;
    }
    return text + (font.empty() ? "" : "] TJ") + " ET\n";
}

std::string PdfFonts::write(PdfFile& file) const {
    std::string entries;
    for (std::size_t first = 0; first < m_glyphs.size(); first += glyphs_a_font) {
        const std::size_t end = std::min(first + glyphs_a_font, m_glyphs.size());
        entries += name_of_font(first) + " " + pdf_reference(write_font(file, first, end)) + " ";
    }
    return entries;
}

int PdfFonts::write_font(PdfFile& file, std::size_t first, std::size_t end) const {
    std::string procedures, names, widths, characters;
    std::array<double, 4> around{};
    for (std::size_t index = first; index < end; ++index) {
        const auto& [outline, character] = m_glyphs[index];
        const std::string name = std::string("/g") + std::to_string(code_of(index));
        const std::array<double, 4> box = box_of_glyph(*outline);
        for (std::size_t axis = 0; axis < 2; ++axis) {
            around[axis] = std::min(around[axis], box[axis]);
            around[axis + 2] = std::max(around[axis + 2], box[axis + 2]);
        }
        const std::string drawing = pdf_numbers({units * outline->advance, 0, box[0], box[1], box[2], box[3]}) + "d1 " +
                                    path_of(*outline,
                                            [](const Point2& point) {
                                                return Point2{units * point[0], units * point[1]};
                                            }) +
                                    (outline->steps.empty() ? "" : "f");
        procedures += name + " " + pdf_reference(file.add_stream("", drawing)) + " ";
        names += name;
        widths += pdf_numbers({units * outline->advance});
        characters.append(in_hex("<%02X> <", code_of(index))).append(utf16(character)).append(">\n");
    }
    std::string map = "/CIDInit /ProcSet findresource begin 12 dict begin begincmap /CMapType 2 def /CMapName /ToText def\n"
                      "1 begincodespacerange <00> <FF> endcodespacerange\n";
    // Up to a hundred in each block (Adobe Technical Note 5014).
    std::size_t from = 0;
    for (std::size_t index = first; index < end; index += 100) {
        const std::size_t n = std::min<std::size_t>(100, end - index);
        std::size_t to = from;
        for (std::size_t line = 0; line < n; ++line) {
            to = characters.find('\n', to) + 1;
        }
        map += std::to_string(n) + " beginbfchar\n" + characters.substr(from, to - from) + "endbfchar\n";
        from = to;
    }
    map += "endcmap CMapName currentdict /CMap defineresource pop end end\n";
    std::string font = "<< /Type /Font /Subtype /Type3 /FontMatrix [0.001 0 0 0.001 0 0] /FontBBox [";
    font += pdf_numbers({around[0], around[1], around[2], around[3]}) + "] /CharProcs << " + procedures;
    font += ">> /Encoding << /Type /Encoding /Differences [1 " + names + "] >> /FirstChar 1 /LastChar ";
    font += std::to_string(end - first) + " /Widths [" + widths + "] /Resources << >> /ToUnicode ";
    return file.add(font + pdf_reference(file.add_stream("", map)) + " >>");
}

std::string pdf_outlines(const TextLine& line, const Point2& place) {
    std::string text;
    for (const PlacedGlyph& glyph : line.glyphs) {
        text += path_of(*glyph.outline, [&](const Point2& point) {
            const double along = glyph.x + line.size * point[0], up = line.size * point[1];
            return line.is_upwards ? Point2{place[0] - up, place[1] - along} : Point2{place[0] + along, place[1] - up};
        });
    }
    return text;
}

} // namespace elvis
