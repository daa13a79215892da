/* A plugin without fault, in C, with both interfaces. */
#include "cube.h"
#include "descriptor.h"
#include "tetrahedron.h"

static const elvis_runtime runtime = {CUBE_RUNTIME(sizeof runtime)};
static const elvis_converter converter = {TETRAHEDRON_CONVERTER(sizeof converter), .sample = tetrahedron_sample};

FIXTURE_PLUGIN("org.elvis.test.good", ELVIS_ABI_VERSION, &runtime, &converter)
