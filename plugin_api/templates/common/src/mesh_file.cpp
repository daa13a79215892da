#include "mesh_file.hpp"

#include <elvis/plugin.hpp>

#include <cmath>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace @NAME@ {

namespace {

constexpr const char* header = "@NAME@-mesh";

/** A file read line by line; empty lines and those that begin with '#' are skipped. */
class Lines {
public:
    explicit Lines(const std::string& path) : m_path(path), m_file(path) {
        if (!m_file) {
            throw elvis::api::Error(ELVIS_ERROR_FILE, path, "cannot be read");
        }
    }

    /** Goes to the next line; false at the end of the file. */
    bool next() {
        std::string line;
        while (std::getline(m_file, line)) {
            ++m_number;
            if (!line.empty() && line[0] != '#') {
                m_line = std::istringstream(line);
                return true;
            }
        }
        return false;
    }

    template <class Value> Value read(const char* what) {
        Value value;
        if (!(m_line >> value)) {
            fail(std::string(what) + " is expected here");
        }
        return value;
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, m_path, "line " + std::to_string(m_number) + ": " + what);
    }

private:
    std::string m_path;
    std::ifstream m_file;
    std::istringstream m_line;
    int m_number = 0;
};

} // namespace

bool is_mesh_file(const char* path) {
    std::string word;
    return (std::ifstream(path) >> std::setw(64) >> word) && word == header;
}

MeshFile read_mesh_file(const std::string& path) {
    Lines lines(path);
    if (!lines.next() || lines.read<std::string>("the header") != header) {
        lines.fail(std::string("the file must begin with '") + header + " FIELD'");
    }
    MeshFile file;
    file.field = lines.read<std::string>("the name of the field");
    while (lines.next()) {
        if (lines.read<std::string>("a keyword") != "hexahedron") {
            lines.fail("the word 'hexahedron' is expected here");
        }
        Hexahedron& hexahedron = file.hexahedra.emplace_back();
        for (Corner& corner : hexahedron) {
            if (!lines.next()) {
                lines.fail("the file ends within a hexahedron, which has eight corners");
            }
            for (double& number : corner) {
                number = lines.read<double>("a number");
                if (!std::isfinite(number)) {
                    lines.fail("a number is not finite");
                }
            }
        }
    }
    if (file.hexahedra.empty()) {
        lines.fail("the file has no hexahedra");
    }
    return file;
}

} // namespace @NAME@
