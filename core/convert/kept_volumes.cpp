#include <core/convert/kept_volumes.hpp>

#include <core/base/cache.hpp>
#include <core/base/counted.hpp>
#include <core/base/error.hpp>
#include <core/base/host.hpp>
#include <core/base/log.hpp>
#include <core/base/output_file.hpp>
#include <core/base/whole_file.hpp>
#include <core/convert/data_set_files.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/source_volume.hpp>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace elvis {

namespace {

namespace fs = std::filesystem;

constexpr const char* report_name = "report.json";
constexpr const char* unfinished = "part-";
/** Folders of conversions that were killed. No conversion writes nothing for that long. */
constexpr std::chrono::hours abandoned_after{24};

std::uint64_t most_bytes() {
    constexpr std::uint64_t mebibyte = std::uint64_t{1} << 20u;
    constexpr std::uint64_t by_default = 20480;
    const std::string text = environment_variable("ELVIS_VOLUME_CACHE_MIB").value_or("");
    std::uint64_t wanted = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), wanted);
    const bool is_number = error == std::errc{} && end == text.data() + text.size() && wanted < (std::uint64_t{1} << 40u);
    if (!text.empty() && !is_number) {
        log_warning("ELVIS_VOLUME_CACHE_MIB: '{}' is no number of mebibytes; {} are taken", text, by_default);
    }
    return mebibyte * (is_number ? wanted : by_default);
}

/** Folder of all kept volumes; empty if none are kept. */
fs::path folder_of_all() {
    const fs::path cache = cache_folder();
    return cache.empty() || most_bytes() == 0 ? fs::path() : cache / "volumes";
}

/** Changes whenever the file is written. */
std::string stamp(const fs::path& file) {
    std::error_code ignored;
    const auto size = fs::file_size(file, ignored);
    const auto time = fs::last_write_time(file, ignored).time_since_epoch().count();
    return file.string() + '\n' + std::to_string(size) + '\n' + std::to_string(time) + '\n';
}

/** Nothing for a data set of which it cannot be told when it changes. */
std::optional<std::string> key_of(const Plugin& plugin, const std::vector<std::string>& inputs, const std::string& options) {
    const std::optional<std::vector<fs::path>> files = data_set_files(inputs);
    if (!files) {
        return std::nullopt;
    }
    std::string text = std::string(ELVIS_VERSION) + '\n' + plugin.id() + '\n' + plugin.version() + '\n';
    text += stamp(plugin.library()) + options + '\n';
    for (const std::string& input : inputs) {
        text += fs::absolute(input).lexically_normal().string() + '\n';
    }
    for (const fs::path& file : *files) {
        text += stamp(file);
    }
    return content_hash(text);
}

/** The data set's name: titles of pictures have it. */
std::string volume_name(const std::vector<std::string>& inputs) {
    const fs::path input = fs::absolute(inputs.front()).lexically_normal();
    const std::string stem = (input.has_filename() ? input : input.parent_path()).stem().string();
    return (stem.empty() ? "volume" : stem) + ".h5";
}

/** What is there; its time is then that of the last use. */
std::optional<KeptVolume> find(const fs::path& entry, const std::string& name) {
    std::error_code failure;
    if (!fs::is_regular_file(entry / name, failure) || !fs::is_regular_file(entry / report_name, failure)) {
        return std::nullopt;
    }
    try {
        KeptVolume kept{(entry / name).string(), report_from_json(read_whole_file((entry / report_name).string())), false, {}};
        fs::last_write_time(entry / report_name, fs::file_time_type::clock::now(), failure);
        return kept;
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

std::uint64_t bytes_in(const fs::path& folder) {
    std::uint64_t bytes = 0;
    std::error_code ignored;
    for (const fs::directory_entry& file : fs::directory_iterator(folder, ignored)) {
        const std::uint64_t size = file.file_size(ignored);
        bytes += ignored ? 0 : size;
    }
    return bytes;
}

/** Removes what was not used for the longest time until all fit; never `newest`. */
void tidy(const fs::path& all, const fs::path& newest) {
    struct Entry {
        fs::file_time_type used;
        fs::path folder;
        std::uint64_t bytes;
    };
    std::vector<Entry> entries;
    std::uint64_t sum = 0;
    std::error_code ignored;
    for (const fs::directory_entry& folder : fs::directory_iterator(all, ignored)) {
        if (folder.path().filename().string().starts_with(unfinished)) {
            const auto written = folder.last_write_time(ignored);
            if (!ignored && fs::file_time_type::clock::now() - written > abandoned_after) {
                fs::remove_all(folder.path(), ignored);
            }
            continue;
        }
        const fs::file_time_type used = fs::last_write_time(folder.path() / report_name, ignored);
        entries.push_back({used, folder.path(), bytes_in(folder.path())});
        sum += entries.back().bytes;
    }
    std::ranges::sort(entries, {}, &Entry::used);
    const std::uint64_t most = most_bytes();
    for (const Entry& entry : entries) {
        if (sum <= most) {
            return;
        }
        if (entry.folder != newest) {
            fs::remove_all(entry.folder, ignored);
            sum -= entry.bytes;
        }
    }
}

/** A place for a new volume: in the cache if that can be written. */
std::shared_ptr<const TemporaryFolder> place_for(const fs::path& all, bool& is_kept) {
    std::error_code failure;
    if (!all.empty()) {
        fs::create_directories(all, failure);
    }
    is_kept = !all.empty() && !failure;
    if (is_kept) {
        try {
            return std::make_shared<TemporaryFolder>(all / unfinished);
        } catch (const Error& error) {
            log_debug("{}", error.what());
            is_kept = false;
        }
    }
    return std::make_shared<TemporaryFolder>();
}

} // namespace

KeptVolume kept_volume(const std::shared_ptr<const Plugin>& plugin, const std::vector<std::string>& inputs,
                       const std::string& options, const TaskControl& control) {
    const std::optional<std::string> key = key_of(*plugin, inputs, options);
    const fs::path all = key ? folder_of_all() : fs::path();
    const std::string name = volume_name(inputs);
    const fs::path entry = all.empty() ? fs::path() : all / *key;
    if (auto kept = all.empty() ? std::nullopt : find(entry, name)) {
        return std::move(*kept);
    }
    bool is_kept = false;
    const auto place = place_for(all, is_kept);
    ConvertOptions how;
    how.program_version = ELVIS_VERSION;
    control.progress(-1, "opening the files");
    const SourceVolume source(plugin, inputs, options, &control);
    KeptVolume made{place->path(name), convert(source, place->path(name), how, control), true, place};
    if (!is_kept) {
        return made;
    }
    write_text_file(place->path(report_name), to_json(made.report));
    std::error_code failure;
    if (!find(entry, name)) {
        fs::remove_all(entry, failure);
        fs::rename(place->path(), entry, failure);
    }
    // Where another process was faster, or the folder cannot be renamed, the temporary one serves.
    if (!failure && find(entry, name)) {
        made.path = (entry / name).string();
        made.folder.reset();
        tidy(all, entry);
    }
    return made;
}

bool is_exact(const ConvertReport& report) {
    return report.geometry_exact && std::ranges::all_of(report.fields, &FieldReport::exact);
}

std::string exactness(const ConvertReport& report) {
    if (is_exact(report)) {
        return "exact";
    }
    std::vector<std::string> losses;
    const FieldReport* worst = nullptr;
    for (const FieldReport& field : report.fields) {
        if (field.n_not_finite > 0) {
            losses.push_back(fmt::format("field {} is not a number in {}", field.name, counted(field.n_not_finite, "element")));
        } else if (!field.exact && (worst == nullptr || field.residual > worst->residual)) {
            worst = &field;
        }
    }
    if (worst != nullptr) {
        losses.insert(losses.begin(),
                      fmt::format("the largest residual is {:.3g} of the range of field {}", worst->residual, worst->name));
    }
    if (!report.geometry_exact) {
        losses.push_back(fmt::format("the geometry is off by {:.3g} of the extent", report.geometry_residual));
    }
    return fmt::format("NOT exact: {}", fmt::join(losses, ", "));
}

} // namespace elvis
