#include <core/annotation/font.hpp>
#include <core/annotation/utf8.hpp>
#include <core/base/error.hpp>

#include <catch2/catch.hpp>
#include <ft2build.h>
#include FT_FREETYPE_H

#include <cmath>
#include <fstream>

using namespace elvis;

namespace {

/** The font's own numbers, in its units. */
class Metrics {
public:
    Metrics() {
        REQUIRE(FT_Init_FreeType(&m_library) == 0);
        std::string path;
        for (const std::string& candidate : default_font_paths()) {
            if (path.empty() && std::ifstream(candidate)) {
                path = candidate;
            }
        }
        REQUIRE(FT_New_Face(m_library, path.c_str(), 0, &m_face) == 0);
    }
    ~Metrics() {
        FT_Done_Face(m_face);
        FT_Done_FreeType(m_library);
    }
    Metrics(const Metrics&) = delete;
    Metrics& operator=(const Metrics&) = delete;

    const FT_Glyph_Metrics& glyph(char32_t character) const {
        REQUIRE(FT_Load_Char(m_face, character, FT_LOAD_NO_SCALE) == 0);
        return m_face->glyph->metrics;
    }
    double em() const { return m_face->units_per_EM; }

private:
    FT_Library m_library = nullptr;
    FT_Face m_face = nullptr;
};

double total(const Mask& mask) {
    double sum = 0;
    for (const float value : mask.coverage) {
        sum += static_cast<double>(value);
    }
    return sum;
}

} // namespace

TEST_CASE("glyphs lie where the font's metrics say") {
    const Metrics metrics;
    const Font font;
    for (const double size : {13.0, 40.0, 171.3}) {
        for (const char32_t character : std::u32string(U"HgxÄω√")) {
            const FT_Glyph_Metrics glyph = metrics.glyph(character);
            const double scale = size / metrics.em();
            std::string text;
            if (character < 0x80) {
                text = static_cast<char>(character);
            } else if (character < 0x800) {
                text = {static_cast<char>(0xC0 | (character >> 6)), static_cast<char>(0x80 | (character & 0x3F))};
            } else {
                text = {static_cast<char>(0xE0 | (character >> 12)), static_cast<char>(0x80 | ((character >> 6) & 0x3F)),
                        static_cast<char>(0x80 | (character & 0x3F))};
            }
            const PixelBox box = font.text(text, size).box;
            INFO(text << " at " << size);
            const double left = scale * static_cast<double>(glyph.horiBearingX);
            const double top = -scale * static_cast<double>(glyph.horiBearingY);
            const double right = left + scale * static_cast<double>(glyph.width);
            const double bottom = top + scale * static_cast<double>(glyph.height);
            // Columns are not hinted: the ink's pixels are those the outline meets. Hinting moves rows by less than one.
            CHECK(std::abs(box.left - std::floor(left)) <= 1);
            CHECK(std::abs(box.right - std::ceil(right)) <= 1);
            CHECK(std::abs(box.top - top) < 2);
            CHECK(std::abs(box.bottom - bottom) < 2);
            CHECK(font.advance(text, size) == Approx(scale * static_cast<double>(glyph.horiAdvance)).epsilon(1e-3));
        }
    }
}

TEST_CASE("pairs are kerned") {
    const Font font;
    CHECK(font.advance("AV", 100) < font.advance("A", 100) + font.advance("V", 100) - 2);
    CHECK(font.advance("HH", 100) == Approx(2 * font.advance("H", 100)));
}

TEST_CASE("text turned upwards is the text turned") {
    const Font font;
    const PixelBox flat = font.text("Vorticity p", 60).box, turned = font.text("Vorticity p", 60, true).box;
    // Hinting of the flat one moves its rows by up to a pixel.
    CHECK(std::abs(turned.height() - flat.width()) <= 2);
    CHECK(std::abs(turned.width() - flat.height()) <= 3);
    CHECK(std::abs(turned.bottom + flat.left) <= 2);
    CHECK(std::abs(turned.left - flat.top) <= 3);
    CHECK(total(font.text("Vorticity p", 60, true)) == Approx(total(font.text("Vorticity p", 60))).epsilon(0.02));
}

TEST_CASE("texts are UTF-8, and bytes that are not are replaced") {
    CHECK(decode_utf8("aß∂𝛼") == std::u32string(U"aß∂\U0001D6FC"));
    CHECK(decode_utf8("\xC3") == std::u32string(U"\uFFFD"));
    CHECK(decode_utf8("\xFFz") == std::u32string(U"\uFFFDz"));
    CHECK(decode_utf8("\xC0\x80") == std::u32string(U"\uFFFD"));
    CHECK(decode_utf8("\xED\xA0\x80") == std::u32string(U"\uFFFD"));
    CHECK(decode_utf8("\xF4\x90\x80\x80") == std::u32string(U"\uFFFD"));
    CHECK(decode_utf8("\xE2\x88x") == std::u32string(U"\uFFFDx"));
    const Font font;
    // One glyph, not one for each of its bytes.
    CHECK(font.advance("ß", 100) < 1.2 * font.advance("B", 100));
    CHECK(total(font.text("\xFF\xFE\x80", 30)) > 0);
    CHECK(font.text("", 30).box.is_empty());
    CHECK(font.text("   ", 30).box.is_empty());
}

TEST_CASE("a font that cannot be used is refused with its name") {
    CHECK_THROWS_WITH(Font("/no/such/font.ttf"), Catch::Contains("/no/such/font.ttf"));
    const std::string path = "annotation_test_no_font.ttf";
    std::ofstream(path) << "no font at all";
    CHECK_THROWS_WITH(Font(path), Catch::Contains(path) && Catch::Contains("cannot be read as a font"));
    std::remove(path.c_str());
}
