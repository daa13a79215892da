#include <core/render/device/in_batches.hpp>
#include <core/render/device/provide_buffer.hpp>
#include <core/render/lines/line_pass.hpp>
#include <core/render/tiles/tile_list.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>

namespace elvis {

namespace {

constexpr std::uint32_t group_width = 32;
constexpr std::uint32_t line_tile_height = 16;
/** Pixels of one dispatch: bounds its time, and gives the threads of software drivers even shares. */
constexpr std::uint32_t line_pixels_a_dispatch = 1u << 17;
constexpr std::uint32_t line_listed_a_dispatch = 1u << 15;
/** Of those that may take many iterations. */
constexpr std::uint32_t open_a_dispatch = 1u << 12;

/** Halvings before those that the limit allows: most pixels need no more. */
constexpr std::uint32_t few_subdivisions = 2;

struct SettleParameters {
    std::uint32_t width, height;
    std::uint32_t first_tile_row;
    std::uint32_t element_class;
    std::uint32_t takes_outside;
    std::uint32_t first_component, end_component;
    std::uint32_t n_isovalues;
    std::uint32_t with_mesh_lines;
};

struct ListedParameters {
    std::uint32_t width, height;
    std::uint32_t first, n_listed;
    std::uint32_t element_class;
    std::uint32_t first_component, end_component;
    std::uint32_t n_isovalues;
    std::uint32_t with_mesh_lines;
    std::uint32_t subdivisions;
    std::uint32_t open_count;
    /** On faces. */
    std::uint32_t is_closed;
};

/** Whether all rays start at one point, or all of them in front of the volume. */
bool start_on_one_side(const CutPlaneGeometry& view, const std::array<double, 6>& bounds) {
    const auto &direction = view.rows[3], &reference = view.rows[6];
    bool is_parallel = true, is_behind = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        is_parallel = is_parallel && view.rows[4][axis] == 0 && view.rows[5][axis] == 0;
    }
    for (std::size_t corner = 0; corner < 8; ++corner) {
        double depth = reference[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            depth += direction[axis] * (bounds[axis + 3 * ((corner >> axis) & 1)] - reference[axis]);
        }
        is_behind = is_behind && depth > 0;
    }
    return !is_parallel || is_behind;
}

/** Each class lists what it leaves open: makes that one entry a pixel, with all that is open there. Returns their number. */
std::uint32_t unite_entries(const Buffer& list, std::uint32_t n_entries) {
    // CORE_LIST_PIXEL of place.glsl.
    constexpr std::uint32_t pixel_bits = (1u << 30) - 1;
    std::vector<std::uint32_t> entries = list.read_items<std::uint32_t>(n_entries);
    const auto pixel = [](std::uint32_t entry) { return entry & pixel_bits; };
    std::sort(entries.begin(), entries.end(), [&](std::uint32_t a, std::uint32_t b) { return pixel(a) < pixel(b); });
    std::size_t n_united = 0;
    for (const std::uint32_t entry : entries) {
        if (n_united > 0 && pixel(entries[n_united - 1]) == pixel(entry)) {
            entries[n_united - 1] |= entry;
        } else {
            entries[n_united++] = entry;
        }
    }
    list.write_items(std::span<const std::uint32_t>(entries.data(), n_united));
    return static_cast<std::uint32_t>(n_united);
}

} // namespace

LinePass::LinePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data, const FaceSet* faces,
                   bool is_whole_boundary, std::uint32_t quadric_rows, bool on_own_boundary)
    : m_device(device), m_volume(volume), m_data(data), m_faces(faces),
      // Where elements are cut, rays pass between faces and what the cut leaves out.
      m_is_closed(is_whole_boundary && !volume.is_cut()), m_quadric_rows(quadric_rows), m_on_own_boundary(on_own_boundary),
      m_tile_width(tile_width_on(device)), m_frame(view_buffer(device, data.precision())),
      m_counts(device, n_counts * sizeof(std::uint32_t)) {}

void LinePass::provide(bool with_contours) {
    std::vector<ClassKernels>& kernels = m_kernels[with_contours ? 1 : 0];
    if (kernels.empty()) {
        kernels = compile(with_contours);
    }
}

std::vector<LinePass::ClassKernels> LinePass::compile(bool with_contours) const {
    std::vector<ClassKernels> list;
    for (std::uint32_t index = 0; index < m_volume.classes().size(); ++index) {
        if (m_volume.classes()[index].n_elements == 0 || (m_faces && m_faces->of_class(index).n_faces == 0)) {
            continue;
        }
        KernelRequest request;
        request.precision = m_data.precision();
        if (m_faces) {
            const FaceSet::ClassFaces& own = m_faces->of_class(index);
            request.buffers = {
                {"core_nodes", own.nodes.get()}, {"core_faces", own.faces.get()}, {"core_patches", own.patches.get()}};
        } else {
            request.buffers = m_data.host_buffers(index);
        }
        m_data.add_field(request, index, true);
        if (m_on_own_boundary) {
            request.text += "#include \"element/whole_elements.glsl\"\n";
        }
        request.defines = {m_data.strongly_bent_define(index),
                           {"CORE_ON_FACES", m_faces ? "1" : "0"},
                           {"CORE_WITH_CONTOURS", with_contours ? "1" : "0"},
                           {"CORE_TILE_WIDTH", std::to_string(m_tile_width) + "u"},
                           {"CORE_TILE_HEIGHT", std::to_string(line_tile_height) + "u"}};
        const auto make = [&](const char* kernel, std::uint32_t n_storage, std::size_t push_bytes) {
            KernelRequest own = request;
            own.name = std::string(kernel).append(" of element class ").append(std::to_string(index));
            own.kernel = std::string(kernel).append(".comp");
            own.bindings = buffer_bindings({.uniform = 1, .storage = n_storage});
            own.push_constant_bytes = static_cast<std::uint32_t>(push_bytes);
            return std::make_unique<ComposedKernel>(m_device, own);
        };
        ClassKernels kernels;
        kernels.element_class = index;
        kernels.settle = make("lines/settle_lines", m_faces ? 7 : 8, sizeof(SettleParameters));
        if (m_faces) {
            kernels.search = make("lines/surface_lines", 8, sizeof(ListedParameters));
            kernels.exclude = make("lines/face_lines_careful", 8, sizeof(ListedParameters));
        } else {
            // The shape's rows, where they are read.
            const auto make_search = [&](bool by_spans) {
                KernelRequest own = request;
                own.name = std::string("surface_lines of element class ").append(std::to_string(index));
                own.kernel = "lines/surface_lines.comp";
                own.defines.insert(own.defines.end(), {{"CORE_FEW_SUBDIVISIONS", std::to_string(few_subdivisions) + "u"},
                                                       {"CORE_BY_QUADRIC_SPANS", by_spans ? "1" : "0"},
                                                       {"CORE_HAS_ENDS", "0"},
                                                       {"CORE_SHAPE_ROWS", std::to_string(m_quadric_rows)}});
                own.bindings = buffer_bindings({.uniform = 2, .storage = 8});
                own.push_constant_bytes = sizeof(ListedParameters);
                return std::make_unique<ComposedKernel>(m_device, own);
            };
            kernels.search = make_search(false);
            if (m_quadric_rows > 0) {
                kernels.exclude = make_search(true);
            }
        }
        list.push_back(std::move(kernels));
    }
    return list;
}

struct LinePass::Picture {
    const std::vector<ClassKernels>& kernels;
    const ShownComponent& component;
    const LineRequest& lines;
    const Buffer *bending, *shape;
    const LayerTarget& target;

    std::uint32_t n_isovalues() const { return static_cast<std::uint32_t>(lines.isovalues.size()); }
};

/** Pixels in a list, and the list of those that they leave open. */
struct LinePass::Listed {
    const Buffer &from, &to;
    std::uint32_t count, most_a_dispatch;
    /** Which of the counts is that of the second list; 0: there is none. */
    std::uint32_t open_count;
    bool is_closed;
};

void LinePass::draw(const CutPlaneGeometry& view, const ShownComponent& component, const LineRequest& lines,
                    const Buffer* bending, const Buffer* shape, const LayerTarget& target, FrameCounts& counts) {
    const Picture picture{m_kernels[lines.isovalues.empty() ? 0 : 1], component, lines, bending, shape, target};
    const std::uint64_t n_pixels = target.layer.n_pixels();
    write_view(m_frame, m_data.precision(), view);
    m_counts.fill(0);
    // A buffer cannot be empty.
    provide_buffer(m_isovalues, m_device, std::max<std::uint64_t>(picture.n_isovalues(), 1) * real_bytes(m_data.precision()));
    write_reals(*m_isovalues, m_data.precision(), lines.isovalues);
    provide_buffer(m_list, m_device, n_pixels * sizeof(std::uint32_t));
    // Each class may leave a pixel open.
    const std::uint64_t open_bytes = picture.kernels.size() * n_pixels * sizeof(std::uint32_t);
    provide_buffer(m_open, m_device, open_bytes);
    provide_buffer(m_still_open, m_device, open_bytes);
    settle(picture);
    const std::uint32_t n_listed = n_of(1);
    counts.refined_pixels += n_listed;
    look_closer(picture, n_listed, m_is_closed && start_on_one_side(view, m_data.bounds()));
    counts.field_evaluations += n_of(0);
}

/** Lists the pixels that the elements which they show leave open. */
void LinePass::settle(const Picture& picture) const {
    const Layer& layer = picture.target.layer;
    std::vector<const Buffer*> bindings = {&m_frame,     &layer.samples, &layer.normals,        &m_counts,
                                           &layer.marks, &*m_isovalues,  picture.target.places, &*m_list};
    if (picture.bending != nullptr) {
        bindings.push_back(picture.bending);
    }
    const std::uint32_t tiles_a_row = divided_up(layer.width, m_tile_width);
    const TileRows wanted = picture.target.tile_rows(line_tile_height);
    const std::uint32_t rows_a_dispatch =
        items_a_dispatch(m_device, std::max(1u, line_pixels_a_dispatch / (tiles_a_row * m_tile_width * line_tile_height)));
    for (const ClassKernels& of_class : picture.kernels) {
        for (std::uint32_t first_row = wanted.first; first_row < wanted.end; first_row += rows_a_dispatch) {
            const SettleParameters parameters{layer.width,
                                              layer.height,
                                              first_row,
                                              of_class.element_class,
                                              &of_class == &picture.kernels.front() ? 1u : 0u,
                                              picture.component.first(),
                                              picture.component.end(),
                                              picture.n_isovalues(),
                                              picture.lines.mesh_lines ? 1u : 0u};
            of_class.settle->dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), tiles_a_row,
                                      std::min(rows_a_dispatch, wanted.end - first_row));
        }
    }
}

/**
 * Few halvings first: most pixels need no more, and what they decide stays decided whatever the limit is. Level by level where
 * lines are excluded, too: what decides a pixel is found early, and deep walks are for few.
 */
std::vector<LinePass::Round> LinePass::rounds_to(std::uint32_t subdivisions) const {
    const std::uint32_t few = std::min(subdivisions, few_subdivisions);
    const auto search = &ClassKernels::search, exclude = &ClassKernels::exclude;
    std::vector<Round> rounds = {{search, 0}};
    if (m_quadric_rows > 0) {
        rounds.insert(rounds.end(), {{exclude, few}, {search, subdivisions}});
    } else {
        rounds.push_back({search, few});
        if (m_faces) {
            rounds.push_back({exclude, few});
        } else if (subdivisions > few) {
            rounds.push_back({search, subdivisions});
        }
    }
    for (std::uint32_t most = few; (m_faces || m_quadric_rows > 0) && most < subdivisions;) {
        most = std::min(most + few_subdivisions, subdivisions);
        if (m_faces) {
            rounds.push_back({search, most});
        }
        rounds.push_back({exclude, most});
    }
    return rounds;
}

void LinePass::look_closer(const Picture& picture, const Round& round, const Listed& listed) const {
    const Layer& layer = picture.target.layer;
    std::vector<const Buffer*> bindings = {&m_frame,      &layer.samples,        &layer.normals, &m_counts, &layer.marks,
                                           &*m_isovalues, picture.target.places, &listed.from,   &listed.to};
    if (!m_faces) {
        bindings = {&m_frame,      picture.shape,   &layer.normals, &m_counts,      &layer.marks,
                    &*m_isovalues, picture.bending, &listed.from,   &layer.samples, &listed.to};
    }
    for (const ClassKernels& of_class : picture.kernels) {
        in_batches(listed.count, listed.most_a_dispatch, [&](std::uint32_t first, std::uint32_t count) {
            const ListedParameters parameters{layer.width,
                                              layer.height,
                                              first,
                                              count,
                                              of_class.element_class,
                                              picture.component.first(),
                                              picture.component.end(),
                                              picture.n_isovalues(),
                                              picture.lines.mesh_lines ? 1u : 0u,
                                              round.subdivisions,
                                              listed.open_count,
                                              listed.is_closed ? 1u : 0u};
            (of_class.*round.kernel)
                ->dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), divided_up(count, group_width));
        });
    }
}

/** Into the listed pixels, round by round into those that stay open. */
void LinePass::look_closer(const Picture& picture, std::uint32_t n_listed, bool is_closed) {
    const std::vector<Round> rounds = rounds_to(picture.lines.subdivisions);
    const Buffer* from = &*m_list;
    std::uint32_t n_left = n_listed;
    for (std::uint32_t round = 0; round < rounds.size(); ++round) {
        const bool is_last = round + 1 == rounds.size();
        const Buffer* to = from == &*m_open ? &*m_still_open : &*m_open;
        const std::uint32_t open_count = is_last ? 0 : 2 + round;
        const std::uint32_t most_a_dispatch =
            items_a_dispatch(m_device, round == 0 ? line_listed_a_dispatch : open_a_dispatch, group_width);
        look_closer(picture, rounds[round], {*from, *to, n_left, most_a_dispatch, open_count, is_closed});
        from = to;
        n_left = is_last ? 0 : n_of(open_count);
        if (picture.kernels.size() > 1 && n_left > 0) {
            n_left = unite_entries(*to, n_left);
        }
    }
}

} // namespace elvis
