#include "picture_prop.hpp"

#include <vtkMultiProcessController.h>
#include <vtkObjectFactory.h>
#include <vtkRenderer.h>

#include <cmath>
#include <exception>
#include <limits>

namespace elvis_paraview {

vtkStandardNewMacro(PictureProp);

PictureProp::PictureProp() = default;
PictureProp::~PictureProp() = default;

void PictureProp::show(std::shared_ptr<OpenVolume> volume, const ShownItems& items) {
    if (volume != m_volume) {
        m_surfaces = m_light = {};
    }
    m_volume = std::move(volume);
    m_items = items;
    if (m_volume) {
        // ParaView's order: the ends of x, of y, of z.
        const elvis_data_info info = m_volume->data.info();
        m_bounds = {info.bounds[0], info.bounds[3], info.bounds[1], info.bounds[4], info.bounds[2], info.bounds[5]};
    }
    Modified();
}

double PictureProp::diagonal() const {
    return std::hypot(m_bounds[1] - m_bounds[0], m_bounds[3] - m_bounds[2], m_bounds[5] - m_bounds[4]);
}

double* PictureProp::GetBounds() { return m_volume ? m_bounds.data() : nullptr; }

vtkRenderer* PictureProp::shown_in(vtkViewport* viewport) const {
    auto* renderer = vtkRenderer::SafeDownCast(viewport);
    vtkMultiProcessController* processes = vtkMultiProcessController::GetGlobalController();
    const bool is_first = processes == nullptr || processes->GetLocalProcessId() == 0;
    return renderer != nullptr && renderer->GetSelector() == nullptr && m_volume && is_first ? renderer : nullptr;
}

int PictureProp::RenderOpaqueGeometry(vtkViewport* viewport) {
    vtkRenderer* renderer = shown_in(viewport);
    if (renderer == nullptr) {
        return 0;
    }
    m_size = size_of(*renderer);
    m_scene = scene_of_view(*renderer, m_items, diagonal(), Part::all);
    if (!m_items.has_surfaces()) {
        m_surfaces = {};
        m_distances.clear();
        return 0;
    }
    draw(m_surfaces, scene_of_view(*renderer, m_items, diagonal(), Part::surfaces), nullptr,
         [&](const elvis::picture& picture) {
             m_colors = picture.read<std::uint8_t>(ELVIS_CHANNEL_COLOR);
             m_distances = picture.read<double>(ELVIS_CHANNEL_DEPTH);
         });
    if (!m_surfaces.is_there) {
        return 0;
    }
    std::vector<float> depths = buffer_depths(*renderer, m_size, m_distances);
    m_quad.put(*renderer, m_size, m_colors, depths);
    return 1;
}

int PictureProp::RenderVolumetricGeometry(vtkViewport* viewport) {
    vtkRenderer* renderer = shown_in(viewport);
    if (renderer == nullptr || m_items.opacity == nullptr) {
        return 0;
    }
    vtkMultiProcessController* processes = vtkMultiProcessController::GetGlobalController();
    if (processes != nullptr && processes->GetNumberOfProcesses() > 1) {
        m_light.remarks = {{"the volume itself is drawn by one process alone: it is left out on several ranks", true}};
        tell();
        return 0;
    }
    const auto n_pixels = static_cast<std::size_t>(m_size[0] * m_size[1]);
    m_distances.resize(n_pixels, std::numeric_limits<double>::quiet_NaN());
    std::vector<double> hidden_from = drawn_distances(*renderer, m_size, m_distances);
    if (hidden_from != m_hidden_from) {
        m_hidden_from = std::move(hidden_from);
        m_light.scene.clear();
    }
    draw(m_light, scene_of_view(*renderer, m_items, diagonal(), Part::light), m_hidden_from.data(),
         [&](const elvis::picture& picture) { m_light_colors = picture.read<float>(ELVIS_CHANNEL_COLOR); });
    if (!m_light.is_there) {
        return 0;
    }
    m_quad.blend(*renderer, m_size, m_light_colors);
    return 1;
}

template <class Take>
void PictureProp::draw(Drawn& drawn, const std::string& scene, const double* hidden_from, const Take& take) {
    if (scene == drawn.scene) {
        return;
    }
    drawn = {scene, false, {}};
    try {
        elvis_render_options options{};
        options.struct_size = sizeof options;
        options.hidden_from = hidden_from;
        const elvis::picture picture = m_volume->data.render(m_volume->context.parse_scene(scene), options);
        take(picture);
        drawn.remarks = picture.remarks();
        drawn.is_there = true;
    } catch (const std::exception& error) {
        drawn.remarks = {{error.what(), true}};
    }
    tell();
}

void PictureProp::tell() {
    m_remarks.clear();
    std::string warnings;
    for (const Drawn* drawn : {&m_surfaces, &m_light}) {
        for (const elvis::picture::remark& remark : drawn->remarks) {
            m_remarks += (m_remarks.empty() ? "" : "\n") + remark.text;
            warnings += remark.is_warning ? (warnings.empty() ? "" : "\n") + remark.text : "";
        }
    }
    // Once, not with each turn of the camera.
    if (!warnings.empty() && warnings != m_warnings) {
        vtkWarningMacro(<< warnings);
    }
    m_warnings = warnings;
}

void PictureProp::ReleaseGraphicsResources(vtkWindow* window) { m_quad.release(window); }

} // namespace elvis_paraview
