// GLSL, and C++. `u` is not known before the kernel runs.

uint core_known_sum(uint u) {
    uint a[4];
    for (int i = 0; i < 4; ++i) {
        a[i] = u * uint(i + 1);
    }
    uint sum = 0u;
    for (int i = 3; i >= 0; --i) {
        sum = 7u * sum + a[i];
    }
    return sum;
}

uint core_unknown_length(uint u) {
    uint sum = 1u;
    for (uint i = 0u; i < u % 9u; ++i) {
        sum = 3u * sum + i;
    }
    return sum;
}

// An array that is written before the loop, in it, and read behind it.
uint core_array_across(uint u) {
    uint a[3];
    a[0] = 5u;
    a[1] = u;
    a[2] = 9u;
    for (uint i = 0u; i < u % 5u; ++i) {
        a[1] += a[0];
        a[i % 3u] += 2u;
    }
    return a[0] + 100u * a[1] + 10000u * a[2];
}

uint core_ends_early(uint u) {
    uint sum = 0u;
    for (uint i = 0u; i < 6u; ++i) {
        if (i > u % 8u) {
            break;
        }
        sum += i * i;
    }
    return sum;
}

uint core_skips(uint u) {
    uint sum = 0u;
    for (uint i = 0u; i < 6u; ++i) {
        if (((u >> i) & 1u) == 0u) {
            continue;
        }
        sum = 2u * sum + i;
    }
    return sum;
}

uint core_skips_known(uint u) {
    uint sum = 0u;
    for (uint i = 0u; i < 6u; ++i) {
        if (i % 2u == 0u) {
            continue;
        }
        if (i == 5u) {
            break;
        }
        sum = 2u * sum + i * u;
    }
    return sum;
}

uint core_nested(uint u) {
    uint sum = 0u;
    for (uint i = 0u; i < 3u; ++i) {
        for (uint j = 0u; j < u % 4u; ++j) {
            for (uint k = i; k < 3u; ++k) {
                sum = 5u * sum + i + 2u * j + 3u * k;
            }
        }
    }
    return sum;
}

uint core_last_tested(uint u) {
    uint n = 0u;
    do {
        n += 3u;
    } while (n < 12u);
    uint v = u;
    do {
        v = v / 2u;
        n += v;
    } while (v > 3u);
    while (v < 20u) {
        v = 2u * v + 1u;
    }
    return n + 1000u * v;
}

uint core_too_long(uint u) {
    uint sum = u;
    for (uint i = 0u; i < 100u; ++i) {
        sum = 3u * sum + i;
    }
    return sum;
}

uint core_without_rounds(uint u) {
    uint sum = u;
    for (uint i = 4u; i < 4u; ++i) {
        sum += 1000u;
    }
    return sum;
}

struct core_stack {
    uint a[4];
    uint n;
};

// Some of it at places that are not known, and copied as a whole.
uint core_copied_stack(uint u) {
    core_stack s;
    s.n = 0u;
    for (uint i = 0u; i < 4u; ++i) {
        s.a[i] = 10u * i;
    }
    for (uint i = 0u; i < 4u; ++i) {
        if (((u >> i) & 1u) != 0u) {
            s.a[s.n] = u + i;
            s.n += 1u;
        }
    }
    core_stack t = s;
    t.a[1] = 77u;
    s.a[u % 4u] = 5u;
    uint sum = s.n;
    for (uint i = 0u; i < 4u; ++i) {
        sum = 101u * sum + 7u * s.a[i] + t.a[i];
    }
    return sum;
}

void core_add_to(INOUT(uint, sum), uint i) { sum = 3u * sum + i; }

void core_add_both(INOUT(uint, sum), uint i) {
    core_add_to(sum, i);
    core_add_to(sum, i + 1u);
}

// By functions of which the inner one writes.
uint core_written_by_calls(uint u) {
    uint sum = 1u;
    for (uint i = 0u; i < u % 7u; ++i) {
        core_add_both(sum, i);
    }
    return sum;
}
