#include "step_list.hpp"

#include "numbers.hpp"

#include <filesystem>
#include <map>

namespace elvis_nek5000 {

namespace fs = std::filesystem;

namespace {

/** Lists have a few lines. */
constexpr std::size_t max_size = 65536;
constexpr std::int64_t max_steps = 1000000;

std::string trimmed(std::string_view text) {
    const std::vector<std::string_view> word = words(text);
    return word.empty() ? std::string() : std::string(word.front().data(), word.back().data() + word.back().size());
}

/** Lines KEY: VALUE, with blanks around both. */
std::map<std::string, std::string> read_keys(const ByteFile& file) {
    const std::string text = file.text(0, max_size);
    std::map<std::string, std::string> values;
    for (std::size_t first = 0; first < text.size();) {
        const std::size_t end = std::min(text.find('\n', first), text.size());
        const std::string_view line = std::string_view(text).substr(first, end - first);
        const std::size_t colon = line.find(':');
        if (colon != std::string_view::npos) {
            values.try_emplace(trimmed(line.substr(0, colon)), trimmed(line.substr(colon + 1)));
        }
        first = end + 1;
    }
    return values;
}

/** A %05d of a template: where it is, and how many digits are wanted. */
struct Place {
    std::size_t first = 0;
    std::size_t end = 0;
    std::size_t width = 0;
};

std::vector<Place> find_places(const ByteFile& file, const std::string& format) {
    std::vector<Place> places;
    for (std::size_t at = format.find('%'); at != std::string::npos; at = format.find('%', at + 1)) {
        const std::size_t end = format.find_first_not_of("0123456789", at + 1);
        const auto width = parse_integer(std::string_view(format).substr(at + 1, end - at - 1)).value_or(0);
        if (end == std::string::npos || format[end] != 'd' || width > 9) {
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, file.path(),
                                    "filetemplate '" + format + "': at % a number like %05d is expected");
        }
        places.push_back({at, end + 1, static_cast<std::size_t>(width)});
    }
    if (places.empty()) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, file.path(), "filetemplate '" + format + "' has no place for the step");
    }
    return places;
}

/** The last place is the step's, those before it are the part's. */
std::string expand(const std::string& format, const std::vector<Place>& places, std::int64_t step) {
    std::string name;
    std::size_t at = 0;
    for (const Place& place : places) {
        const std::string digits = std::to_string(&place == &places.back() ? step : 0);
        name += format.substr(at, place.first - at);
        name += std::string(place.width - std::min(place.width, digits.size()), '0') + digits;
        at = place.end;
    }
    return name + format.substr(at);
}

} // namespace

bool is_step_list(const ByteFile& file) { return read_keys(file).contains("filetemplate"); }

std::vector<std::string> read_step_list(const ByteFile& file, const elvis::api::Host& host) {
    const auto keys = read_keys(file);
    const auto integer = [&](const char* key, std::int64_t least, std::int64_t most) {
        const auto found = keys.find(key);
        const auto value = found == keys.end() ? std::nullopt : parse_integer(found->second);
        if (!value || *value < least || *value > most) {
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, file.path(),
                                    std::string(key) + (found == keys.end() ? " is missing" : " is '" + found->second + "'") +
                                        "; a number from " + std::to_string(least) + " to " + std::to_string(most) +
                                        " is expected");
        }
        return *value;
    };
    const std::string format = keys.at("filetemplate");
    const std::vector<Place> places = find_places(file, format);
    const std::int64_t first = integer("firsttimestep", 0, 999999999);
    const std::int64_t n_steps = integer("numtimesteps", 1, max_steps);
    std::vector<std::string> paths;
    std::string missing;
    for (std::int64_t step = first; step < first + n_steps; ++step) {
        const std::string path = (fs::path(file.path()).parent_path() / expand(format, places, step)).string();
        std::error_code ignored;
        if (fs::exists(path, ignored)) {
            paths.push_back(path);
        } else if (missing.empty()) {
            missing = path;
        }
    }
    if (paths.empty()) {
        throw elvis::api::Error(ELVIS_ERROR_FILE, file.path(), "none of its files is there, the first of which is " + missing);
    }
    if (const auto n_missing = static_cast<std::size_t>(n_steps) - paths.size(); n_missing > 0) {
        host.log(ELVIS_LOG_WARNING, file.path() + ": " + std::to_string(n_missing) + " of its " + std::to_string(n_steps) +
                                        " time steps are not there, the first of which is " + missing);
    }
    return paths;
}

} // namespace elvis_nek5000
