/**
 * @file serve.hpp
 * Native volumes as a runtime plugin serves them: the tables of elvis/runtime.h, elvis/extrema.h and elvis/apex_bounds.h.
 */
#pragma once

#include <elvis/apex_bounds.h>
#include <elvis/extrema.h>
#include <elvis/native/volume_source.hpp>
#include <elvis/runtime.h>

#include <memory>
#include <string>

namespace elvis::native {

/** They live as long as the program. The first opens files, and serves what `serve` gives. */
const elvis_runtime* runtime_table();
const elvis_extrema* extrema_table();
const elvis_apex_bounds* apex_bounds_table();

/**
 * A volume for those tables, to be released by runtime_table()->close. `host` is valid until then; `name` stands for the file
 * in messages. Throws elvis::api::Error where the volume cannot be drawn (orders above 16).
 */
elvis_volume* serve(const elvis_host* host, const std::string& name, std::shared_ptr<const VolumeSource> source);

/** Values of the source's fields have changed: what was read of them is read again. `volume` is from `serve`. */
void forget_fields(elvis_volume* volume);

} // namespace elvis::native
