/**
 * @file composer.hpp
 * Composes kernels: interface + library + snippet + kernel.
 *
 * The text of a kernel, in order:
 *
 *   1. #version, extensions, ELVIS_GLSL_VERSION, ELVIS_REAL_IS_DOUBLE, ELVIS_N_INSTANCES, ELVIS_WANTS_HESSIANS, the request's
 *      #defines, CORE_READS_TEXELS (arithmetic/read_only.glsl)
 *   2. arithmetic/types.glsl, arithmetic/math.glsl
 *   3. fetch functions for every record buffer of host and instances (core/shader/fetch.hpp), and the host's elvis_fetch_NAME
 *   4. the instances, the first one last; then the request's text
 *   5. the kernel's file, whose #includes reach everything below shaders/
 *   6. if the request watches loops, arithmetic/watched_main.glsl
 *
 * An instance is: ELVIS_SHAPE, ELVIS_N_COMPONENTS and ELVIS_HAS_... (FIELD_GRADIENT, MAPPING_JACOBIAN, INVERSE_MAPPING,
 * FIELD_OFFSET, LOCAL_ORIGIN, FIELD_HESSIAN, MAPPING_HESSIAN, INSIDE: 0 or 1); elvis_origin; the fetch macros of its buffers;
 * its constants; the snippet's first source; element/reference_shape.glsl; and, where the snippet lacks them,
 * element/mapping_jacobian_default.glsl, field/gradient_default.glsl and, if the request wants second derivatives,
 * field/field_hessian_default.glsl and element/mapping_hessian_default.glsl. A kernel that inverts mappings includes
 * element/newton.glsl itself, which is about the first instance. Afterwards the snippet's macros and fetch macros are undefined
 * again.
 *
 * Instance k > 0 is the same text with #defines around it that append _k to the interface functions, to every identifier that
 * starts with the snippet's prefix, and to every name that the library files of the instance define. So a kernel calls
 * elvis_field_value_1(...), core_face_constraint_1(...), and reads ELVIS_SHAPE_1. The first instance keeps all names, and the
 * macros of its library files (not those of the snippet) stay defined for the kernel, so that include guards work there.
 *
 * Library files of an instance may include each other, with guards, and the common files of step 2, which are left out then.
 * Names that macros put together with ## are not renamed.
 *
 * Before anything is compiled, a snippet's names are checked (core/shader/snippet_check.hpp). Compiler messages name the file
 * and line of whoever wrote the text.
 */
#pragma once

#include <core/base/background.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/vulkan/buffer.hpp>
#include <core/vulkan/kernel/kernel.hpp>

#include <memory>
#include <optional>
#include <span>
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
    /** Path of the kernel below shaders/, e.g. "cut_surface/cut_plane.comp". It has main() and its own bindings from 0. */
    std::string kernel;
    /** The kernel itself, if it is not among the files; `kernel` is its name in messages then. */
    std::string kernel_text;
    /** Stands between the instances and the kernel, with #includes like the kernel's: functions that the kernel calls. */
    std::string text;
    /** Whether elvis_field_hessian and elvis_mapping_hessian are called; without it they need not exist. */
    bool with_second_derivatives = false;
    /** Drivers may end loops early, without a word, once those of one invocation have taken many iterations. Then dispatch()
     * throws an Error: for kernels that do not mark by themselves what cannot be trusted
     * (shaders/arithmetic/driver_limit.glsl). */
    bool watches_loops = false;
    /** Snippets are watched: outputs never written, loops without end (core/shader/poison.hpp), indices out of range
     * (core/shader/index_checks.hpp). */
    bool is_debug_build = false;
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

/**
 * A kernel with the descriptors of all record buffers already known; only the kernel's own buffers are given at dispatch. The
 * record buffers must outlive it.
 *
 * It is compiled by other threads while the one that makes it goes on: make all kernels of a picture before the first dispatch.
 * What the compiler or the driver has to say against it is thrown by build(), or by the first dispatch.
 */
class ComposedKernel {
public:
    ComposedKernel(const Device& device, const KernelRequest& request);
    ~ComposedKernel();
    ComposedKernel(const ComposedKernel&) = delete;
    ComposedKernel& operator=(const ComposedKernel&) = delete;

    /** Returns when it is compiled. */
    void build() const { m_building->wait(); }
    /** The kernel's own bindings, in the order 0 .. n-1. */
    void dispatch(std::span<const Buffer* const> bindings, std::span<const std::byte> push_constants, std::uint32_t groups_x,
                  std::uint32_t groups_y = 1, std::uint32_t groups_z = 1) const;
    /** Groups from `first` on along x and y, from which gl_WorkGroupID counts up. */
    void dispatch_from(const std::array<std::uint32_t, 2>& first, std::span<const Buffer* const> bindings,
                       std::span<const std::byte> push_constants, std::uint32_t groups_x, std::uint32_t groups_y) const;

    /** Kernel::dispatch_indirect(). */
    void dispatch_indirect(std::span<const Buffer* const> bindings, std::span<const std::byte> push_constants,
                           const Buffer& size) const;

private:
    std::vector<BoundBuffer> bound(std::span<const Buffer* const> bindings) const;
    /** Dispatches by a call; an Error that it throws, but for Cancelled, is given the names of the snippets. */
    template <class Call> void watched(const Call& call) const;
    friend class KernelResults;
    void dispatch_unchecked(std::span<const Buffer* const> bindings, std::span<const std::byte> push_constants,
                            std::uint32_t groups_x, std::uint32_t groups_y, std::uint32_t groups_z) const;
    /** What is not 0 once a loop was ended early: where it is to be read to, if it is watched. */
    void add_watch(std::vector<Buffer::Read>& reads, std::uint32_t& is_cut_short) const;
    /** Throws if a loop was. */
    void check_watch(std::uint32_t is_cut_short) const;
    void check_watch() const;
    std::string about_snippets() const;

    const Kernel& kernel() const;

    /** What is built, and the work that builds it. */
    std::optional<Kernel> m_kernel;
    std::shared_ptr<Background::Work> m_building;
    std::string m_name;
    /** The snippets in it, for messages: their texts' names. */
    std::string m_snippets;
    std::vector<BoundBuffer> m_records;
    std::size_t m_n_bindings;
    /** Only of kernels that are watched: what is not 0 once a loop was ended early. */
    struct Watch {
        std::uint32_t binding;
        Buffer is_cut_short;
    };
    std::optional<Watch> m_watch;
};

/** The complete GLSL text of a request, for messages and tests. */
std::string compose_text(const Device& device, const KernelRequest& request);

/** The same without a device, for a request without any record buffer. */
std::string compose_text(const KernelRequest& request);

} // namespace elvis
