/*
 * The smallest plugin that the host recognizes, in C: it converts no file and says so.
 */
#include <elvis/converter.h>
#include <elvis/plugin.h>

#include <string.h>

static elvis_result probe(const elvis_host* host, const char* path, uint32_t* confidence) {
    (void)host;
    (void)path;
    *confidence = 0;
    return ELVIS_OK;
}

static elvis_result open(const elvis_host* host, const char* const* paths, uint32_t n_paths, const char* options,
                         elvis_source_volume** source) {
    (void)n_paths;
    (void)options;
    (void)source;
    host->set_error(host, paths[0], "this plugin reads nothing");
    return ELVIS_ERROR_UNSUPPORTED;
}

/* Never called, since nothing is ever open. */
static void close(elvis_source_volume* source) { (void)source; }
static elvis_result get_info(elvis_source_volume* source, elvis_source_info* info) {
    (void)source;
    (void)info;
    return ELVIS_ERROR_FAILED;
}
static elvis_result get_field(elvis_source_volume* source, uint32_t field, elvis_source_field* out) {
    (void)source;
    (void)field;
    (void)out;
    return ELVIS_ERROR_FAILED;
}
static elvis_result get_elements(elvis_source_volume* source, uint64_t first, uint64_t count, elvis_source_element* out) {
    (void)source;
    (void)first;
    (void)count;
    (void)out;
    return ELVIS_ERROR_FAILED;
}
static elvis_result get_spaces(elvis_source_volume* source, uint32_t field, uint64_t first, uint64_t count,
                               elvis_source_space* out) {
    (void)field;
    (void)out;
    return get_elements(source, first, count, NULL);
}
static elvis_result evaluate_mapping(elvis_source_volume* source, uint64_t element, uint64_t n_points, const double* xi,
                                     double* positions) {
    (void)xi;
    (void)positions;
    return get_elements(source, element, n_points, NULL);
}
static elvis_result sample(elvis_source_volume* source, uint32_t time_step, uint64_t element, uint64_t n_points,
                           const double* xi, double* values) {
    (void)time_step;
    return evaluate_mapping(source, element, n_points, xi, values);
}

static const elvis_converter converter = {.struct_size = sizeof converter,
                                          .probe = probe,
                                          .open = open,
                                          .close = close,
                                          .get_info = get_info,
                                          .get_field = get_field,
                                          .get_elements = get_elements,
                                          .get_spaces = get_spaces,
                                          .evaluate_mapping = evaluate_mapping,
                                          .sample = sample};

static const void* get_interface(const char* interface_id) {
    return strcmp(interface_id, ELVIS_CONVERTER_INTERFACE) == 0 ? &converter : NULL;
}

const elvis_plugin_descriptor* elvis_plugin_get_descriptor(void) {
    static const elvis_plugin_descriptor descriptor = {.struct_size = sizeof descriptor,
                                                       .abi_version = ELVIS_ABI_VERSION,
                                                       .id = "org.example.outside-in-c",
                                                       .name = "Outside, in C",
                                                       .version = "1.0.0",
                                                       .get_interface = get_interface};
    return &descriptor;
}
