#include "reductions.hpp"

#include <core/base/error.hpp>
#include <core/expression/evaluate.hpp>
#include <core/integrate/integral.hpp>
#include <core/scene/frame_request.hpp>

#include <array>
#include <limits>
#include <string_view>
#include <utility>

namespace elvis::library {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/** Where an expression of numbers alone is evaluated. */
class NumbersPoint final : public ExpressionPoint {
public:
    explicit NumbersPoint(std::vector<double> numbers) : m_numbers(std::move(numbers)) {}
    double value(std::uint32_t field, std::uint32_t) override { return m_numbers[field]; }
    Vector3 position() override { outside(); }
    std::array<double, 9> jacobian() override { outside(); }
    std::array<double, 27> mapping_hessian() override { outside(); }
    Vector3 gradient(std::uint32_t, std::uint32_t) override { outside(); }
    std::array<double, 9> hessian(std::uint32_t, std::uint32_t) override { outside(); }
    double order(std::uint32_t) override { outside(); }
    double element_number() override { outside(); }

private:
    [[noreturn]] static void outside() {
        throw Error("coordinates, derivatives and elements have a meaning only inside maximum(), minimum() and integral()");
    }

    std::vector<double> m_numbers;
};

bool is_letter(char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9') ||
           letter == '_';
}

/** The place after the parenthesis that closes the one before `from`; npos if none does. Quoted text is passed over. */
std::size_t after_closing(const std::string& text, std::size_t from) {
    int depth = 1;
    for (char quote = 0; from < text.size() && depth > 0; ++from) {
        const char letter = text[from];
        if (quote != 0) {
            quote = letter == quote ? 0 : quote;
        } else if (letter == '"' || letter == '\'') {
            quote = letter;
        } else {
            depth += letter == '(' ? 1 : letter == ')' ? -1 : 0;
        }
    }
    return depth == 0 ? from : std::string::npos;
}

struct ReductionWord {
    std::string_view text;
    Reduction::Kind kind;
};
constexpr std::array reduction_words{ReductionWord{"maximum(", Reduction::Kind::maximum},
                                     ReductionWord{"minimum(", Reduction::Kind::minimum},
                                     ReductionWord{"integral(", Reduction::Kind::integral}};

/** Puts a name in the place of each reduction. */
std::string without_reductions(const std::string& text, std::vector<Reduction>& found) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const auto begins = [&](const ReductionWord& word) {
            return text.compare(at, word.text.size(), word.text) == 0 && (at == 0 || !is_letter(text[at - 1]));
        };
        const auto word = std::ranges::find_if(reduction_words, begins);
        if (word == reduction_words.end()) {
            result += text[at++];
            continue;
        }
        const std::size_t inside = at + word->text.size(), end = after_closing(text, inside);
        if (end == std::string::npos) {
            throw Error("'" + text + "'", "a parenthesis is not closed");
        }
        found.push_back({word->kind, text.substr(inside, end - 1 - inside)});
        result.append("\"#").append(std::to_string(found.size())).append("\"");
        at = end;
    }
    return result;
}

std::vector<FieldInfo> names_of(std::size_t n_reductions) {
    std::vector<FieldInfo> names(2 + n_reductions);
    names[0].name = "step";
    names[1].name = "time";
    for (std::size_t index = 0; index < n_reductions; ++index) {
        names[2 + index].name.append("#").append(std::to_string(index + 1));
    }
    return names;
}

} // namespace

Reductions::Reductions(const InsituVolume& volume, CommunicatorTeam& team, const TaskControl& control,
                       std::function<const Device&()> device)
    : m_volume(volume), m_team(team), m_control(control) {
    if (volume.own() != nullptr) {
        m_extrema.emplace(*volume.own(), std::move(device));
    }
}

double Reductions::of_own(const Reduction& reduction) {
    const bool is_integral = reduction.kind == Reduction::Kind::integral;
    if (m_volume.own() == nullptr) {
        return is_integral ? 0 : infinite;
    }
    if (is_integral) {
        IntegralRequest request;
        request.field = reduction.field;
        return integrate(*m_volume.own(), request, m_control).value;
    }
    const FieldExtrema found = m_extrema->of(choose_field(*m_volume.own(), reduction.field), 0);
    const double value = reduction.kind == Reduction::Kind::maximum ? -found.maximum.value : found.minimum.value;
    return value == value ? value : infinite; // NaN: no value is finite.
}

double Reductions::of(const Reduction& reduction) {
    if (const auto known = m_known.find(reduction); known != m_known.end()) {
        return known->second;
    }
    double value = of_own(reduction);
    if (reduction.kind == Reduction::Kind::integral) {
        // Added in the order of ranks: the same on all.
        const std::vector<double> parts = m_team.joined({value});
        value = 0;
        for (const double part : parts) {
            value += part;
        }
    } else {
        m_team.minimum(std::span(&value, 1));
        value = reduction.kind == Reduction::Kind::maximum ? -value : value;
    }
    return m_known[reduction] = value;
}

void Reductions::forget_fields() {
    m_known.clear();
    if (m_extrema) {
        m_extrema->forget_fields();
    }
}

Quantity::Quantity(const std::string& text, const RuntimeVolume& volume) : m_text(text) {
    const std::string rest = without_reductions(text, m_reductions);
    for (const Reduction& reduction : m_reductions) {
        if (reduction.field.empty()) {
            throw Error("'" + text + "'", "a reduction has no field");
        }
        choose_field(volume, reduction.field);
    }
    try {
        m_expression.emplace(rest, names_of(m_reductions.size()));
        NumbersPoint any(std::vector<double>(2 + m_reductions.size(), 1.0));
        evaluate(*m_expression, any);
    } catch (const Error& error) {
        throw Error("'" + text + "'", error.cause());
    }
}

double Quantity::value(Reductions& reductions, std::uint64_t step, double time) const {
    std::vector<double> numbers{static_cast<double>(step), time};
    for (const Reduction& reduction : m_reductions) {
        numbers.push_back(reductions.of(reduction));
    }
    NumbersPoint point(std::move(numbers));
    return evaluate(*m_expression, point);
}

} // namespace elvis::library
