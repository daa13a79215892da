#include <core/base/cancel.hpp>
#include <core/base/error.hpp>

namespace elvis {

void TaskControl::check() const {
    if (cancelled.load(std::memory_order_relaxed)) {
        throw Cancelled();
    }
}

void TaskControl::progress(double fraction, std::string_view activity) const {
    if (on_progress) {
        on_progress(fraction, activity);
    }
}

} // namespace elvis
