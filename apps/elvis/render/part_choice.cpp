#include "part_choice.hpp"

#include <core/base/error.hpp>
#include <core/parts/partition_file.hpp>

#include <charconv>
#include <optional>
#include <utility>

namespace elvis::commands {

namespace {

/** For the partition that the volume's file has. */
constexpr const char* own_parts_word = "own";

/** How many parts; nothing for the name of a file. */
std::optional<std::uint32_t> number_of_parts(const std::string& text) {
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_number = text.find_first_not_of("0123456789") == std::string::npos;
    if (is_number && (error != std::errc() || number < 1 || number > most_parts)) {
        throw UsageError("--parts", "there can be 1 to 1000000 parts, not " + text);
    }
    return is_number ? std::optional(number) : std::nullopt;
}

} // namespace

void check_parts(const RenderArguments& arguments, bool is_animation) {
    if (arguments.parts.empty()) {
        if (arguments.team != nullptr) {
            throw UsageError("render", "needs --parts: processes draw parts of the volume");
        }
        return;
    }
    number_of_parts(arguments.parts);
    for (const auto& [option, is_given] :
         {std::pair{"--devices", !arguments.devices.empty()}, std::pair{"--repeat", arguments.repeat > 0},
          std::pair{"--share", !arguments.share.empty()}}) {
        if (is_given) {
            throw UsageError(option, "does not go with --parts");
        }
    }
    if (is_animation && !arguments.stats.empty()) {
        throw UsageError("--stats", "with --parts is of single pictures, not of animations");
    }
}

Partition partition_of(const RenderArguments& arguments, const VolumeToPart& volume) {
    if (arguments.parts == own_parts_word) {
        return own_partition(volume.source.get(), volume.whole);
    }
    const std::optional<std::uint32_t> n_parts = number_of_parts(arguments.parts);
    return n_parts ? Partition::in_shares(volume.whole.n_elements(), *n_parts) : read_partition(arguments.parts, volume.whole);
}

} // namespace elvis::commands
