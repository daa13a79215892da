// In archives that are made for programs, stdout and stderr have a fixed place in the program. Shared libraries, such as
// plugins, take these in their place (archives.cmake).
#include <stdio.h>

extern FILE* elvis_stdout;
extern FILE* elvis_stderr;
FILE* elvis_stdout;
FILE* elvis_stderr;

// Before all that may write.
__attribute__((constructor(101))) static void set_streams(void) {
    elvis_stdout = stdout;
    elvis_stderr = stderr;
}
