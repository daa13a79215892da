#include "file_name.hpp"

#include <algorithm>
#include <filesystem>

namespace elvis_nek5000 {

namespace fs = std::filesystem;

namespace {

bool is_number(std::string_view text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/** A name that ends in .f or .fld and digits. */
struct StepName {
    /** Up to and with .f or .fld. */
    std::string series;
    std::string digits;
};

std::optional<StepName> split_step(const std::string& name) {
    const std::size_t first = name.find_last_not_of("0123456789") + 1;
    const std::string series = name.substr(0, first);
    const std::string digits = name.substr(first);
    // More digits than any program writes are no number of a step.
    const bool is_step = (series.ends_with(".f") || series.ends_with(".fld")) && is_number(digits) && digits.size() <= 9;
    return is_step ? std::optional(StepName{series, digits}) : std::nullopt;
}

std::string padded(std::uint32_t number, std::size_t width) {
    std::string digits = std::to_string(number);
    return std::string(width - std::min(width, digits.size()), '0') + digits;
}

std::size_t n_digits(std::uint32_t n_parts) { return std::to_string(n_parts).size(); }

/** The session's name, with its prefix, of NAME0.f00001 or NAME.fld01. */
std::string session(const std::string& path, std::uint32_t n_parts) {
    const std::string name = fs::path(path).filename();
    const auto step = split_step(name);
    if (!step) {
        return fs::path(name).stem();
    }
    if (step->series.ends_with(".fld")) {
        return step->series.substr(0, step->series.size() - 4);
    }
    const std::string stem = step->series.substr(0, step->series.size() - 2);
    const std::size_t width = n_digits(n_parts);
    const bool has_part = stem.size() > width && is_number(std::string_view(stem).substr(stem.size() - width));
    return has_part ? stem.substr(0, stem.size() - width) : stem;
}

/** Parts may lie in folders A0, A1, ... */
bool is_part_folder(const fs::path& folder) {
    const std::string name = folder.filename();
    return name.size() > 1 && name[0] == 'A' && is_number(std::string_view(name).substr(1));
}

} // namespace

std::optional<std::string> part_path(const std::string& path, std::uint32_t own_part, std::uint32_t part,
                                     std::uint32_t n_parts) {
    if (part == own_part) {
        return path;
    }
    const fs::path whole(path);
    const auto step = split_step(whole.filename());
    const std::string own = padded(own_part, n_digits(n_parts));
    if (!step || !step->series.ends_with(own + ".f")) {
        return std::nullopt;
    }
    const std::string other = padded(part, own.size());
    const std::string name = step->series.substr(0, step->series.size() - own.size() - 2) + other + ".f" + step->digits;
    fs::path folder = whole.parent_path();
    if (folder.filename() == "A" + own) {
        folder.replace_filename("A" + other);
    }
    return (folder / name).string();
}

std::vector<std::string> earlier_steps(const std::string& path) {
    const fs::path whole(path);
    const auto own = split_step(whole.filename());
    if (!own) {
        return {};
    }
    std::vector<std::pair<int, std::string>> found;
    const fs::path folder = whole.parent_path();
    std::error_code error;
    fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
        const auto step = split_step(entry->path().filename());
        if (step && step->series == own->series && std::stoi(step->digits) < std::stoi(own->digits)) {
            found.emplace_back(std::stoi(step->digits), (folder / entry->path().filename()).string());
        }
    }
    std::ranges::sort(found, std::greater<>());
    std::vector<std::string> paths;
    for (auto& [number, name] : found) {
        paths.push_back(std::move(name));
    }
    return paths;
}

bool is_regular(const std::string& path, std::uint32_t n_parts) { return session(path, n_parts).ends_with("_reg"); }

std::vector<std::string> mesh_paths(const std::string& path, std::uint32_t n_parts) {
    std::string name = session(path, n_parts);
    if (name.ends_with("_reg")) {
        name.resize(name.size() - 4);
    }
    fs::path folder = fs::path(path).parent_path();
    if (is_part_folder(folder)) {
        folder = folder.parent_path();
    }
    std::vector<std::string> paths{(folder / (name + ".re2")).string()};
    constexpr std::size_t prefix = 3;
    if (name.size() > prefix) {
        paths.push_back((folder / (name.substr(prefix) + ".re2")).string());
    }
    return paths;
}

} // namespace elvis_nek5000
