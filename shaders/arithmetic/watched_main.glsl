// In place of a kernel's main, which has become core_kernel_main: tells the host if the driver has ended a loop of an invocation early
// (KernelRequest::watches_loops). The composer defines CORE_WATCH_BINDING.

#include "arithmetic/driver_limit.glsl"

layout(set = 0, binding = CORE_WATCH_BINDING, std430) buffer core_watch_block { uint core_is_cut_short; };

void main() {
    core_kernel_main();
    if (core_has_driver_given_up(core_is_cut_short >> 31)) {
        core_is_cut_short = 1u;
    }
}
