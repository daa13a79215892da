// GLSL, and C++. `u` is not known before the kernel runs.

uint core_guards(uint u) {
    if (u < 5u) {
        return 1u;
    }
    if (u % 3u == 0u) {
        return 2u + u;
    }
    uint v = u * u;
    if (u % 3u == 1u) {
        v += 7u;
    } else {
        return v + 3u;
    }
    return v;
}

uint core_both_return(uint u) {
    if (u % 2u == 0u) {
        return u / 2u;
    } else {
        return 3u * u + 1u;
    }
}

uint core_changes_in_one(uint u) {
    uint a = 3u;
    uint b = 4u;
    if (u > 20u) {
        a = 5u;
        b = u;
    } else if (u > 10u) {
        b = 6u;
    }
    if (a == 3u) {
        b += 100u;
    }
    return 1000u * a + b;
}

// Both branches store the same.
uint core_agrees(uint u) {
    uint a = 1u;
    if (u > 7u) {
        a = 2u;
    } else {
        a = 2u;
    }
    return a + u;
}

bool core_step(INOUT(uint, n), uint u) {
    n += 1u;
    return u % 2u == 0u;
}

uint core_short_circuit(uint u) {
    uint n = 0u;
    bool a = u > 9u && core_step(n, u);
    bool b = u > 30u || core_step(n, u + 1u) || core_step(n, u);
    return n + (a ? 10u : 0u) + (b ? 100u : 0u);
}

void core_nothing(INOUT(uint, n), uint u) {
    if (u == 4u) {
        return;
    }
    n += u;
}

uint core_calls_nothing(uint u) {
    uint n = 1u;
    core_nothing(n, u);
    core_nothing(n, 4u);
    core_nothing(n, 5u);
    return n;
}
