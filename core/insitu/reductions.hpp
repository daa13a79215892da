/**
 * @file reductions.hpp
 * Numbers that stand for a field over the whole volume, and expressions of them.
 *
 *     maximum(p)   minimum(|grad p|)   integral(p^2)
 */
#pragma once

#include "communicator_team.hpp"
#include "insitu_volume.hpp"

#include <core/base/cancel.hpp>
#include <core/expression/expression.hpp>
#include <core/session/volume/extrema_finder.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace elvis::library {

/** Of a field or expression over all elements. */
struct Reduction {
    enum class Kind { maximum, minimum, integral };
    Kind kind = Kind::maximum;
    std::string field;

    auto operator<=>(const Reduction&) const = default;
};

/** Finds reductions by all ranks together, each once for the same values. */
class Reductions {
public:
    /** `device`: where a device alone can tell. All must outlive it. */
    Reductions(const InsituVolume& volume, CommunicatorTeam& team, const TaskControl& control,
               std::function<const Device&()> device);

    /** Collective. Infinite where no value is finite. */
    double of(const Reduction& reduction);
    /** Values have changed. */
    void forget_fields();

private:
    double of_own(const Reduction& reduction);

    const InsituVolume& m_volume;
    CommunicatorTeam& m_team;
    const TaskControl& m_control;
    std::optional<ExtremaFinder> m_extrema;
    std::map<Reduction, double> m_known;
};

/** An expression of reductions, `step` and `time`, as expressions of fields are (core/expression/expression.hpp). */
class Quantity {
public:
    /** Throws Error for what is not understood, or what the volume does not have. */
    Quantity(const std::string& text, const RuntimeVolume& volume);

    const std::string& text() const { return m_text; }
    /** Collective. */
    double value(Reductions& reductions, std::uint64_t step, double time) const;

private:
    std::string m_text;
    std::vector<Reduction> m_reductions;
    /** Over names that stand for step, time and the reductions. */
    std::optional<Expression> m_expression;
};

} // namespace elvis::library
