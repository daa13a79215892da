#include "pictures.hpp"

#include <core/annotation/pdf.hpp>
#include <core/annotation/pdf_text.hpp>

#include <catch2/catch.hpp>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

using namespace elvis;
using namespace elvis::test;

namespace {

std::string inflated(const std::string& bytes) {
    std::string text(bytes.size() * 200 + 1000, '\0');
    uLongf size = text.size();
    REQUIRE(uncompress(reinterpret_cast<Bytef*>(text.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                       bytes.size()) == Z_OK);
    text.resize(size);
    return text;
}

/** What stands between "N 0 obj" and "endobj", found through the table of the file. */
std::string object_of(const std::string& file, int number) {
    std::smatch end;
    const std::string tail = file.substr(file.size() - 100);
    REQUIRE(std::regex_search(tail, end, std::regex("startxref\n([0-9]+)\n%%EOF\n$")));
    const std::size_t table = std::stoul(end[1]);
    REQUIRE(file.compare(table, 7, "xref\n0 ") == 0);
    const std::size_t entries = file.find('\n', table + 5) + 1;
    const std::size_t at = std::stoul(file.substr(entries + 20 * static_cast<std::size_t>(number), 10));
    const std::string head = std::to_string(number) + " 0 obj\n";
    REQUIRE(file.compare(at, head.size(), head) == 0);
    return file.substr(at + head.size(), file.find("\nendobj\n", at) - at - head.size());
}

std::string stream_of(const std::string& object) {
    const std::size_t begin = object.find("stream\n") + 7;
    return inflated(object.substr(begin, object.rfind("\nendstream") - begin));
}

AnnotationRequest one_title(const std::string& text) {
    AnnotationRequest request;
    request.title = text;
    return request;
}

/** Text of all lines, by the font's map from codes to Unicode below U+10000. */
std::u32string read_text(const PdfDrawing& drawing, const PdfFile& file) {
    std::smatch font;
    REQUIRE(std::regex_search(drawing.resources, font, std::regex("/F0 ([0-9]+) 0 R")));
    const std::string whole = file.bytes(1), object = object_of(whole, std::stoi(font[1]));
    std::smatch map;
    REQUIRE(std::regex_search(object, map, std::regex("/ToUnicode ([0-9]+) 0 R")));
    const std::string characters = stream_of(object_of(whole, std::stoi(map[1])));
    std::u32string text;
    const std::regex code("<([0-9A-F]{2})>");
    for (std::sregex_iterator found(drawing.operators.begin(), drawing.operators.end(), code), end; found != end; ++found) {
        std::smatch meaning;
        REQUIRE(std::regex_search(characters, meaning, std::regex("<" + (*found)[1].str() + "> <([0-9A-F]{4})>")));
        text += static_cast<char32_t>(std::stoul(meaning[1], nullptr, 16));
    }
    return text;
}

} // namespace

TEST_CASE("Numbers of PDF have no exponents and no zeros that say nothing") {
    CHECK(pdf_numbers({0, -0.00001, 1.5, -2, 1e-9, 123456.78999, 100}) == "0 0 1.5 -2 0 123456.79 100 ");
}

TEST_CASE("Objects of a PDF lie where its table says, and streams are what was given") {
    PdfFile file;
    const int first = file.add("<< /A 1 >>"), second = file.add_stream("/B 2", "some bytes, some bytes"),
              third = file.add_stream_as_is("/C 3", "as they are");
    const std::string bytes = file.bytes(first);
    CHECK(bytes.starts_with("%PDF-1.5\n"));
    CHECK(object_of(bytes, first) == "<< /A 1 >>");
    CHECK(stream_of(object_of(bytes, second)) == "some bytes, some bytes");
    CHECK(object_of(bytes, third) == "<< /C 3 /Length 11 >>\nstream\nas they are\nendstream");
    CHECK(bytes.find("trailer\n<< /Size 4 /Root 1 0 R >>") != std::string::npos);
}

TEST_CASE("Text in PDF can be read again, whatever characters it has") {
    PdfFile file;
    const PdfDrawing drawing = pdf_drawing(plan_annotation(320, 240, one_title("AVA é 1\xff")), plain(320, 240), file);
    CHECK(read_text(drawing, file) == U"AVA é 1\xFFFD");
    // On white nothing needs a halo, and nothing lets anything through.
    CHECK(drawing.objects.empty());
    CHECK(drawing.resources.find("/ca") == std::string::npos);
}

TEST_CASE("More characters than a font of a PDF has codes for go into further fonts") {
    std::string text;
    for (int i = 0; i < 300; ++i) {
        text += {static_cast<char>(0xC4 + i / 64), static_cast<char>(0x80 + i % 64)}; // From U+0100 on.
    }
    PdfFonts fonts;
    PdfFile file;
    const std::string operators = fonts.show(*Font().text(text, 10).text, {0, 0});
    const std::string resources = fonts.write(file);
    CHECK(operators.find("/F1 10 Tf [") != std::string::npos);
    CHECK(resources.find("/F1 ") != std::string::npos);
    CHECK(resources.find("/F2 ") == std::string::npos);
}

TEST_CASE("Glyphs of a PDF lie where they are painted") {
    // The area between outlines and the x axis, by Green's formula: that of the painted coverage.
    const Font font;
    const Mask mask = font.text("HoB8", 40);
    CHECK(mask.text->glyphs[0].outline->advance == Approx(font.advance("H", 40) / 40).epsilon(1e-4));
    const std::string path = pdf_outlines(*mask.text, {0, 0});
    double area = 0, least = 1e9, most = -1e9;
    std::vector<double> numbers;
    double x = 0, y = 0;
    const auto straight = [&](double to_x, double to_y) {
        area += 0.5 * (x * to_y - to_x * y);
        x = to_x;
        y = to_y;
        least = std::min(least, y);
        most = std::max(most, y);
    };
    double begin_x = 0, begin_y = 0;
    std::istringstream words(path);
    for (std::string word; words >> word;) {
        if (word == "m") {
            begin_x = x = numbers[0];
            begin_y = y = numbers[1];
        } else if (word == "l") {
            straight(numbers[0], numbers[1]);
        } else if (word == "c") {
            const double from_x = x, from_y = y;
            for (int i = 1; i <= 64; ++i) {
                const double t = i / 64.0, s = 1 - t;
                const auto at = [&](double from, std::size_t axis) {
                    return s * s * s * from + 3 * s * s * t * numbers[axis] + 3 * s * t * t * numbers[2 + axis] +
                           t * t * t * numbers[4 + axis];
                };
                straight(at(from_x, 0), at(from_y, 1));
            }
        } else if (word == "h") {
            straight(begin_x, begin_y);
        } else {
            numbers.push_back(std::stod(word));
            continue;
        }
        numbers.clear();
    }
    double covered = 0;
    for (const float part : mask.coverage) {
        covered += static_cast<double>(part);
    }
    // Pictures have outlines hinted to whole rows.
    CHECK(std::abs(area) == Approx(covered).epsilon(0.05));
    CHECK(least == Approx(mask.box.top).margin(1.5));
    CHECK(most == Approx(mask.box.bottom).margin(1.5));
}

TEST_CASE("Colour bars are one image in PDF, and halos one shape") {
    AnnotationRequest request = one_title("p");
    ColorBar bar;
    bar.colors = stepped_table();
    bar.name = "pressure";
    request.color_bars = {bar};
    Frame frame = plain(320, 240);
    for (std::size_t i = 0; i < frame.color.size() / 4; i += 3) {
        std::fill_n(&frame.color[4 * i], 3, 0.05);
    }
    PdfFile file;
    const AnnotationPlan plan = plan_annotation(frame.width, frame.height, request);
    const PdfDrawing drawing = pdf_drawing(plan, frame, file);
    std::smatch image;
    REQUIRE(std::regex_search(drawing.operators, image, std::regex("BI /W 1 /H ([0-9]+) [^\n]* ID\n([0-9A-F]+)>\nEI")));
    const std::size_t n_rows = std::stoul(image[1]);
    CHECK(n_rows > 100);
    CHECK(image[2].length() == static_cast<std::ptrdiff_t>(6 * n_rows));
    CHECK(drawing.resources.find("/A800 << /ca 0.8 >>") != std::string::npos);
    CHECK(drawing.objects.find("/H0 ") != std::string::npos);
    CHECK(drawing.operators.find("/A800 gs /H0 Do") != std::string::npos);
}
