#include "file.hpp"

#include <text/lines.hpp>

namespace elvis::analytic {

namespace {

using text::Lines;

constexpr const char* header = "elvis-analytic";

Term read_term(Lines& lines, std::uint32_t n_components) {
    Term term;
    term.component = static_cast<std::uint32_t>(lines.count("the component", 0, n_components - 1));
    const std::string kind = lines.word("the kind of term");
    if (kind != "sine" && kind != "gaussian" && kind != "pole") {
        lines.fail("unknown term '" + kind + "'; known are sine, gaussian and pole");
    }
    term.kind = kind == "sine" ? Kind::sine : kind == "gaussian" ? Kind::gaussian : Kind::pole;
    term.amplitude = lines.number<double>("amplitude");
    for (std::size_t i = 0; i < (term.kind == Kind::pole ? 3u : 4u); ++i) {
        term.parameters[i] = lines.number<double>("parameter of the term");
    }
    if (term.kind == Kind::gaussian && !(term.parameters[3] > 0)) {
        lines.fail("the width of a Gaussian must be positive");
    }
    return term;
}

} // namespace

bool has_our_header(const char* path) { return text::begins_with(path, header); }

File read_file(const std::string& path) {
    Lines lines(path);
    lines.header(header);
    File file;
    while (lines.next()) {
        const std::string keyword = lines.word("a keyword");
        if (keyword == "field") {
            Field field;
            field.name = lines.new_name("field", file.fields);
            field.n_components = static_cast<std::uint32_t>(lines.count("the number of components", 1, 16));
            field.unit = lines.at_end() ? "" : lines.word("the unit");
            file.fields.push_back(field);
        } else if (keyword == "term") {
            if (file.fields.empty()) {
                lines.fail("a term before any field");
            }
            file.fields.back().terms.push_back(read_term(lines, file.fields.back().n_components));
        } else if (keyword == "vertex") {
            auto& vertex = file.vertices.emplace_back();
            for (double& coordinate : vertex) {
                coordinate = lines.number<double>("coordinate");
            }
        } else if (keyword == "hexahedron") {
            auto& corners = file.hexahedra.emplace_back();
            for (std::uint32_t& corner : corners) {
                const auto vertex = lines.number<std::int64_t>("corner");
                if (vertex < 0 || vertex >= static_cast<std::int64_t>(file.vertices.size())) {
                    lines.fail("there is no vertex " + std::to_string(vertex) + " above this line");
                }
                corner = static_cast<std::uint32_t>(vertex);
            }
        } else {
            lines.fail("unknown keyword '" + keyword + "'; known are field, term, vertex and hexahedron");
        }
        lines.end();
    }
    return file;
}

} // namespace elvis::analytic
