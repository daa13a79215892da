#include "sample_files.hpp"
#include <apps/elvis/answers/sample_curve.hpp>

#include <core/base/error.hpp>
#include <core/base/output_file.hpp>

#include <fstream>

namespace elvis::commands {

void write_csv(const SampleTable& table, const std::string& path) {
    OutputFile output(path);
    std::ofstream file(output.temporary(), std::ios::binary);
    put_csv(table, file);
    file.close();
    if (!file) {
        throw Error(path, "cannot be written");
    }
    output.commit();
}

} // namespace elvis::commands
