#include "file.hpp"

#include <elvis/plugin.hpp>

#include <fstream>
#include <iomanip>
#include <sstream>

namespace elvis::analytic {

namespace {

constexpr const char* header = "elvis-analytic";

/** Reads a file by lines with something on them; comments begin with '#'. */
class Lines {
public:
    explicit Lines(const std::string& path) : m_path(path), m_file(path) {
        if (!m_file) {
            throw api::Error(ELVIS_ERROR_FILE, path, "cannot be read");
        }
    }

    bool next() {
        std::string line;
        while (std::getline(m_file, line)) {
            ++m_number;
            line.resize(std::min(line.find('#'), line.size()));
            if (line.find_first_not_of(" \t\r") != std::string::npos) {
                m_line = std::istringstream(line);
                return true;
            }
        }
        return false;
    }

    /** The line after this one, which must exist. */
    void need(const char* what) {
        if (!next()) {
            fail(std::string("the file ends where ") + what + " is expected");
        }
    }

    template <class Value> Value read(const char* what) {
        Value value;
        if (!(m_line >> value)) {
            fail(std::string(what) + " is missing or not what it should be");
        }
        return value;
    }

    void end() {
        if (std::string rest; m_line >> rest) {
            fail("'" + rest + "' is too much");
        }
    }

    std::istringstream& line() { return m_line; }

    [[noreturn]] void fail(const std::string& what) const {
        throw api::Error(ELVIS_ERROR_FORMAT, m_path, "line " + std::to_string(m_number) + ": " + what);
    }

private:
    std::string m_path;
    std::ifstream m_file;
    std::istringstream m_line;
    int m_number = 0;
};

Term read_term(Lines& lines, std::uint32_t n_components) {
    Term term;
    const auto component = lines.read<std::int64_t>("the component");
    if (component < 0 || component >= n_components) {
        lines.fail("the field has no component " + std::to_string(component));
    }
    term.component = static_cast<std::uint32_t>(component);
    const auto kind = lines.read<std::string>("the kind of term");
    if (kind != "sine" && kind != "gaussian" && kind != "pole") {
        lines.fail("unknown term '" + kind + "'; known are sine, gaussian and pole");
    }
    term.kind = kind == "sine" ? Kind::sine : kind == "gaussian" ? Kind::gaussian : Kind::pole;
    term.amplitude = lines.read<double>("the amplitude");
    for (std::size_t i = 0; i < (term.kind == Kind::pole ? 3u : 4u); ++i) {
        term.parameters[i] = lines.read<double>("a parameter of the term");
    }
    if (term.kind == Kind::gaussian && !(term.parameters[3] > 0)) {
        lines.fail("the width of a Gaussian must be positive");
    }
    return term;
}

} // namespace

bool has_our_header(const char* path) {
    std::string word;
    return static_cast<bool>(std::ifstream(path) >> std::setw(32) >> word) && word == header;
}

File read_file(const std::string& path) {
    Lines lines(path);
    lines.need("the header");
    if (lines.read<std::string>("the header") != header || lines.read<int>("the version") != 1) {
        lines.fail("the file must begin with '" + std::string(header) + " 1'");
    }
    lines.end();
    File file;
    while (lines.next()) {
        const auto keyword = lines.read<std::string>("a keyword");
        if (keyword == "field") {
            Field field;
            field.name = lines.read<std::string>("the field's name");
            for (const Field& other : file.fields) {
                if (other.name == field.name) {
                    lines.fail("there is a field '" + field.name + "' already");
                }
            }
            const auto n_components = lines.read<std::int64_t>("the number of components");
            if (n_components < 1 || n_components > 16) {
                lines.fail("a field has 1 to 16 components");
            }
            field.n_components = static_cast<std::uint32_t>(n_components);
            lines.line() >> field.unit;
            file.fields.push_back(field);
        } else if (keyword == "term") {
            if (file.fields.empty()) {
                lines.fail("a term before any field");
            }
            file.fields.back().terms.push_back(read_term(lines, file.fields.back().n_components));
        } else if (keyword == "vertex") {
            auto& vertex = file.vertices.emplace_back();
            for (double& coordinate : vertex) {
                coordinate = lines.read<double>("a coordinate");
            }
        } else if (keyword == "hexahedron") {
            auto& corners = file.hexahedra.emplace_back();
            for (std::uint32_t& corner : corners) {
                const auto vertex = lines.read<std::int64_t>("a corner");
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
