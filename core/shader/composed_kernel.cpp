#include <core/shader/composer.hpp>

#include <core/base/error.hpp>
#include <core/base/milliseconds.hpp>
#include <core/shader/compiler.hpp>
#include <core/shader/request_records.hpp>
#include <core/shader/texel_bindings.hpp>
#include <core/vulkan/memory/memory_limit.hpp>

#include <cassert>
#include <chrono>
#include <filesystem>
#include <set>

namespace elvis {

namespace {

std::vector<BindingLayout> layout_of(const KernelRequest& request) {
    const RequestRecords records(request);
    std::vector<BindingLayout> layout = request.bindings;
    for (const BoundBuffer& bound : records.bindings()) {
        layout.push_back({bound.binding, BindingType::storage_buffer});
    }
    if (request.watches_loops) {
        layout.push_back({records.watch_binding(), BindingType::storage_buffer});
    }
    return layout;
}

/** Records, and other buffers that the code only reads, may be texel buffers: it says so. */
void take_texel_bindings(std::vector<BindingLayout>& layout, std::span<const std::uint32_t> spirv) {
    const std::set<std::uint32_t> texels = texel_bindings(spirv);
    for (BindingLayout& binding : layout) {
        binding.type = texels.contains(binding.binding) ? BindingType::texel_buffer : binding.type;
    }
}

/** Each once: "snippet 'my_solver' (hexahedron.glsl)". */
std::string snippet_names(const KernelRequest& request) {
    std::string names;
    for (const SnippetInstance& instance : request.instances) {
        const std::string name = "snippet '" + instance.snippet.prefix + "' (" + instance.snippet.sources.front().name + ")";
        if (names.find(name) == std::string::npos) {
            names += (names.empty() ? "" : ", ") + name;
        }
    }
    return names;
}

SpirvTarget target_of(const Device& device) {
    return device.uses_texel_buffers() ? SpirvTarget::processor : SpirvTarget::graphics_card;
}

} // namespace

ComposedKernel::ComposedKernel(const Device& device, const KernelRequest& request)
    : m_name(request.name), m_snippets(snippet_names(request)), m_records(RequestRecords(request).bindings()),
      m_n_bindings(request.bindings.size()) {
    if (request.precision == Precision::float64 && !device.summary().has_float64) {
        throw Error("device '" + device.summary().name + "'", "it has no double precision; use --precision float32");
    }
    if (request.watches_loops) {
        m_watch.emplace(Watch{RequestRecords(request).watch_binding(), Buffer(device, sizeof(std::uint32_t))});
        m_watch->is_cut_short.fill(0);
    }
    // The request and its snippets are not kept: their text is.
    KernelCode code{.name = m_name,
                    .file = std::filesystem::path(request.kernel).replace_extension().string(),
                    .precision = request.precision,
                    .spirv = {},
                    .layout = layout_of(request),
                    .push_constant_bytes = request.push_constant_bytes};
    std::shared_ptr<void> room = need_kernel_room(device, m_name);
    m_building = device.background().hand_over(
        [this, &device, text = compose_text(device, request), code = std::move(code), room = std::move(room)]() mutable {
            const std::shared_ptr<void> held = std::move(room);
            const auto start = std::chrono::steady_clock::now();
            code.spirv = compile_shader(text, m_name, target_of(device));
            take_texel_bindings(code.layout, code.spirv);
            const double compiler = milliseconds_since(start);
            m_kernel.emplace(device, code.spirv, code.layout, code.push_constant_bytes, m_name);
            device.add({m_name, compiler, milliseconds_since(start) - compiler, code.spirv.size() * sizeof(std::uint32_t)});
            device.tell(code);
        });
}

ComposedKernel::~ComposedKernel() { m_building->drop(); }

const Kernel& ComposedKernel::kernel() const {
    m_building->wait();
    return *m_kernel;
}

std::string ComposedKernel::about_snippets() const {
    return m_snippets.empty() ? "" : " [the kernel evaluates the plugin's " + m_snippets + "; ";
}

template <class Call> void ComposedKernel::watched(const Call& call) const {
    try {
        call();
    } catch (const Cancelled&) {
        throw;
    } catch (const OutOfMemory&) {
        throw;
    } catch (const Error& error) {
        // A lost device is most often a snippet's endless loop or a fetch beyond a record.
        if (m_snippets.empty()) {
            throw;
        }
        throw Error(error.place(), error.cause() + about_snippets() + "elvis check-plugin looks for endless loops there]");
    }
}

void ComposedKernel::add_watch(std::vector<Buffer::Read>& reads, std::uint32_t& is_cut_short) const {
    if (m_watch) {
        reads.push_back({&m_watch->is_cut_short, std::as_writable_bytes(std::span(&is_cut_short, 1))});
    }
}

void ComposedKernel::check_watch() const {
    if (m_watch) {
        check_watch(m_watch->is_cut_short.read_items<std::uint32_t>(1).front());
    }
}

void ComposedKernel::check_watch(std::uint32_t is_cut_short) const {
    if (is_cut_short != 0) {
        m_watch->is_cut_short.fill(0);
        throw Error("kernel '" + m_name + "'",
                    "the driver has ended its loops early: nothing of it is to be trusted" +
                        (m_snippets.empty() ? ""
                                            : about_snippets() + "drivers may grant all loops of an invocation "
                                                                 "65535 iterations, which high orders use up]"));
    }
}

void ComposedKernel::dispatch_unchecked(std::span<const Buffer* const> bindings, std::span<const std::byte> push_constants,
                                        std::uint32_t groups_x, std::uint32_t groups_y, std::uint32_t groups_z) const {
    watched([&] { kernel().dispatch(bound(bindings), push_constants, groups_x, groups_y, groups_z); });
}

void ComposedKernel::dispatch(std::span<const Buffer* const> bindings, std::span<const std::byte> push_constants,
                              std::uint32_t groups_x, std::uint32_t groups_y, std::uint32_t groups_z) const {
    dispatch_unchecked(bindings, push_constants, groups_x, groups_y, groups_z);
    check_watch();
}

void ComposedKernel::dispatch_from(const std::array<std::uint32_t, 2>& first, std::span<const Buffer* const> bindings,
                                   std::span<const std::byte> push_constants, std::uint32_t groups_x,
                                   std::uint32_t groups_y) const {
    watched([&] { kernel().dispatch_from({first[0], first[1], 0}, bound(bindings), push_constants, {groups_x, groups_y, 1}); });
    check_watch();
}

void ComposedKernel::dispatch_indirect(std::span<const Buffer* const> bindings, std::span<const std::byte> push_constants,
                                       const Buffer& size) const {
    watched([&] { kernel().dispatch_indirect(bound(bindings), push_constants, size); });
    check_watch();
}

std::vector<BoundBuffer> ComposedKernel::bound(std::span<const Buffer* const> bindings) const {
    assert(bindings.size() == m_n_bindings);
    std::vector<BoundBuffer> all = m_records;
    for (std::uint32_t binding = 0; binding < bindings.size(); ++binding) {
        all.push_back({binding, bindings[binding], nullptr, 0});
    }
    if (m_watch) {
        all.push_back({m_watch->binding, &m_watch->is_cut_short, nullptr, 0});
    }
    return all;
}

} // namespace elvis
