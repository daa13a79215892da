/*
 * Layout of every struct that crosses the boundary, for 64-bit machines: a line that no longer holds means that plugins
 * already built break. A new member is added here at the end of its struct, with the size that follows; nothing else may
 * change.
 *
 * Compiled as C and as C++.
 */
#include <elvis/converter.h>
#include <elvis/plugin.h>
#include <elvis/runtime.h>

#include <stddef.h>

#ifdef __cplusplus
#define CHECK_LAYOUT(condition) static_assert(condition, #condition)
#else
#define CHECK_LAYOUT(condition) _Static_assert(condition, #condition)
#endif
#define SIZE(type, size) CHECK_LAYOUT(sizeof(type) == (size))
#define OFFSET(type, member, offset) CHECK_LAYOUT(offsetof(type, member) == (offset))

CHECK_LAYOUT(sizeof(void*) == 8);
CHECK_LAYOUT(sizeof(elvis_result) == 4);

SIZE(elvis_host, 48);
OFFSET(elvis_host, struct_size, 0);
OFFSET(elvis_host, abi_version, 4);
OFFSET(elvis_host, context, 8);
OFFSET(elvis_host, log, 16);
OFFSET(elvis_host, report_progress, 24);
OFFSET(elvis_host, is_cancelled, 32);
OFFSET(elvis_host, set_error, 40);

SIZE(elvis_plugin_descriptor, 56);
OFFSET(elvis_plugin_descriptor, struct_size, 0);
OFFSET(elvis_plugin_descriptor, abi_version, 4);
OFFSET(elvis_plugin_descriptor, id, 8);
OFFSET(elvis_plugin_descriptor, name, 16);
OFFSET(elvis_plugin_descriptor, version, 24);
OFFSET(elvis_plugin_descriptor, vendor, 32);
OFFSET(elvis_plugin_descriptor, description, 40);
OFFSET(elvis_plugin_descriptor, get_interface, 48);

SIZE(elvis_face, 32);
OFFSET(elvis_face, struct_size, 0);
OFFSET(elvis_face, group, 4);
OFFSET(elvis_face, element, 8);
OFFSET(elvis_face, neighbour, 16);
OFFSET(elvis_face, local_face, 24);
OFFSET(elvis_face, neighbour_local_face, 28);

SIZE(elvis_volume_info, 48);
OFFSET(elvis_volume_info, struct_size, 0);
OFFSET(elvis_volume_info, dimension, 4);
OFFSET(elvis_volume_info, n_elements, 8);
OFFSET(elvis_volume_info, n_faces, 16);
OFFSET(elvis_volume_info, n_classes, 24);
OFFSET(elvis_volume_info, n_boundary_groups, 28);
OFFSET(elvis_volume_info, n_fields, 32);
OFFSET(elvis_volume_info, n_time_steps, 36);
OFFSET(elvis_volume_info, n_buffers, 40);
OFFSET(elvis_volume_info, n_notes, 44);

SIZE(elvis_element_class, 32);
OFFSET(elvis_element_class, struct_size, 0);
OFFSET(elvis_element_class, shape, 4);
OFFSET(elvis_element_class, n_elements, 8);
OFFSET(elvis_element_class, geometry_order, 16);
OFFSET(elvis_element_class, is_affine, 28);

SIZE(elvis_constant, 24);
OFFSET(elvis_constant, struct_size, 0);
OFFSET(elvis_constant, reserved, 4);
OFFSET(elvis_constant, name, 8);
OFFSET(elvis_constant, value, 16);

SIZE(elvis_class_field, 32);
OFFSET(elvis_class_field, struct_size, 0);
OFFSET(elvis_class_field, n_constants, 4);
OFFSET(elvis_class_field, constants, 8);
OFFSET(elvis_class_field, order, 16);
OFFSET(elvis_class_field, reserved, 28);

SIZE(elvis_field, 40);
OFFSET(elvis_field, struct_size, 0);
OFFSET(elvis_field, n_components, 4);
OFFSET(elvis_field, name, 8);
OFFSET(elvis_field, unit, 16);
OFFSET(elvis_field, continuity, 24);
OFFSET(elvis_field, transform, 28);
OFFSET(elvis_field, max_jump, 32);

SIZE(elvis_buffer, 40);
OFFSET(elvis_buffer, struct_size, 0);
OFFSET(elvis_buffer, kind, 4);
OFFSET(elvis_buffer, name, 8);
OFFSET(elvis_buffer, element_class, 16);
OFFSET(elvis_buffer, depends, 20);
OFFSET(elvis_buffer, n_records, 24);
OFFSET(elvis_buffer, record_size, 32);
OFFSET(elvis_buffer, reserved, 36);

SIZE(elvis_fill_request, 48);
OFFSET(elvis_fill_request, struct_size, 0);
OFFSET(elvis_fill_request, buffer, 4);
OFFSET(elvis_fill_request, field, 8);
OFFSET(elvis_fill_request, time_step, 12);
OFFSET(elvis_fill_request, first, 16);
OFFSET(elvis_fill_request, count, 24);
OFFSET(elvis_fill_request, field_offset, 32);
OFFSET(elvis_fill_request, origins, 40);

SIZE(elvis_text, 24);
OFFSET(elvis_text, struct_size, 0);
OFFSET(elvis_text, reserved, 4);
OFFSET(elvis_text, name, 8);
OFFSET(elvis_text, text, 16);

SIZE(elvis_snippet, 32);
OFFSET(elvis_snippet, struct_size, 0);
OFFSET(elvis_snippet, capabilities, 4);
OFFSET(elvis_snippet, prefix, 8);
OFFSET(elvis_snippet, n_sources, 16);
OFFSET(elvis_snippet, reserved, 20);
OFFSET(elvis_snippet, sources, 24);

SIZE(elvis_jacobian_check, 48);
OFFSET(elvis_jacobian_check, struct_size, 0);
OFFSET(elvis_jacobian_check, sign, 4);
OFFSET(elvis_jacobian_check, xi, 8);
OFFSET(elvis_jacobian_check, determinant, 32);
OFFSET(elvis_jacobian_check, lower, 40);

SIZE(elvis_runtime, 176);
OFFSET(elvis_runtime, struct_size, 0);
OFFSET(elvis_runtime, reserved, 4);
OFFSET(elvis_runtime, probe, 8);
OFFSET(elvis_runtime, open, 16);
OFFSET(elvis_runtime, close, 24);
OFFSET(elvis_runtime, get_info, 32);
OFFSET(elvis_runtime, get_class, 40);
OFFSET(elvis_runtime, get_field, 48);
OFFSET(elvis_runtime, get_class_field, 56);
OFFSET(elvis_runtime, get_time, 64);
OFFSET(elvis_runtime, get_buffer, 72);
OFFSET(elvis_runtime, get_snippet, 80);
OFFSET(elvis_runtime, get_bounds, 88);
OFFSET(elvis_runtime, fill_buffer, 96);
OFFSET(elvis_runtime, get_element_numbers, 104);
OFFSET(elvis_runtime, get_faces, 112);
OFFSET(elvis_runtime, get_boundary_group, 120);
OFFSET(elvis_runtime, get_field_ranges, 128);
OFFSET(elvis_runtime, get_note, 136);
OFFSET(elvis_runtime, evaluate_mapping, 144);
OFFSET(elvis_runtime, evaluate_field, 152);
OFFSET(elvis_runtime, get_field_derivative_bounds, 160);
OFFSET(elvis_runtime, check_jacobians, 168);

SIZE(elvis_source_info, 48);
OFFSET(elvis_source_info, struct_size, 0);
OFFSET(elvis_source_info, dimension, 4);
OFFSET(elvis_source_info, n_elements, 8);
OFFSET(elvis_source_info, n_corner_ids, 16);
OFFSET(elvis_source_info, n_fields, 24);
OFFSET(elvis_source_info, n_time_steps, 28);
OFFSET(elvis_source_info, n_boundary_groups, 32);
OFFSET(elvis_source_info, mantissa_bits, 36);
OFFSET(elvis_source_info, corner_tolerance, 40);

SIZE(elvis_source_element, 112);
OFFSET(elvis_source_element, struct_size, 0);
OFFSET(elvis_source_element, shape, 4);
OFFSET(elvis_source_element, geometry_order, 8);
OFFSET(elvis_source_element, corners, 24);
OFFSET(elvis_source_element, face_groups, 88);

SIZE(elvis_source_field, 32);
OFFSET(elvis_source_field, struct_size, 0);
OFFSET(elvis_source_field, n_components, 4);
OFFSET(elvis_source_field, name, 8);
OFFSET(elvis_source_field, unit, 16);
OFFSET(elvis_source_field, continuity, 24);
OFFSET(elvis_source_field, transform, 28);

SIZE(elvis_source_space, 20);
OFFSET(elvis_source_space, struct_size, 0);
OFFSET(elvis_source_space, order, 4);
OFFSET(elvis_source_space, is_contained, 16);

SIZE(elvis_converter, 104);
OFFSET(elvis_converter, struct_size, 0);
OFFSET(elvis_converter, reserved, 4);
OFFSET(elvis_converter, probe, 8);
OFFSET(elvis_converter, open, 16);
OFFSET(elvis_converter, close, 24);
OFFSET(elvis_converter, get_info, 32);
OFFSET(elvis_converter, get_field, 40);
OFFSET(elvis_converter, get_elements, 48);
OFFSET(elvis_converter, get_spaces, 56);
OFFSET(elvis_converter, evaluate_mapping, 64);
OFFSET(elvis_converter, sample, 72);
OFFSET(elvis_converter, get_time, 80);
OFFSET(elvis_converter, get_boundary_group, 88);
OFFSET(elvis_converter, sample_world, 96);
