/**
 * @file open_volume.hpp
 * Opening what the command line names, with a sign that it goes on where files are converted for it.
 */
#pragma once

#include "long_task.hpp"

#include <elvis/elvis.hpp>

#include <functional>
#include <utility>

namespace elvis::commands {

/** `open` gets a task that shows progress and that an interrupt stops. */
inline data open_watched(const std::function<data(const task& watch)>& open) {
    TaskControl control;
    const ProgressBar progress(control);
    const InterruptGuard guard(control);
    return open({[&](double fraction, const char* activity) { control.progress(fraction, activity); },
                 [&] { return control.is_cancelled(); }});
}

} // namespace elvis::commands
