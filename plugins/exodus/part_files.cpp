#include "part_files.hpp"

#include <elvis/plugin.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <regex>
#include <system_error>

namespace elvis_exodus {

namespace {

/** What all parts have in common: "NAME.", and how many there are, as it is written. */
struct PartName {
    std::string stem, n_parts;

    friend bool operator==(const PartName&, const PartName&) = default;
};

std::optional<PartName> part_name(const std::string& path) {
    static const std::regex pattern(R"((.+\.)([1-9]\d{0,5})\.(\d{1,6}))");
    std::smatch found;
    if (!std::regex_match(path, found, pattern) || found[3].length() != found[2].length() ||
        std::stoul(found[3]) >= std::stoul(found[2])) {
        return std::nullopt;
    }
    return PartName{found[1], found[2]};
}

std::string numbered(const PartName& name, std::size_t part) {
    const std::string number = std::to_string(part);
    return name.stem + name.n_parts + "." + std::string(name.n_parts.size() - number.size(), '0') + number;
}

} // namespace

std::vector<std::string> part_files(const std::vector<std::string>& paths) {
    const std::optional<PartName> name = part_name(paths.front());
    for (const std::string& path : paths) {
        if (paths.size() > 1 && (!name || part_name(path) != name)) {
            throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, path,
                                    "is no part of the data set of " + paths.front() +
                                        ": several files are read together only if they are its parts, " +
                                        "as NAME.4.0 to NAME.4.3");
        }
    }
    if (!name) {
        return paths;
    }
    std::vector<std::string> parts(std::stoul(name->n_parts));
    for (std::size_t part = 0; part < parts.size(); ++part) {
        parts[part] = numbered(*name, part);
        std::error_code ignored;
        if (!std::filesystem::exists(parts[part], ignored)) {
            throw elvis::api::Error(ELVIS_ERROR_FILE, parts[part],
                                    "does not exist: it is part " + std::to_string(part) + " of " + name->n_parts);
        }
    }
    return parts;
}

} // namespace elvis_exodus
