#include <core/base/cancel.hpp>
#include <core/base/error.hpp>

namespace elvis {

bool TaskControl::is_cancelled() const {
    return cancelled.load(std::memory_order_relaxed) || (wants_to_stop && wants_to_stop());
}

void TaskControl::check() const {
    if (is_cancelled()) {
        throw Cancelled();
    }
}

void TaskControl::progress(double fraction, std::string_view activity) const {
    if (on_progress) {
        on_progress(fraction, activity);
    }
}

} // namespace elvis
