// Values of a volume's fields on a line with libelvis in C++: values VOLUME
#include <elvis/elvis.hpp>

#include <cstdio>

namespace {

void print_values(const char* path) {
    const elvis::context context;
    const elvis::data volume = context.open(path);
    const elvis_data_info info = volume.info();
    std::vector<double> line;
    constexpr int n_points = 9;
    for (int point = 0; point < n_points; ++point) {
        for (int axis = 0; axis < 3; ++axis) {
            const double part = (point + 0.5) / n_points;
            line.push_back(info.bounds[axis] + part * (info.bounds[axis + 3] - info.bounds[axis]));
        }
    }
    const elvis::probed values = volume.probe(line, {volume.field(0).name});
    for (int point = 0; point < n_points; ++point) {
        std::printf("%9.4f %9.4f %9.4f  element %lld  %.15g\n", line[3 * point], line[3 * point + 1], line[3 * point + 2],
                    static_cast<long long>(values.elements[point]), values.values[point * values.n_values]);
    }
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: values VOLUME\n");
        return 2;
    }
    try {
        print_values(argv[1]);
    } catch (const elvis::error& failure) {
        std::fprintf(stderr, "%s\n", failure.what());
        return 1;
    }
    return 0;
}
