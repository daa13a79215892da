#include <core/parts/partition_file.hpp>

#include <core/base/counted.hpp>
#include <core/base/error.hpp>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <span>

namespace elvis {

namespace {

std::vector<std::uint32_t> read_numbers(const std::string& path, std::uint64_t n_elements) {
    std::ifstream file(path);
    if (!file) {
        throw Error(path, "there is no such file, or it cannot be read; --parts takes a number, a file of numbers, or own");
    }
    std::vector<std::uint32_t> parts;
    std::string word;
    while (file >> word) {
        std::uint32_t part = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), part);
        if (error != std::errc() || end != word.data() + word.size() || part >= most_parts) {
            throw Error(path, "number " + std::to_string(parts.size() + 1) + " is '" + word.substr(0, 40) +
                                  "', and no part: a whole number from 0 to 999999");
        }
        parts.push_back(part);
        if (parts.size() > n_elements) {
            break;
        }
    }
    if (parts.size() != n_elements) {
        throw Error(path,
                    (parts.size() < n_elements ? "has " + counted(parts.size(), "number") : std::string("has more numbers")) +
                        "; the volume has " + counted(n_elements, "element"));
    }
    return parts;
}

/** `by_number`: the part of each element, by its number. `path`: for errors. */
std::vector<std::vector<Span>> runs_of_parts(std::span<const std::uint32_t> by_number, std::size_t n_parts,
                                             const std::string& path, const RuntimeVolume& whole) {
    std::vector<std::vector<Span>> parts(n_parts);
    constexpr std::uint64_t at_once = 65536;
    std::vector<std::int64_t> numbers;
    for (std::uint64_t element = 0; element < whole.n_elements(); ++element) {
        if (element % at_once == 0) {
            numbers.resize(std::min(at_once, whole.n_elements() - element));
            whole.element_numbers(element, numbers.size(), numbers);
        }
        const std::int64_t number = numbers[element % at_once];
        if (number < 0 || static_cast<std::uint64_t>(number) >= by_number.size()) {
            throw Error(path, "the volume's elements are not numbered from 0 without gaps: there is an element " +
                                  std::to_string(number));
        }
        std::vector<Span>& runs = parts[by_number[static_cast<std::size_t>(number)]];
        if (!runs.empty() && runs.back().end == element) {
            ++runs.back().end;
        } else {
            runs.push_back({element, element + 1});
        }
    }
    return parts;
}

} // namespace

Partition read_partition(const std::string& path, const RuntimeVolume& whole) {
    const std::vector<std::uint32_t> by_number = read_numbers(path, whole.n_elements());
    return Partition(runs_of_parts(by_number, *std::ranges::max_element(by_number) + std::size_t{1}, path, whole));
}

Partition own_partition(const native::VolumeSource* source, const RuntimeVolume& whole) {
    const std::uint32_t n_parts = source != nullptr ? source->description().n_parts : 0;
    if (n_parts == 0) {
        throw Error(whole.path(), "has no partition of its own, so there is no --parts own; --parts N or --parts FILE say one");
    }
    std::vector<std::uint32_t> by_number(whole.n_elements());
    try {
        source->read_parts(0, by_number);
    } catch (const native::FileError& error) {
        throw Error(error.what());
    }
    return Partition(runs_of_parts(by_number, n_parts, whole.path(), whole));
}

} // namespace elvis
