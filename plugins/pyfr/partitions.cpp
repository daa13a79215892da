#include "partitions.hpp"

#include <charconv>

namespace elvis_pyfr {

std::pair<std::string, std::int64_t> split_partition(const std::string& name) {
    const std::size_t at = name.rfind("_p");
    std::int64_t partition = -1;
    if (at != std::string::npos) {
        const char* const end = name.data() + name.size();
        const auto read = std::from_chars(name.data() + at + 2, end, partition);
        if (read.ec == std::errc() && read.ptr == end && partition >= 0) {
            return {name.substr(0, at), partition};
        }
    }
    return {name, -1};
}

std::vector<Part> find_parts(const elvis::hdf5::File& file, const std::string& prefix, const Kind& kind,
                             std::size_t element_axis) {
    std::vector<Part> parts;
    for (const std::string& name : file.names("/")) {
        const auto [front, partition] = split_partition(name);
        if (partition < 0 || front != prefix + std::string(kind.name)) {
            continue;
        }
        elvis::hdf5::Dataset data = file.dataset(name);
        if (data.shape().size() != 3) {
            file.fail(name, "has " + std::to_string(data.shape().size()) + " dimensions instead of 3");
        }
        const std::uint64_t count = data.shape()[element_axis];
        parts.push_back({partition, 0, count, name, std::move(data)});
    }
    std::ranges::sort(parts, {}, &Part::partition);
    std::uint64_t first = 0;
    for (Part& part : parts) {
        part.first = first;
        first += part.count;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (axis != element_axis && part.data.shape()[axis] != parts.front().data.shape()[axis]) {
                file.fail(part.name, "has another size than " + parts.front().name);
            }
        }
    }
    return parts;
}

std::uint64_t n_elements(const std::vector<Part>& parts) { return parts.empty() ? 0 : parts.back().first + parts.back().count; }

std::vector<PartSize> sizes(const std::vector<Part>& parts) {
    std::vector<PartSize> all;
    for (const Part& part : parts) {
        all.push_back({part.partition, part.count});
    }
    return all;
}

} // namespace elvis_pyfr
