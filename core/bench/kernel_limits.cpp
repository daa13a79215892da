#include <core/bench/kernel_limits.hpp>

#include <core/base/error.hpp>

#include <algorithm>
#include <fstream>
#include <ostream>
#include <sstream>

namespace elvis {

namespace {

constexpr const char* column_names = "kernel,shape,precision,spills,scratch_bytes,waves";

std::string text(const KernelKey& key) { return key.kernel + " " + key.shape + " " + name_of(key.precision); }

std::string text(const KernelLimit& limit) {
    return std::to_string(limit.spills) + " spills, " + std::to_string(limit.scratch_bytes) + " bytes of scratch memory, " +
           std::to_string(limit.waves) + " waves";
}

} // namespace

KernelLimits limits_of(std::span<const KernelRow> rows, const std::string& driver) {
    KernelLimits limits{driver, {}};
    for (const KernelRow& row : rows) {
        const KernelStatistics& told = row.statistics;
        const KernelLimit needs{told.spills.value_or(0), told.scratch_bytes.value_or(0), told.waves.value_or(0)};
        const auto [found, is_new] = limits.of.try_emplace({row.kernel, row.shape, row.precision}, needs);
        if (!is_new) {
            KernelLimit& worst = found->second;
            worst.spills = std::max(worst.spills, needs.spills);
            worst.scratch_bytes = std::max(worst.scratch_bytes, needs.scratch_bytes);
            worst.waves = std::min(worst.waves, needs.waves);
        }
    }
    return limits;
}

void write_limits(std::ostream& file, const KernelLimits& limits) {
    file << "# " << limits.driver << '\n' << column_names << '\n';
    for (const auto& [key, limit] : limits.of) {
        file << key.kernel << ',' << key.shape << ',' << name_of(key.precision) << ',' << limit.spills << ','
             << limit.scratch_bytes << ',' << limit.waves << '\n';
    }
}

KernelLimits read_limits(const std::string& path) {
    std::ifstream file(path);
    KernelLimits limits;
    std::string line;
    if (!std::getline(file, line) || line.rfind("# ", 0) != 0) {
        throw Error(path, "its first line does not name a driver behind '# '");
    }
    limits.driver = line.substr(2);
    if (!std::getline(file, line) || line != column_names) {
        throw Error(path, std::string("its second line is not ") + column_names);
    }
    for (int number = 3; std::getline(file, line); ++number) {
        std::ranges::replace(line, ',', ' ');
        std::istringstream words(line);
        KernelKey key;
        KernelLimit limit;
        std::string precision;
        words >> key.kernel >> key.shape >> precision >> limit.spills >> limit.scratch_bytes >> limit.waves;
        const std::optional<Precision> known = precision_named(precision);
        if (!words || !known) {
            throw Error(path + ", line " + std::to_string(number), "not a kernel, shape, precision and three numbers");
        }
        key.precision = *known;
        limits.of[key] = limit;
    }
    return limits;
}

std::vector<std::string> worse_kernels(const KernelLimits& found, const KernelLimits& allowed) {
    std::vector<std::string> lines;
    for (const auto& [key, needs] : found.of) {
        const auto limit = allowed.of.find(key);
        if (limit == allowed.of.end()) {
            lines.push_back(text(key) + ": no limit is known; it has " + text(needs));
        } else if (needs.spills > limit->second.spills || needs.scratch_bytes > limit->second.scratch_bytes ||
                   needs.waves < limit->second.waves) {
            lines.push_back(text(key) + ": " + text(needs) + "; the limit is " + text(limit->second));
        }
    }
    return lines;
}

} // namespace elvis
