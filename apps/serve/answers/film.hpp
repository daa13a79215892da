/**
 * @file film.hpp
 * The pictures of a scene's animation, one by one, as somebody asks for them.
 */
#pragma once

#include "draw.hpp"

#include <cstdint>
#include <optional>

namespace elvis::serve {

/** Longer ones are for `elvis render`. */
inline constexpr std::uint32_t most_film_pictures = 10000;

/** For one thread at a time. */
class Film {
public:
    /** Of a scene with the key "animation"; throws Error or elvis::error if it cannot be. Returns `n_pictures` and
     * `frames_a_second`. */
    nlohmann::json begin(const Served& served, const Scene& scene);
    bool has_begun() const { return m_animation.has_value(); }
    /** A PNG, the bytes of `elvis render`, and its `name` there. */
    Encoded picture(const Served& served, std::uint32_t index, const task& watch) const;

private:
    std::optional<animation> m_animation;
};

} // namespace elvis::serve
