#include "sums.hpp"

#include <core/base/error.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>

namespace elvis::hunt {
namespace {

using Json = nlohmann::json;

struct Member {
    const char* name;
    std::uint64_t Tally::*count;
};
constexpr Member members[] = {{"pixels", &Tally::pixels},
                              {"hits", &Tally::hits},
                              {"flagged", &Tally::flagged},
                              {"flagged_wrong", &Tally::flagged_wrong},
                              {"silent_near", &Tally::near},
                              {"silent_far", &Tally::far},
                              {"undecidable", &Tally::undecidable},
                              {"false_alarms", &Tally::all_false_alarms},
                              {"lines", &Tally::lines}};

Json by_bit(const std::map<std::uint32_t, std::uint64_t>& counts) {
    Json json = Json::object();
    for (const auto& [bit, n] : counts)
        json[std::to_string(bit)] = n;
    return json;
}

void add_by_bit(const Json& json, std::map<std::uint32_t, std::uint64_t>& counts) {
    for (const auto& [bit, n] : json.items())
        counts[static_cast<std::uint32_t>(std::stoul(bit))] += n.get<std::uint64_t>();
}

/** " 3.2 color 1.1 value", per million. */
template <class Names>
std::string named(const std::map<std::uint32_t, std::uint64_t>& counts, const Names& names, double million) {
    std::string text;
    for (const auto& [bit, name] : names) {
        const auto found = counts.find(bit);
        if (found == counts.end() || found->second == 0)
            continue;
        char one[100];
        std::snprintf(one, sizeof one, " %.4g %s", static_cast<double>(found->second) / million, std::string(name).c_str());
        text += one;
    }
    return text;
}

std::string line_of(const std::string& kind, const std::string& precision, const Tally& t) {
    const double million = std::max(1.0, static_cast<double>(t.pixels)) / 1e6;
    const auto per_million = [&](std::uint64_t n) { return static_cast<double>(n) / million; };
    char text[400];
    std::snprintf(text, sizeof text, "%-16s %-8s %10llu px %9.3g %9.3g %9.3g %9.3g %9.3g %9.0f %9.0f  ", kind.c_str(),
                  precision.c_str(), static_cast<unsigned long long>(t.pixels), per_million(t.far), per_million(t.near),
                  per_million(t.all_false_alarms), per_million(t.flagged), per_million(t.undecidable),
                  static_cast<double>(t.pixels) / std::max(1e-9, t.render_seconds),
                  static_cast<double>(t.pixels) / std::max(1e-9, t.oracle_seconds));
    std::string line = text;
    const std::string silent = named(t.silent, buffer::names, million);
    if (!silent.empty())
        line += "silent:" + silent + " ";
    std::vector<std::pair<std::uint32_t, std::string_view>> flags;
    for (const FlagName& flag : named_flags)
        flags.emplace_back(flag.bit, flag.name);
    const std::string alarms = named(t.false_alarms, flags, million);
    return line + (alarms.empty() ? "" : "false:" + alarms) + "\n";
}

} // namespace

std::string to_text(const Sums& sums) {
    std::string text =
        "Per million pixels: silent errors beyond what rounding explains (far) and within it (near), false alarms, "
        "flagged, undecidable; then pixels a second of renderer and oracle.\n";
    text += "kind             precision    pixels          far      near     false   flagged  undecid.   draw/s  oracle/s\n";
    Sums all;
    for (const auto& [key, tally] : sums) {
        text += line_of(key.first, key.second, tally);
        all[{"all", key.second}] += tally;
    }
    for (const auto& [key, tally] : all)
        text += line_of(key.first, key.second, tally);
    return text;
}

bool has_silent(const Sums& sums) {
    return std::ranges::any_of(sums, [](const auto& one) { return one.second.near + one.second.far > 0; });
}

void write_sums(const Sums& sums, const std::string& path) {
    Json rows = Json::array();
    for (const auto& [key, tally] : sums) {
        Json row{{"kind", key.first}, {"precision", key.second}};
        for (const Member& member : members)
            row[member.name] = tally.*member.count;
        row["silent"] = by_bit(tally.silent);
        row["false_alarms_by_flag"] = by_bit(tally.false_alarms);
        row["render_seconds"] = tally.render_seconds;
        row["oracle_seconds"] = tally.oracle_seconds;
        rows.push_back(row);
    }
    std::ofstream file(path);
    file << Json{{"hunt", 1}, {"sums", rows}}.dump(1) << "\n";
    if (!file)
        throw Error(path, "cannot be written");
}

void add_sums(const std::string& path, Sums& sums) {
    std::ifstream file(path);
    if (!file)
        throw Error(path, "cannot be read");
    try {
        const Json json = Json::parse(file);
        for (const Json& row : json.at("sums")) {
            Tally tally;
            for (const Member& member : members)
                tally.*member.count = row.value(member.name, std::uint64_t{0});
            add_by_bit(row.at("silent"), tally.silent);
            add_by_bit(row.at("false_alarms_by_flag"), tally.false_alarms);
            tally.render_seconds = row.at("render_seconds");
            tally.oracle_seconds = row.at("oracle_seconds");
            sums[{row.at("kind"), row.at("precision")}] += tally;
        }
    } catch (const Json::exception& error) {
        throw Error(path, std::string("is no file of sums: ") + error.what());
    }
}

} // namespace elvis::hunt
