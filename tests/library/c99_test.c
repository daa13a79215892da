/* Both public headers of programs and plugins, in one C99 file. */
#include <elvis/editing.h>
#include <elvis/elvis.h>
#include <elvis/insitu.h>
#include <elvis/plugin.h>
#include <elvis/runtime.h>

#include <string.h>

/* Calls what a program calls first; returns whether all was as it should be. */
int elvis_is_usable_from_c(void);

int elvis_is_usable_from_c(void) {
    elvis_context_options options;
    memset(&options, 0, sizeof options);
    options.struct_size = sizeof options;
    options.flags = ELVIS_CONTEXT_NO_ENVIRONMENT;
    options.plugin_path = "";
    options.cache_folder = "";
    elvis_context* context = NULL;
    if (elvis_context_create(&options, &context) != ELVIS_OK) {
        return 0;
    }
    elvis_data* data = NULL;
    const int is_refused = elvis_data_open(context, "/no/such/file", NULL, NULL, NULL, &data) == ELVIS_ERROR_FAILED &&
                           data == NULL && strstr(elvis_context_error(context), "/no/such/file") != NULL;
    elvis_context_release(context);
    return is_refused && elvis_library_version() == ELVIS_LIBRARY_VERSION;
}
