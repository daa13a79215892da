#include <core/plugin_host/unknown_file.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

namespace elvis {

namespace {

namespace fs = std::filesystem;

constexpr const char* to_vtu = "ParaView opens it: File > Save Data writes .vtu, which the VTK plugin reads";
constexpr const char* no_data = "it holds no finite element data";

/** A text that stands somewhere at the beginning of files of a kind. */
struct Sign {
    std::string_view text;
    const char* kind;
    const char* advice;
    /** The file begins with it; else it may stand anywhere in what is looked at. */
    bool is_first = true;
};

using namespace std::string_view_literals;

/** HDF5 and netCDF say which program wrote them by the names of groups and attributes. */
constexpr std::array hdf5_signs{
    Sign{"_NCProperties", "netCDF 4", to_vtu, false},
    Sign{"NEKTAR", "a field of Nektar++ in HDF5", "Nektar++'s FieldConvert writes it as XML (.fld) or .vtu (:vtu:highorder)",
         false},
};

constexpr std::array signs{
    Sign{"CDF\1"sv, "netCDF 3 (perhaps Exodus II)", to_vtu},
    Sign{"CDF\2"sv, "netCDF 3 (perhaps Exodus II)", to_vtu},
    Sign{"CDF\5"sv, "netCDF 3 (perhaps Exodus II)", to_vtu},
    Sign{"# vtk DataFile", "legacy VTK", to_vtu},
    Sign{"<VTKFile", "VTK XML, but no unstructured grid (.vtu, .pvtu, .pvd) that can be read", to_vtu, false},
    Sign{"<Xdmf", "XDMF", to_vtu, false},
    Sign{"#!TDV", "Tecplot (binary)", to_vtu},
    Sign{"TITLE", "Tecplot (text)", to_vtu},
    Sign{"VARIABLES", "Tecplot (text)", to_vtu},
    Sign{"FoamFile", "OpenFOAM", "ParaView opens its cases: File > Save Data writes .vtu, which the VTK plugin reads", false},
    Sign{"type:", "EnSight case", to_vtu, false},
    Sign{"NDIME=", "an SU2 mesh", "SU2 writes its solution as .vtu (OUTPUT_FILES= PARAVIEW)", false},
    Sign{"*NODE", "Abaqus input", "Gmsh reads it and writes .msh", false},
    Sign{"CONTROL INFO", "a Gambit neutral file", "Gmsh or ParaView convert it", false},
    Sign{"ISO-10303-21", "STEP", "a shape without a mesh: Gmsh makes one and writes .msh"},
    Sign{"solid ", "STL (text)", "a surface without fields: scenes take it as a surface of the kind mesh"},
    Sign{"ply\n", "PLY", "a surface without fields: scenes take it as a surface of the kind mesh"},
    Sign{"\x89PNG", "a PNG picture", no_data},
    Sign{"\xff\xd8\xff", "a JPEG picture", no_data},
    Sign{"%PDF", "a PDF document", no_data},
    Sign{"\x1f\x8b", "compressed by gzip", "unpack it first: gunzip"},
    Sign{"BZh", "compressed by bzip2", "unpack it first: bunzip2"},
    Sign{"\xfd"
         "7zXZ",
         "compressed by xz", "unpack it first: unxz"},
    Sign{"\x28\xb5\x2f\xfd", "compressed by zstd", "unpack it first: unzstd"},
    Sign{"PK\3\4", "a zip archive", "unpack it first"},
    Sign{"\x7f"
         "ELF",
         "a program or library", no_data},
};

std::string first_bytes(const fs::path& file) {
    constexpr std::size_t most = 65536;
    std::ifstream stream(file, std::ios::binary);
    std::string bytes(most, '\0');
    stream.read(bytes.data(), static_cast<std::streamsize>(most));
    bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
    return bytes;
}

bool matches(const Sign& sign, std::string_view bytes) {
    if (sign.is_first) {
        return bytes.starts_with(sign.text);
    }
    // Text in a binary file is no sign of a text format.
    return bytes.find(sign.text) != std::string_view::npos;
}

FileGuess guess_hdf5(std::string_view bytes) {
    for (const Sign& sign : hdf5_signs) {
        if (matches(sign, bytes)) {
            return {sign.kind, sign.advice};
        }
    }
    return {"HDF5 of a layout that is not known", "of HDF5, native volumes (.h5) are read, and what elvis plugins lists"};
}

FileGuess guess_folder(const fs::path& folder) {
    std::error_code ignored;
    if (fs::exists(folder / "system/controlDict", ignored)) {
        return {"an OpenFOAM case", "ParaView opens it: File > Save Data writes .vtu, which the VTK plugin reads"};
    }
    return {"a folder", "name a file in it"};
}

/** `.f#####` for .f00001: '#' is a digit. */
bool has_ending(const std::string& name, const std::string& ending) {
    if (name.size() <= ending.size()) {
        return false;
    }
    const std::string_view end = std::string_view(name).substr(name.size() - ending.size());
    for (std::size_t i = 0; i < end.size(); ++i) {
        const bool is_digit = std::isdigit(static_cast<unsigned char>(end[i])) != 0;
        if (ending[i] == '#' ? !is_digit : ending[i] != end[i]) {
            return false;
        }
    }
    return true;
}

/** "MFEM mesh (org.elvis.mfem)" whose ending the file has; may be empty. */
std::string format_of_ending(const PluginRegistry& registry, const std::string& name) {
    for (const auto& plugin : registry.plugins()) {
        for (const FileFormat& format : plugin->formats()) {
            for (const std::string& ending : format.endings) {
                if (has_ending(name, ending)) {
                    return format.name + " (" + plugin->id() + ")";
                }
            }
        }
    }
    return {};
}

} // namespace

FileGuess guess_file(const std::string& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) {
        return guess_folder(path);
    }
    const std::string bytes = first_bytes(path);
    if (bytes.empty()) {
        return {"an empty file, or one that cannot be read", ""};
    }
    if (bytes.starts_with("\x89HDF\r\n")) {
        return guess_hdf5(bytes);
    }
    const bool is_binary = bytes.find('\0') != std::string::npos;
    for (const Sign& sign : signs) {
        if ((sign.is_first || !is_binary || sign.kind == "OpenFOAM"sv) && matches(sign, bytes)) {
            return {sign.kind, sign.advice};
        }
    }
    return {};
}

Error unknown_file(const PluginRegistry& registry, const std::string& path, const Error& refusal) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) {
        return refusal;
    }
    std::string text = refusal.cause();
    const FileGuess guess = guess_file(path);
    if (!guess.kind.empty()) {
        text += "\n  it seems to be " + guess.kind + (guess.advice.empty() ? "" : "; " + guess.advice);
    } else if (const std::string format = format_of_ending(registry, fs::path(path).filename().string()); !format.empty()) {
        text += "\n  its name is that of " + format + ": is it whole, and does another file of its data set come first?";
    }
    return {path, text + "\n  elvis plugins lists the formats that are read, with their endings"};
}

} // namespace elvis
