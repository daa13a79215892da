#ifndef CORE_DRIVER_LIMIT
#define CORE_DRIVER_LIMIT

// Whether the driver has ended a loop, of the snippet too, before it was done: then this one ends before its second iteration. `zero`:
// zero, but not so that a compiler could know.
bool core_has_driver_given_up(uint zero) {
    uint canary = 0u;
    while (canary < 2u + zero) {
        canary += 1u;
    }
    return canary < 2u;
}

#endif
