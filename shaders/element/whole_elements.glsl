// From here on elements count as if none were cut (element/inside.glsl).

#undef ELVIS_HAS_INSIDE
#define ELVIS_HAS_INSIDE 0
