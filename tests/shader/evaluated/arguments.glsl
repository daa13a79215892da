struct core_pair { uint a; uint b[3]; };
core_pair core_some() { return core_pair(1u, uint[](2u, 3u, 4u)); }
uint core_read(core_pair x) { return x.a + 10u * x.b[1]; }
// What is written to the one is not seen in the other.
uint core_write_and_read(inout core_pair x, core_pair y) {
    x.a = 7u;
    x.b[1] = 9u;
    return core_read(y);
}

// The caller's stays as it is.
uint core_write_own(core_pair x) {
    x.a += 100u;
    return core_read(x);
}

void core_write_through(inout core_pair x) {
    x.b[2] = core_write_own(x);
    x.a += 1u;
}

// Through another function's parameter.
uint core_write_deep(inout core_pair x, core_pair y) {
    core_write_through(x);
    return core_read(y);
}

uint core_add(inout uint x, inout uint y) {
    x += 1u;
    y += 10u;
    return 100u * x + y;
}

void core_part_first(inout uint part, inout core_pair x) {
    part = 50u;
    x.b[1] = 60u;
}

void core_part_last(inout core_pair x, inout uint part) {
    part = 50u;
    x.b[1] = 60u;
}

uint core_change(inout core_pair x) {
    x.a += 1u;
    x.b[1] += 1u;
    return x.a;
}

uint core_with(core_pair x, uint y) { return core_read(x) + 1000u * y; }
void core_set(out core_pair x, uint a) {
    x = core_some();
    x.a = a;
}

void arguments(uint u, uint first) {
    // Nothing of it is known before the kernel runs.
    core_pair p = core_some(), q = core_some();
    p.a += u;
    q.a += u;
    result[first + 0] = core_read(p);
    result[first + 1] = core_write_and_read(p, p);
    result[first + 2] = core_read(p);
    result[first + 3] = core_write_own(q);
    result[first + 4] = core_read(q);
    core_write_through(q);
    result[first + 5] = q.b[2];
    result[first + 6] = core_read(q);
    result[first + 7] = core_write_deep(q, q);
    result[first + 8] = core_read(q);
    uint x = 1u + u, v = 2u;
    result[first + 9] = core_add(x, v);
    result[first + 10] = 100u * x + v;
    // Of two arguments that are the same the last one is copied back last.
    core_add(x, x);
    result[first + 11] = x;
    q = core_some();
    q.b[0] += u;
    result[first + 12] = core_with(core_some(), core_change(q));
    result[first + 13] = core_with(q, core_change(p));
    q.a = 5u;
    result[first + 14] = core_read(q);
    for (uint i = 0u; i < 3u + u; ++i) {
        core_pair r = core_some();
        r.a = i;
        q.a += core_change(r) + core_with(r, i);
    }
    result[first + 15] = q.a;
    core_set(q, 6u);
    result[first + 16] = core_read(q);
    // A part of a variable beside the whole.
    core_part_first(q.b[1], q);
    result[first + 17] = q.b[1];
    core_part_last(q, q.b[1]);
    result[first + 18] = q.b[1];
}
