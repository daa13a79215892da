#include "sample_files.hpp"

namespace elvis::commands {

void write_samples(const SampleTable& table, const std::string& path) {
    if (path.ends_with(".svg")) {
        write_svg_plot(table, path);
    } else if (path.ends_with(".csv")) {
        write_csv(table, path);
    } else if (path.ends_with(".npz")) {
        write_npz(table, path);
    } else if (path.ends_with(".vti")) {
        write_vti(table, path);
    } else {
        write_hdf5(table, path);
    }
}

} // namespace elvis::commands
