#include <core/render/layered_picture.hpp>
#include <core/render/picture/frame_read.hpp>
#include <core/vulkan/real_array.hpp>

namespace elvis {

namespace {

/** Crossings of one ray with one see-through surface that are drawn: far more than people can tell apart. */
constexpr std::uint32_t max_rounds = 64;

} // namespace

struct LayeredPicture::Setting {
    /** One core_place a pixel, if they are wanted. */
    const Buffer* places = nullptr;
    /** Depths of opaque surfaces in front of which it is wanted; null: all of it is. */
    const Buffer* opaque = nullptr;
    /** Whether nothing is looked for behind them. */
    bool is_occluded = false;
};

LayeredPicture::LayeredPicture(const Device& device, Precision precision)
    : m_device(device), m_precision(precision), m_color_pass(device, precision), m_merge_pass(device, precision),
      m_occlusion_pass(device, precision), m_flags_pass(device, precision), m_late(device) {}

void LayeredPicture::begin(const FrameRequest& request, const PixelRows& rows, Frame& frame) {
    m_request = &request;
    m_frame = &frame;
    m_late.begin();
    if (!m_layer || m_layer->width != request.width || m_layer->height != request.height) {
        m_layer.reset();
        m_other_values.reset();
        m_layer = std::make_unique<Layer>(m_device, m_precision, request.width, request.height);
        m_layer->late = &m_late;
    }
    m_is_alone = request.surfaces.size() == 1 && !request.surfaces[0].is_see_through() && !request.volume;
    m_layer->rows = m_is_alone ? PixelRows{0, request.height} : rows;
    if (!m_is_alone) {
        m_merge_pass.begin(request.width, request.height, rows, request.background);
        frame.counts.spared_pixels += std::uint64_t{request.width} * (request.height - (rows.end - rows.first));
    }
    m_color_pass.begin(request.surfaces.size());
}

void LayeredPicture::provide(const Surface& surface) {
    m_color_pass.provide(surface, is_lit(surface));
    if (!surface.conditions.empty() && !m_condition_pass) {
        m_condition_pass = std::make_unique<ConditionPass>(m_device, m_precision);
    }
    if (surface.lic && m_request->shades) {
        write_reals(provide_buffer(m_shades, m_device, m_layer->n_pixels() * real_bytes(m_precision)), m_precision,
                    *m_request->shades);
        return;
    }
    if (surface.lic && !m_lic_pass) {
        m_lic_pass = std::make_unique<LicPass>(m_device, m_precision);
    }
    if ((!surface.conditions.empty() || surface.lic) && !m_other_values) {
        m_other_values = std::make_unique<Layer>(m_device, m_precision, m_layer->width, m_layer->height);
        m_other_values->late = &m_late;
    }
}

LayeredPicture::Setting LayeredPicture::setting_of(const SurfaceDrawing& drawing) {
    const Surface& surface = drawing.surface();
    const SurfaceTraits& traits = drawing.traits();
    Setting setting;
    const bool wants_places = surface.has_lines() || !surface.conditions.empty() || surface.lic || surface.by_place;
    if ((wants_places && traits.plane == nullptr) || traits.isosurfaces != nullptr) {
        setting.places = &provide_buffer(m_places, m_device, m_layer->n_pixels() * place_bytes(m_precision));
    }
    // Edges are nothing behind which much would be hidden from them.
    setting.opaque = m_is_alone || traits.wires != nullptr ? nullptr : m_merge_pass.depths();
    // Lines and line integral convolution look at neighbouring pixels, hidden ones included.
    setting.is_occluded = setting.opaque != nullptr && m_request->sharing.depths && !surface.has_lines() && !surface.lic;
    return setting;
}

void LayeredPicture::draw(SurfaceDrawing& drawing, std::size_t index, std::uint32_t common_flags) {
    const Surface& surface = drawing.surface();
    const SurfaceTraits& traits = drawing.traits();
    const Setting setting = setting_of(drawing);
    FrameCounts& counts = m_frame->counts;
    const Buffer* beyond = nullptr;
    MergePass::Wanted wanted{1, 0, m_layer->height};
    std::uint64_t n_hidden = 0;
    for (std::uint32_t round = 0; wanted.n_pixels > 0 && round < max_rounds; ++round) {
        n_hidden += draw_layer(drawing, setting, wanted, beyond);
        m_color_pass.draw(*m_layer, surface, index, drawing.rays(), m_is_alone ? m_request->background : Color{},
                          drawing.offset(), common_flags, is_lit(surface) ? &*m_request->lighting : nullptr,
                          surface.lic ? &shades() : nullptr);
        wanted = merge(drawing, index);
        if (m_request->gives_layers) {
            m_frame->layers.push_back(read_layer(drawing));
        }
        // A plane is met once, and what edges hide of others is nothing.
        if (traits.plane != nullptr || traits.wires != nullptr) {
            wanted = {};
        }
        if (wanted.n_pixels > 0 && m_request->sharing.rows) {
            counts.spared_pixels += std::uint64_t{m_layer->width} * (m_layer->height - (wanted.end_row - wanted.first_row));
        } else {
            wanted = {wanted.n_pixels, 0, m_layer->height};
        }
        beyond = m_merge_pass.beyond();
    }
    counts.work_limit_pixels += wanted.n_pixels;
    // Where nothing was looked for behind others, it may have been there.
    m_frame->is_met[index] = n_hidden > 0;
}

/** Returns in how many pixels opaque surfaces hide it. */
std::uint32_t LayeredPicture::draw_layer(SurfaceDrawing& drawing, const Setting& setting, const MergePass::Wanted& wanted,
                                         const Buffer* beyond) {
    const Surface& surface = drawing.surface();
    const bool wants_normals = m_request->with_buffers || is_lit(surface) || surface.has_lines() || surface.lic;
    const LayerTarget target{*m_layer, beyond, wants_normals, setting.places, wanted.first_row, wanted.end_row};
    std::uint32_t n_hidden = 0;
    m_layer->marks.fill(0);
    if (setting.is_occluded) {
        m_occlusion_pass.begin(*m_layer, *setting.opaque);
    }
    drawing.draw(target, m_frame->counts);
    if (setting.is_occluded) {
        n_hidden = m_occlusion_pass.end(*m_layer, *setting.opaque);
        m_frame->counts.hidden_pixels += n_hidden;
    }
    drawing.finish(target, m_frame->counts);
    if (surface.lic && !m_request->shades) {
        convolve(drawing, setting);
    }
    if (setting.opaque != nullptr) {
        n_hidden += m_occlusion_pass.hide(*m_layer, *setting.opaque);
    }
    cut_where_conditions_fail(drawing, target);
    return n_hidden;
}

void LayeredPicture::cut_where_conditions_fail(SurfaceDrawing& drawing, const LayerTarget& target) {
    for (const Condition& condition : drawing.surface().conditions) {
        const ConditionLimit limit = drawing.limit_of(condition);
        m_other_values->marks.fill(0);
        drawing.draw_field(condition.field, target, *m_other_values, m_frame->counts);
        m_condition_pass->judge(*m_layer, *m_other_values, limit);
    }
}

const Buffer& LayeredPicture::shades() const { return m_request->shades ? *m_shades : m_lic_pass->shades(); }

/** Colours alone are to differ: passes that evaluate the vectors put their flags elsewhere. */
void LayeredPicture::convolve(SurfaceDrawing& drawing, const Setting& setting) {
    const Lic& lic = *drawing.surface().lic;
    m_other_values->rows = m_layer->rows;
    m_lic_pass->begin(*m_layer, *m_other_values);
    const LayerTarget target{.layer = *m_other_values, .wants_normals = false, .places = setting.places};
    for (std::uint32_t component = 0; component < lic.vectors.size(); ++component) {
        drawing.draw_field(lic.vectors[component], target, *m_other_values, m_frame->counts);
        m_lic_pass->take(*m_layer, *m_other_values, component);
    }
    m_lic_pass->convolve(*m_layer, drawing.rays(), drawing.traits().plane != nullptr, drawing.vectors_of(lic), lic,
                         m_request->place().first_row);
}

/** Returns where what is behind is wanted. */
MergePass::Wanted LayeredPicture::merge(const SurfaceDrawing& drawing, std::size_t index) {
    return m_is_alone ? MergePass::Wanted{}
                      : m_merge_pass.merge(*m_layer, static_cast<std::uint32_t>(index) + 1, drawing.traits().plane == nullptr,
                                           drawing.surface().is_see_through());
}

Frame LayeredPicture::read_layer(const SurfaceDrawing& drawing) {
    m_flags_pass.settle(*m_layer);
    LayerRead read(*m_layer, m_precision, true);
    const std::vector<Buffer::Read> reads = read.reads();
    Buffer::read_together(reads);
    Frame frame;
    frame.width = m_layer->width;
    frame.height = m_layer->height;
    read.fill({surface_facts(drawing)}, frame);
    return frame;
}

ViewStart LayeredPicture::start_of_view() const {
    const Camera& camera = m_request->camera;
    ViewStart start{camera.eye, std::nullopt};
    if (camera.orthographic) {
        start.direction = unit(minus(camera.look_at, camera.eye));
    }
    return start;
}

void LayeredPicture::draw(VolumePass& volume, const DeviceVolume& data) {
    if (m_request->hidden_from) {
        m_merge_pass.hide_behind(*m_request->hidden_from);
    } else {
        m_merge_pass.fill_empty();
    }
    volume.draw(rays_of(*m_request, nullptr, data), start_of_view(), m_merge_pass, m_request->sharing.rows, m_frame->counts);
}

void LayeredPicture::give_runs(VolumePass& volume, const DeviceVolume& data) {
    m_merge_pass.hide_behind(*m_request->hidden_from);
    m_frame->runs = volume.runs(rays_of(*m_request, nullptr, data), start_of_view(), m_merge_pass, m_request->stops,
                                m_request->sharing.rows, m_frame->counts);
    m_frame->color_error = volume.color_error();
}

void LayeredPicture::finish() {
    if (!m_is_alone) {
        m_merge_pass.finish();
    }
}

std::vector<Buffer::Read> LayeredPicture::settle() {
    m_flags_pass.settle(drawn());
    m_flag_words.resize(m_flags_pass.counts().bytes() / sizeof(std::uint32_t));
    m_special_words.resize(m_color_pass.special().bytes() / sizeof(std::uint32_t));
    return {{&m_flags_pass.counts(), std::as_writable_bytes(std::span(m_flag_words))},
            {&m_color_pass.special(), std::as_writable_bytes(std::span(m_special_words))},
            m_late.read()};
}

void LayeredPicture::count() {
    FlagsPass::add(m_flag_words, m_frame->counts);
    m_frame->special_values = m_color_pass.special_values(m_special_words);
    m_late.take_all();
}

} // namespace elvis
