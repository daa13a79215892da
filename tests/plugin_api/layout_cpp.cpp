// The same assertions in C++: both languages see one layout.
#include "layout.c"
