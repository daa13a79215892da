#include <core/scene/threshold.hpp>

#include <core/base/error.hpp>
#include <core/expression/expression.hpp>
#include <core/render/field/shown_field.hpp>
#include <core/scene/frame_request.hpp>
#include <core/scene/surface_distance.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

namespace elvis {

namespace {

std::string_view trimmed(std::string_view text) {
    const auto is_space = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
    while (!text.empty() && is_space(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && is_space(text.back())) {
        text.remove_suffix(1);
    }
    return text;
}

/** Where, from `from` on, one of the tokens stands outside of quotes and brackets; npos if none does. */
std::size_t find_outside(std::string_view text, std::span<const std::string_view> tokens, std::size_t from = 0) {
    int depth = 0;
    char quote = 0;
    for (std::size_t at = from; at < text.size(); ++at) {
        const char c = text[at];
        if (quote != 0) {
            quote = c == quote ? 0 : quote;
            continue;
        }
        const bool is_met = depth == 0 && std::ranges::any_of(tokens, [&](std::string_view token) {
                                return text.substr(at).starts_with(token);
                            });
        if (is_met) {
            return at;
        }
        quote = c == '"' || c == '\'' ? c : 0;
        depth += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
    }
    return std::string_view::npos;
}

/** Without parentheses around all of it. */
std::string_view opened(std::string_view text) {
    text = trimmed(text);
    constexpr std::array<std::string_view, 1> end = {")"};
    while (text.starts_with('(') && find_outside(text.substr(1), end) == text.size() - 2) {
        text = trimmed(text.substr(1, text.size() - 2));
    }
    return text;
}

class ThresholdReader {
public:
    ThresholdReader(const std::string& whole, const RuntimeVolume& volume) : m_whole(whole), m_volume(volume) {}

    void read(std::string_view text) {
        constexpr std::array<std::string_view, 1> joint = {"&&"};
        text = opened(text);
        const std::size_t at = find_outside(text, joint);
        if (at == std::string_view::npos) {
            conditions.push_back(comparison(text));
            return;
        }
        read(text.substr(0, at));
        read(text.substr(at + 2));
    }

    std::vector<Condition> conditions;

private:
    [[noreturn]] void refuse() const {
        throw Error("threshold", "'" + m_whole + "' is no comparison, such as 'p > 0.2': < <= > >= compare, && joins");
    }

    std::optional<double> number_of(const std::string& text) const {
        const Expression expression(text, m_volume.fields(), m_volume.dimension());
        const Node& node = expression.graph().node(expression.value());
        return node.operation == Operation::constant ? std::optional(node.number) : std::nullopt;
    }

    Condition comparison(std::string_view text) const {
        constexpr std::array<std::string_view, 6> others = {"||", "?", "==", "!=", "!", "&&"};
        constexpr std::array<std::string_view, 2> signs = {"<", ">"};
        const std::size_t at = find_outside(text, signs);
        if (at == std::string_view::npos || find_outside(text, others) != std::string_view::npos) {
            refuse();
        }
        Condition condition;
        condition.takes_equal = text.substr(at + 1).starts_with('=');
        condition.is_above = text[at] == '>';
        const std::string left(trimmed(text.substr(0, at)));
        const std::string right(trimmed(text.substr(at + (condition.takes_equal ? 2 : 1))));
        const std::optional<double> left_number = number_of(left), right_number = number_of(right);
        if (left_number && right_number) {
            refuse();
        }
        if (right_number) {
            condition.field = choose_field(m_volume, left);
            condition.value = *right_number;
        } else if (left_number) {
            condition.field = choose_field(m_volume, right);
            condition.value = *left_number;
            condition.is_above = !condition.is_above;
        } else {
            // A vector means its length: the sum with a number is one.
            condition.field = choose_field(m_volume, "0 + (" + left + ") - (" + right + ")");
        }
        if (!std::isfinite(condition.value)) {
            refuse();
        }
        return condition;
    }

    const std::string& m_whole;
    const RuntimeVolume& m_volume;
};

/** At a step, the density on one side of it. */
double density_beside(const TransferFunction& transfer, double value, bool is_above) {
    const auto& points = transfer.density;
    const auto value_of = &TransferFunction::DensityPoint::value;
    const auto after = is_above ? std::ranges::upper_bound(points, value, {}, value_of)
                                : std::ranges::lower_bound(points, value, {}, value_of);
    if (after == points.begin() || after == points.end()) {
        return after == points.begin() ? points.front().density : points.back().density;
    }
    const auto& [from, density] = *std::prev(after);
    return density + (value - from) / (after->value - from) * (after->density - density);
}

/** Leaves density only where the conditions hold. */
void cut_density(VolumeRendering& rendering, const std::vector<Condition>& conditions) {
    for (const Condition& condition : conditions) {
        if (condition.field != rendering.field) {
            throw Error("threshold", "can cut volume rendering only by the field that it shows; hide the volume rendering, or "
                                     "compare its field with numbers");
        }
        auto& points = rendering.transfer.density;
        const TransferFunction::DensityPoint edge{condition.value,
                                                  density_beside(rendering.transfer, condition.value, condition.is_above)};
        std::erase_if(points, [&](const TransferFunction::DensityPoint& point) {
            return condition.is_above ? point.value <= edge.value : point.value >= edge.value;
        });
        const TransferFunction::DensityPoint nothing{edge.value, 0};
        if (condition.is_above) {
            points.insert(points.begin(), {nothing, edge});
        } else {
            points.insert(points.end(), {edge, nothing});
        }
    }
}

} // namespace

std::vector<Condition> threshold_conditions(const std::string& text, const Scene& scene, const RuntimeVolume& volume) {
    const std::string whole = with_distances(text, scene.surfaces);
    // Errors of the language tell their column in what was written.
    const Expression checked(whole, volume.fields(), volume.dimension());
    ThresholdReader reader(text, volume);
    reader.read(whole);
    return reader.conditions;
}

void apply_threshold(const Scene& scene, const RuntimeVolume& volume, FrameRequest& request) {
    if (!scene.threshold) {
        return;
    }
    const std::vector<Condition> conditions = threshold_conditions(*scene.threshold, scene, volume);
    bool is_closed = false;
    for (Surface& surface : request.surfaces) {
        const SurfaceTraits traits = traits_of(surface.geometry);
        if (traits.wires == nullptr && !traits.has_own_values) {
            surface.conditions = conditions;
        }
        is_closed = is_closed || traits.is_whole_boundary;
    }
    const auto jumps = [&](const Condition& condition) { return may_jump(condition.field, volume); };
    if (is_closed && std::ranges::any_of(conditions, jumps)) {
        request.remarks.push_back(
            "threshold '" + *scene.threshold +
            "': its field may jump between elements; where it jumps past the value, what is shown is open");
    }
    if (request.volume) {
        cut_density(*request.volume, conditions);
    }
}

} // namespace elvis
