// What of a line lies in the square of one pixel, as a straight stretch in one word: its ends in 127ths of a pixel from the square's
// upper left corner. Zero: there is none.

#ifndef CORE_LINE_STRETCH
#define CORE_LINE_STRETCH

#define CORE_STRETCH_THERE 0x80000000u
// The line surely meets the pixel.
#define CORE_STRETCH_DECIDED 0x40000000u

// Of a pixel's two stretches.
#define CORE_STRETCH_CONTOUR 0u
#define CORE_STRETCH_MESH_LINE 1u

// `from`, `to`: relative to the pixel's middle.
uint core_stretch_word(vec2 from, vec2 to, bool is_decided) {
    const uvec4 at = uvec4(round(127.0 * (clamp(vec4(from, to), -0.5, 0.5) + 0.5)));
    return CORE_STRETCH_THERE | (is_decided ? CORE_STRETCH_DECIDED : 0u) | at.x | at.y << 7 | at.z << 14 | at.w << 21;
}

// From the pixel's middle.
vec2 core_stretch_begin(uint word) { return vec2(word & 127u, word >> 7 & 127u) / 127.0 - 0.5; }
vec2 core_stretch_end(uint word) { return vec2(word >> 14 & 127u, word >> 21 & 127u) / 127.0 - 0.5; }

// The square of the distance from a point to the stretch between two others.
float core_square_to_stretch(vec2 point, vec2 from, vec2 to) {
    const vec2 along = to - from, away = point - from;
    const float square = dot(along, along);
    const float share = square > 0.0 ? clamp(dot(away, along) / square, 0.0, 1.0) : 0.0;
    const vec2 apart = away - share * along;
    return dot(apart, apart);
}

#endif
