/**
 * @file render_session.hpp
 * What pictures that are drawn one after the other have in common.
 */
#pragma once

#include "render_options.hpp"

#include <elvis/elvis.hpp>

#include <optional>
#include <string>

namespace elvis::commands {

/** The last scene's volume: the next scene of that volume finds its data and kernels there. */
class RenderSession {
public:
    explicit RenderSession(const context& library) : m_library(library) {}

    /** Opens the scene's volume unless it is open. What was opened before is gone if it is another. */
    data& open(const scene& shown);
    const context& library() const { return m_library; }
    /** What opening the volume took; 0 if it was open. */
    double load_milliseconds() const { return m_load_milliseconds; }

private:
    context m_library;
    std::optional<data> m_data;
    /** Files, plugin and options of what is open. */
    std::string m_key;
    double m_load_milliseconds = 0;
};

} // namespace elvis::commands
