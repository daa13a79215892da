#include <core/annotation/font.hpp>
#include <core/annotation/utf8.hpp>
#include <core/base/error.hpp>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_GLYPH_H
#include FT_OUTLINE_H

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

namespace elvis {

namespace {

/** FreeType counts in 64ths of a pixel, and advances by outline in 65536ths. */
constexpr double units_per_pixel = 64;
constexpr double linear_pixel = 65536;

struct LibraryDone {
    void operator()(FT_Library library) const { FT_Done_FreeType(library); }
};
struct FaceDone {
    void operator()(FT_Face face) const { FT_Done_Face(face); }
};
struct GlyphDone {
    void operator()(FT_Glyph glyph) const { FT_Done_Glyph(glyph); }
};
using Glyph = std::unique_ptr<FT_GlyphRec_, GlyphDone>;

std::string cause(FT_Error error) {
    const char* text = FT_Error_String(error);
    return text ? text : "FreeType's error " + std::to_string(error);
}

Mask mask_of(const FT_BitmapGlyph glyph) {
    const FT_Bitmap& bitmap = glyph->bitmap;
    Mask mask = empty_mask(
        {glyph->left, -glyph->top, glyph->left + static_cast<int>(bitmap.width), -glyph->top + static_cast<int>(bitmap.rows)});
    for (std::size_t row = 0; row < bitmap.rows; ++row) {
        const unsigned char* bytes = bitmap.buffer + static_cast<std::ptrdiff_t>(row) * bitmap.pitch;
        for (std::size_t column = 0; column < bitmap.width; ++column) {
            mask.coverage[row * bitmap.width + column] = static_cast<float>(bytes[column]) / 255.0f;
        }
    }
    return mask;
}

/** Collects an outline in units of the font. */
struct OutlineSteps {
    std::vector<GlyphOutline::Step> steps{};
    Point2 at{};

    static Point2 point(const FT_Vector* from) { return {static_cast<double>(from->x), static_cast<double>(from->y)}; }
    static Point2 between(const Point2& a, const Point2& b, double share) {
        return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
    }
    int add(GlyphOutline::Step::Kind kind, const Point2& first, const Point2& second, const Point2& end) {
        steps.push_back({kind, {first, second, end}});
        at = end;
        return 0;
    }
    static int begin(const FT_Vector* to, void* own) {
        return static_cast<OutlineSteps*>(own)->add(GlyphOutline::Step::Kind::begin, {}, {}, point(to));
    }
    static int line(const FT_Vector* to, void* own) {
        return static_cast<OutlineSteps*>(own)->add(GlyphOutline::Step::Kind::line, {}, {}, point(to));
    }
    /** The cubic curve that is the quadratic one. */
    static int conic(const FT_Vector* control, const FT_Vector* to, void* own) {
        auto* const all = static_cast<OutlineSteps*>(own);
        const Point2 middle = point(control), end = point(to);
        return all->add(GlyphOutline::Step::Kind::curve, between(all->at, middle, 2.0 / 3), between(end, middle, 2.0 / 3), end);
    }
    static int cubic(const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* own) {
        return static_cast<OutlineSteps*>(own)->add(GlyphOutline::Step::Kind::curve, point(first), point(second), point(to));
    }
};

} // namespace

struct Font::Impl {
    std::unique_ptr<FT_LibraryRec_, LibraryDone> library;
    std::unique_ptr<FT_FaceRec_, FaceDone> face;
    /** By glyph. */
    std::map<FT_UInt, std::shared_ptr<const GlyphOutline>> outlines{};

    const std::shared_ptr<const GlyphOutline>& outline(FT_UInt glyph) {
        std::shared_ptr<const GlyphOutline>& known = outlines[glyph];
        if (!known) {
            auto made = std::make_shared<GlyphOutline>();
            OutlineSteps all;
            const FT_Outline_Funcs functions = {
                &OutlineSteps::begin, &OutlineSteps::line, &OutlineSteps::conic, &OutlineSteps::cubic, 0, 0};
            if (FT_Load_Glyph(face.get(), glyph, FT_LOAD_NO_SCALE) == 0) {
                FT_Outline_Decompose(&face->glyph->outline, &functions, &all);
                made->advance = static_cast<double>(face->glyph->advance.x) / face->units_per_EM;
            }
            for (GlyphOutline::Step& step : all.steps) {
                for (Point2& point : step.points) {
                    point = {point[0] / face->units_per_EM, point[1] / face->units_per_EM};
                }
            }
            made->steps = std::move(all.steps);
            known = std::move(made);
        }
        return known;
    }

    void set_size(double size) const {
        // At 72 dots per inch a point is a pixel.
        FT_Set_Char_Size(face.get(), 0, std::max<FT_F26Dot6>(1, std::lround(units_per_pixel * size)), 72, 72);
    }

    /** Calls visit(x, character) for every glyph, which is loaded, at its place; returns the end. */
    template <class Visit> double walk(const std::string& text, FT_Int32 flags, const Visit& visit) const {
        double x = 0;
        FT_UInt previous = 0;
        for (char32_t character : decode_utf8(text)) {
            const bool is_control = character < 0x20 || character == 0x7F;
            character = is_control ? U' ' : character;
            const FT_UInt glyph = FT_Get_Char_Index(face.get(), character);
            FT_Vector kerning{};
            if (previous != 0 && FT_Get_Kerning(face.get(), previous, glyph, FT_KERNING_UNFITTED, &kerning) == 0) {
                x += static_cast<double>(kerning.x) / units_per_pixel;
            }
            previous = glyph;
            if (FT_Load_Glyph(face.get(), glyph, flags) != 0) {
                continue;
            }
            visit(x, character);
            x += static_cast<double>(face->glyph->linearHoriAdvance) / linear_pixel;
        }
        return x;
    }
};

Font::Font(const std::string& path) : m_impl(std::make_unique<Impl>()) {
    FT_Library library = nullptr;
    if (const FT_Error error = FT_Init_FreeType(&library)) {
        throw Error("FreeType", cause(error));
    }
    m_impl->library.reset(library);
    std::string chosen = path;
    if (chosen.empty()) {
        std::string list;
        for (const std::string& candidate : default_font_paths()) {
            if (chosen.empty() && std::filesystem::exists(candidate)) {
                chosen = candidate;
            }
            list += "\n  " + candidate;
        }
        if (chosen.empty()) {
            throw Error("annotation", "finds no font: install DejaVu Sans (Debian's fonts-dejavu-core) or name a font file by "
                                      "the key 'font' of image.annotation. Looked for" +
                                          list);
        }
    }
    FT_Face face = nullptr;
    if (const FT_Error error = FT_New_Face(library, chosen.c_str(), 0, &face)) {
        throw Error(chosen, std::filesystem::exists(chosen) ? "cannot be read as a font: " + cause(error)
                                                            : "is no font: there is no such file");
    }
    m_impl->face.reset(face);
    if (!FT_IS_SCALABLE(face)) {
        throw Error(chosen, "has no outlines: annotation needs a font that can be drawn at every size");
    }
}

Font::~Font() = default;

double Font::advance(const std::string& text, double size) const {
    m_impl->set_size(size);
    return m_impl->walk(text, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP, [](double, char32_t) {});
}

Mask Font::text(const std::string& text, double size, bool is_upwards) const {
    m_impl->set_size(size);
    // Light hinting moves outlines to whole rows and leaves columns alone: crisp lines with true spacing. Turned, it would
    // blur.
    const FT_Int32 flags = FT_LOAD_NO_BITMAP | (is_upwards ? FT_LOAD_NO_HINTING : FT_LOAD_TARGET_LIGHT);
    std::vector<Mask> masks;
    std::vector<std::pair<FT_UInt, PlacedGlyph>> glyphs;
    PixelBox box;
    const double advance = m_impl->walk(text, flags, [&](double x, char32_t character) {
        glyphs.push_back({m_impl->face->glyph->glyph_index, {character, x, nullptr}});
        FT_Glyph raw = nullptr;
        if (FT_Get_Glyph(m_impl->face->glyph, &raw) != 0) {
            return;
        }
        Glyph glyph(raw);
        FT_Matrix turn = {0, -0x10000, 0x10000, 0};
        FT_Vector shift = {is_upwards ? 0 : std::lround(units_per_pixel * x),
                           is_upwards ? std::lround(units_per_pixel * x) : 0};
        FT_Glyph_Transform(raw, is_upwards ? &turn : nullptr, &shift);
        raw = glyph.release();
        const FT_Error error = FT_Glyph_To_Bitmap(&raw, FT_RENDER_MODE_NORMAL, nullptr, 1);
        glyph.reset(raw);
        if (error != 0) {
            return;
        }
        masks.push_back(mask_of(reinterpret_cast<FT_BitmapGlyph>(raw)));
        box = united(box, masks.back().box);
    });
    Mask line = empty_mask(box);
    for (const Mask& mask : masks) {
        unite(line, mask);
    }
    const char* const family = m_impl->face->family_name;
    auto own = std::make_shared<TextLine>(
        TextLine{text, family != nullptr ? family : "", size, advance, is_upwards, {-double(box.left), -double(box.top)}});
    for (auto& [glyph, placed] : glyphs) {
        placed.outline = m_impl->outline(glyph);
        own->glyphs.push_back(std::move(placed));
    }
    line.text = std::move(own);
    return line;
}

double Font::digit_height(double size) const {
    m_impl->set_size(size);
    double height = 0;
    m_impl->walk("0", FT_LOAD_NO_BITMAP | FT_LOAD_TARGET_LIGHT, [&](double, char32_t) {
        // With light hinting the top of a digit lies on a whole row.
        height = static_cast<double>(m_impl->face->glyph->metrics.horiBearingY) / units_per_pixel;
    });
    return height;
}

double Font::line_height(double size) const {
    m_impl->set_size(size);
    return size * static_cast<double>(m_impl->face->height) / static_cast<double>(m_impl->face->units_per_EM);
}

} // namespace elvis
