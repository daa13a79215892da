#include "file.hpp"

#include <text/lines.hpp>

#include <cmath>

namespace elvis::lattice {

namespace {

using text::Lines;

constexpr const char* header = "elvis-lattice";
/** Of elements: hosts count them with 32 bits. */
constexpr std::uint64_t most_elements = 4000000000;

Point read_point(Lines& lines, const std::string& what) {
    Point point{};
    for (double& coordinate : point) {
        coordinate = lines.number<double>(what);
    }
    return point;
}

void read_box(Lines& lines, Description& description) {
    description.lower = read_point(lines, "a corner of the box");
    description.upper = read_point(lines, "a corner of the box");
    for (std::size_t d = 0; d < 3; ++d) {
        if (!(description.lower[d] < description.upper[d])) {
            lines.fail("the box's second corner is not above its first");
        }
    }
}

void read_counts(Lines& lines, Description& description) {
    std::uint64_t n_elements = 1;
    for (std::uint64_t& count : description.counts) {
        count = static_cast<std::uint64_t>(lines.count("elements in a direction", 1, 1000000));
        if (count > most_elements / n_elements) {
            lines.fail("more than " + std::to_string(most_elements) + " elements");
        }
        n_elements *= count;
    }
}

void read_field(Lines& lines, Description& description) {
    Wave field;
    field.name = lines.new_name("field", description.fields);
    field.periods = read_point(lines, "periods over the box");
    field.amplitude = lines.number<double>("the amplitude");
    field.unit = lines.at_end() ? "" : lines.word("the unit");
    description.fields.push_back(field);
}

} // namespace

bool has_our_header(const char* path) { return text::begins_with(path, header); }

Description read_file(const std::string& path) {
    Lines lines(path);
    lines.header(header);
    Description description;
    while (lines.next()) {
        const std::string keyword = lines.word("a keyword");
        if (keyword == "box") {
            read_box(lines, description);
        } else if (keyword == "elements") {
            read_counts(lines, description);
        } else if (keyword == "moved") {
            description.moved = lines.number<double>("how far vertices are moved");
            if (!(std::abs(description.moved) < 0.25)) {
                lines.fail("vertices are moved by a share of an element's sides, which is to be below 0.25");
            }
        } else if (keyword == "field") {
            read_field(lines, description);
        } else {
            lines.fail("unknown keyword '" + keyword + "'; known are box, elements, moved and field");
        }
        lines.end();
    }
    if (description.fields.empty()) {
        lines.fail("there is no field");
    }
    return description;
}

} // namespace elvis::lattice
