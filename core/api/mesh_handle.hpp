/**
 * @file mesh_handle.hpp
 * What is behind the handles of extract.h.
 */
#pragma once

#include "handles.hpp"

#include <core/extract/extraction.hpp>

#include <elvis/extract.h>

struct elvis_mesh {
    std::shared_ptr<elvis::library::Context> context;
    elvis::SurfaceMesh mesh;
    /** Of vertices, and of triangles: numbers under which people know the elements. */
    std::vector<std::int64_t> elements, triangle_elements;
    std::uint32_t n_values = 0;
    std::vector<double> values;
};

/** Beside the handle, where calls look for it. */
inline elvis::library::Context* context_of(const elvis_mesh* handle) {
    return handle != nullptr ? handle->context.get() : nullptr;
}
