/**
 * @file composer.hpp
 * Composes kernels: interface + library + snippet + kernel, in this order:
 *
 *   types and mathematics       library/types.glsl, library/math.glsl
 *   the host's record buffers   elvis_fetch_NAME, elvis_fetch4_NAME
 *   each snippet instance       constants, fetch macros, library/reference_shape.glsl, elvis_origin, the snippet, defaults for
 * what it lacks (elvis_mapping_jacobian, elvis_field_gradient) the kernel                  which includes what else it needs of
 * the library
 *
 * All but the first instance have their names replaced by #defines ("native_row" becomes "native_row_1") that are undone after
 * it, as are the macros they define: a snippet may occur several times, and lines keep their numbers. The first instance comes
 * last and stays visible as it is, ELVIS_SHAPE and all, for the kernel and the parts of the library that depend on it.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/vulkan/buffer.hpp>
#include <core/vulkan/kernel.hpp>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace elvis {

/** A record buffer that GLSL reads as elvis_fetch_NAME / elvis_fetch4_NAME. */
struct FetchBuffer {
    std::string name;
    const RecordBuffer* records = nullptr;
};

/**
 * One inclusion of a snippet: an element class with one field. Its interface functions are visible under their own names for
 * the first instance ("elvis_mapping") and with suffix for the others ("elvis_mapping_1", _2, ...).
 */
struct SnippetInstance {
    Snippet snippet;
    elvis_shape shape = ELVIS_SHAPE_HEXAHEDRON;
    std::uint32_t n_components = 1;
    std::vector<std::pair<std::string, std::int64_t>> constants;
    /** The plugin's buffers, for this instance only. */
    std::vector<FetchBuffer> buffers;
    /** Record buffer with one record (x y z) per local element behind elvis_origin(); null: origin 0. */
    const RecordBuffer* origins = nullptr;
};

struct KernelRequest {
    /** For messages and caches, e.g. "cut_plane hexahedron pressure". */
    std::string name;
    /** Path of the kernel below shaders/, e.g. "kernels/cut_plane.comp". It has main() and its own bindings from 0. */
    std::string kernel;
    Precision precision = Precision::float32;
    std::vector<SnippetInstance> instances;
    /** Record buffers of the host, visible to library and kernel. */
    std::vector<FetchBuffer> buffers;
    /** #defines for the kernel: sizes of its work group and options. */
    std::vector<std::pair<std::string, std::string>> defines;
    /** Bindings that the kernel declares itself, 0 .. n-1. */
    std::vector<BindingLayout> bindings;
    std::uint32_t push_constant_bytes = 0;
};

/** A kernel with the descriptors of all record buffers already known; only the kernel's own buffers are given at dispatch. */
class ComposedKernel {
public:
    ComposedKernel(const Device& device, const KernelRequest& request);

    /** The kernel's own bindings, in the order 0 .. n-1. */
    void dispatch(std::span<const Buffer* const> bindings, std::span<const std::byte> push_constants, std::uint32_t groups_x,
                  std::uint32_t groups_y = 1, std::uint32_t groups_z = 1) const;

private:
    struct Parts {
        std::vector<std::uint32_t> spirv;
        std::vector<BindingLayout> layout;
        std::vector<BoundBuffer> records;
    };
    ComposedKernel(const Device& device, const KernelRequest& request, Parts parts);

    Kernel m_kernel;
    std::vector<BoundBuffer> m_records;
    std::size_t m_n_own;
};

/** The complete GLSL text of a request, for messages and tests. */
std::string compose_text(const Device& device, const KernelRequest& request);

} // namespace elvis
