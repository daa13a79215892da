#include "netcdf.hpp"

#include <elvis/plugin.hpp>
#include <plugins/hdf5/file.hpp>

namespace elvis_exodus {

std::uint64_t n_numbers(const NetCdf& file, const std::string& variable, const Extents& extents) {
    constexpr std::uint64_t most = std::uint64_t{1} << 48;
    std::uint64_t n = 1;
    for (const std::uint64_t extent : extents) {
        if (extent != 0 && n > most / extent) {
            file.fail(variable, "has more numbers than a file can hold");
        }
        n *= extent;
    }
    return n;
}

std::vector<double> NetCdf::reals(const std::string& variable) const {
    const Extents all = shape(variable);
    std::vector<double> numbers(n_numbers(*this, variable, all));
    read(variable, Extents(all.size(), 0), all, numbers);
    return numbers;
}

std::vector<std::int64_t> NetCdf::integers(const std::string& variable) const {
    const Extents all = shape(variable);
    std::vector<std::int64_t> numbers(n_numbers(*this, variable, all));
    read(variable, Extents(all.size(), 0), all, numbers);
    return numbers;
}

void NetCdf::fail(const std::string& variable, const std::string& what) const {
    throw elvis::api::Error(ELVIS_ERROR_FORMAT, m_path, variable.empty() ? what : "'" + variable + "' " + what);
}

void NetCdf::check_box(const std::string& variable, const Extents& shape, const Extents& start, const Extents& count,
                       std::size_t n) const {
    bool fits = start.size() == shape.size() && count.size() == shape.size();
    for (std::size_t i = 0; fits && i < shape.size(); ++i) {
        fits = start[i] <= shape[i] && count[i] <= shape[i] - start[i];
    }
    if (!fits || n_numbers(*this, variable, count) != n) {
        fail(variable, "has not the shape that is needed");
    }
}

std::unique_ptr<const NetCdf> open_netcdf(const std::string& path) {
    return elvis::hdf5::is_hdf5(path) ? open_hdf5(path) : open_classic(path);
}

} // namespace elvis_exodus
