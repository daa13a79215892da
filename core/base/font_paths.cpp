#include <core/base/font_paths.hpp>

#include <filesystem>
#include <system_error>

namespace elvis {

std::vector<std::string> default_font_paths() {
    std::error_code ignored;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
    return {(program.parent_path().parent_path() / "share/elvis/fonts/DejaVuSans.ttf").string(), // a bundle's
            "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",                                   // Debian, Ubuntu
            "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",                                 // Fedora
            "/usr/share/fonts/dejavu/DejaVuSans.ttf",                                            // Red Hat, Alpine
            "/usr/share/fonts/TTF/DejaVuSans.ttf",                                               // Arch
            "/usr/share/fonts/truetype/DejaVuSans.ttf",                                          // openSUSE
            "/usr/local/share/fonts/dejavu/DejaVuSans.ttf"};                                     // FreeBSD
}

} // namespace elvis
