#ifndef CORE_DRIVER_LIMIT
#define CORE_DRIVER_LIMIT

// Whether the driver has ended a loop, of the snippet too, before it was done: if it has, it ends this loop early, too.
//
// `zero` is 0 at run time; the compiler must not know that. Callers pass the highest bit of a number that is never so large, as
// core_size.x >> 31.
bool core_has_driver_given_up(uint zero) {
    uint canary = 0u;
    while (canary < 2u + zero) {
        canary += 1u;
    }
    return canary < 2u;
}

#endif
