#include "mesh_file.hpp"

#include <elvis/plugin.hpp>

#include <cmath>
#include <fstream>
#include <iomanip>

namespace my_solver {

namespace {

constexpr const char* header = "my_solver-modal";
constexpr int max_order = 20;

double read_number(std::ifstream& file, const std::string& path, std::size_t hexahedron) {
    double number = 0;
    if (!(file >> number) || !std::isfinite(number)) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path,
                                "hexahedron " + std::to_string(hexahedron) + ": a number is expected");
    }
    return number;
}

} // namespace

bool is_mesh_file(const char* path) {
    std::string word;
    return (std::ifstream(path) >> std::setw(64) >> word) && word == header;
}

MeshFile read_mesh_file(const std::string& path) {
    std::ifstream stream(path);
    if (!stream) {
        throw elvis::api::Error(ELVIS_ERROR_FILE, path, "cannot be read");
    }
    MeshFile file;
    std::string word;
    if (!(stream >> word >> file.field >> file.order) || word != header || file.order < 0 || file.order > max_order) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path,
                                std::string("the file must begin with '") + header + " FIELD ORDER', the order at most 20");
    }
    while (stream >> word) {
        if (word != "hexahedron") {
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, path,
                                    "after hexahedron " + std::to_string(file.hexahedra.size()) +
                                        ": the word 'hexahedron' is expected");
        }
        Hexahedron& hexahedron = file.hexahedra.emplace_back();
        for (Corner& corner : hexahedron.corners) {
            for (double& coordinate : corner) {
                coordinate = read_number(stream, path, file.hexahedra.size());
            }
        }
        hexahedron.modes.resize(file.n_modes());
        for (double& mode : hexahedron.modes) {
            mode = read_number(stream, path, file.hexahedra.size());
        }
    }
    if (file.hexahedra.empty()) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path, "the file has no hexahedra");
    }
    return file;
}

} // namespace my_solver
