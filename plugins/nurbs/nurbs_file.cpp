#include "nurbs_file.hpp"

#include <text/lines.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace elvis::nurbs {

namespace {

constexpr const char* header = "elvis-nurbs";
constexpr int max_degree = 8;
constexpr std::size_t max_components = 16;

/** The words of a file, one after the other, with the line of the last. */
class Words {
public:
    explicit Words(const std::string& path) : m_path(path), m_file(path) {
        if (!m_file || std::filesystem::is_directory(path)) {
            throw api::Error(ELVIS_ERROR_FILE, path, "cannot be read");
        }
    }

    /** Empty at the end of the file. A quoted word keeps its first quotation mark. */
    const std::string& next() {
        m_word.clear();
        m_line += m_ended_line ? 1 : 0;
        m_ended_line = false;
        for (int c = m_file.get(); c != EOF; c = m_file.get()) {
            if (c == '#') {
                std::string comment;
                std::getline(m_file, comment);
                c = '\n';
            }
            // A word at the end of a line still stands on it.
            m_ended_line = c == '\n' && !m_word.empty();
            m_line += c == '\n' && m_word.empty() ? 1 : 0;
            const bool is_quoted = !m_word.empty() && m_word.front() == '"';
            if (is_quoted ? c == '"' || c == '\n' : std::isspace(c) != 0) {
                if (!m_word.empty()) {
                    break;
                }
                continue;
            }
            m_word += static_cast<char>(c);
        }
        return m_word;
    }

    void need(const char* word) {
        if (next() != word) {
            fail(std::string("'") + word + "' is expected instead of '" + m_word + "'");
        }
    }

    double number(const char* what) {
        const std::string word = next();
        char* end = nullptr;
        const double value = std::strtod(word.c_str(), &end);
        if (word.empty() || *end != '\0' || !std::isfinite(value)) {
            fail(std::string(what) + " is expected instead of '" + word + "'");
        }
        return value;
    }

    std::size_t count(const char* what, std::size_t low, std::size_t high) {
        const double value = number(what);
        if (!(value >= static_cast<double>(low) && value <= static_cast<double>(high)) || value != std::floor(value)) {
            fail(std::string(what) + " lies outside " + std::to_string(low) + ".." + std::to_string(high));
        }
        return static_cast<std::size_t>(value);
    }

    const std::string& word() const { return m_word; }

    [[noreturn]] void fail(const std::string& what) const {
        throw api::Error(ELVIS_ERROR_FORMAT, m_path, "line " + std::to_string(m_line) + ": " + what);
    }

private:
    std::string m_path;
    std::ifstream m_file;
    std::string m_word;
    int m_line = 1;
    bool m_ended_line = false;
};

std::vector<double> read_knots(Words& words, int degree) {
    words.need("knots");
    const auto p = static_cast<std::size_t>(degree);
    const std::size_t n = words.count("the number of knots", 2 * p + 2, 100000);
    std::vector<double> knots;
    for (std::size_t i = 0; i < n; ++i) {
        knots.push_back(words.number("a knot"));
        if (i > 0 && knots[i] < knots[i - 1]) {
            words.fail("knots must ascend");
        }
        // At most degree times inside, and degree + 1 times at the ends: the function is continuous.
        const std::size_t most = knots.front() == knots[i] ? p + 1 : p;
        if (i >= most && knots[i - most] == knots[i] &&
            !(i == n - 1 && most == p && (i < p + 1 || knots[i - p - 1] != knots[i]))) {
            words.fail("a knot comes too often");
        }
    }
    if (knots.front() == knots.back() || knots[p] != knots.front() || knots[n - 1 - p] != knots.back()) {
        words.fail("the first and the last knot must come degree + 1 times");
    }
    return knots;
}

PatchData read_patch(Words& words, std::size_t width) {
    PatchData patch;
    words.need("degree");
    for (int& degree : patch.degree) {
        degree = static_cast<int>(words.count("a degree", 1, max_degree));
    }
    std::size_t n_points = 1;
    for (std::size_t direction = 0; direction < 3; ++direction) {
        patch.knots[direction] = read_knots(words, patch.degree[direction]);
        n_points *= patch.n_points(direction);
    }
    words.need("points");
    for (std::size_t i = 0; i < n_points; ++i) {
        for (std::size_t k = 0; k < width; ++k) {
            patch.points.push_back(words.number("a number of a control point"));
        }
        if (!(patch.points[i * width + 3] > 0)) {
            words.fail("a weight must be positive");
        }
    }
    return patch;
}

} // namespace

std::size_t File::width() const {
    std::size_t n = 4;
    for (const Field& field : fields) {
        n += field.n_components;
    }
    return n;
}

bool has_our_header(const char* path) { return text::begins_with(path, header); }

File read_file(const std::string& path) {
    Words words(path);
    words.need(header);
    words.need("1");
    File file;
    words.next();
    while (words.word() == "field") {
        Field field;
        field.name = words.next();
        if (field.name.empty() ||
            std::any_of(file.fields.begin(), file.fields.end(), [&](const Field& f) { return f.name == field.name; })) {
            words.fail("a field needs a name of its own");
        }
        field.n_components = words.count("the number of components", 1, max_components);
        if (words.next().substr(0, 1) == "\"") {
            field.unit = words.word().substr(1);
            words.next();
        }
        file.fields.push_back(field);
    }
    while (words.word() == "patch") {
        file.patches.push_back(read_patch(words, file.width()));
        words.next();
    }
    if (!words.word().empty()) {
        words.fail("'" + words.word() + "' is neither 'field' nor 'patch'");
    }
    if (file.fields.empty() || file.patches.empty()) {
        words.fail("the file has no field or no patch");
    }
    return file;
}

} // namespace elvis::nurbs
