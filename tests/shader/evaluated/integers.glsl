// GLSL, and C++.

uint core_wraps(uint u) {
    uint most = 4294967295u;
    int least = -7;
    uint sum = most + 3u;
    sum = 31u * sum + (most >> 28u);
    sum = 31u * sum + uint(least >> 1);
    sum = 31u * sum + uint(least * 3);
    sum = 31u * sum + (1u << 31u);
    sum = 31u * sum + (least < 3 ? 1u : 0u);
    sum = 31u * sum + (uint(least) < 3u ? 1u : 0u);
    sum = 31u * sum + (~5u & 255u) + (6u ^ 3u) + 17u / 5u + 17u % 5u;
    sum = 31u * sum + uint(17 / 5) + uint(17 % 5) + uint(-(-4));
    return sum + u;
}
