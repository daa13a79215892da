#include "picture_prop.hpp"

#include <vtkCamera.h>
#include <vtkMultiProcessController.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLQuadHelper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>
#include <vtkRenderer.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>
#include <vtk_glew.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace elvis_paraview {

namespace {

const char* const fragment_shader = R"(//VTK::System::Dec
in vec2 texCoord;
uniform sampler2D colors;
uniform sampler2D depths;
//VTK::Output::Dec
void main() {
    vec4 color = texture(colors, texCoord);
    if (color.a == 0.0) {
        discard;
    }
    gl_FragData[0] = color;
    gl_FragDepth = texture(depths, texCoord).r;
}
)";

/** In OpenGL's buffer, of points that rays meet at a distance; 1 where they meet nothing. */
std::vector<float> buffer_depths(vtkRenderer& renderer, const std::array<int, 2>& size, const std::vector<double>& distances) {
    vtkCamera& camera = *renderer.GetActiveCamera();
    double range[2];
    camera.GetClippingRange(range);
    const double near = range[0], far = range[1];
    const bool is_parallel = camera.GetParallelProjection() != 0;
    const double half = std::tan(camera.GetViewAngle() * std::numbers::pi / 360);
    std::vector<float> depths(distances.size(), 1.0F);
    for (int row = 0; row < size[1]; ++row) {
        for (int column = 0; column < size[0]; ++column) {
            const auto pixel = static_cast<std::size_t>(row * size[0] + column);
            if (std::isnan(distances[pixel])) {
                continue;
            }
            const double x = half * (2 * column + 1 - size[0]) / size[1], y = half * (size[1] - 2 * row - 1) / size[1];
            const double ahead = is_parallel ? distances[pixel] : distances[pixel] / std::sqrt(1 + x * x + y * y);
            const double depth = is_parallel ? (ahead - near) / (far - near) : far / (far - near) * (1 - near / ahead);
            // What is there is in front of the background.
            depths[pixel] = std::min(static_cast<float>(std::max(depth, 0.0)), std::nextafter(1.0F, 0.0F));
        }
    }
    return depths;
}

vtkSmartPointer<vtkTextureObject> make_texture(vtkOpenGLRenderWindow& window) {
    auto texture = vtkSmartPointer<vtkTextureObject>::New();
    texture->SetContext(&window);
    texture->SetMinificationFilter(vtkTextureObject::Nearest);
    texture->SetMagnificationFilter(vtkTextureObject::Nearest);
    texture->SetWrapS(vtkTextureObject::ClampToEdge);
    texture->SetWrapT(vtkTextureObject::ClampToEdge);
    return texture;
}

} // namespace

vtkStandardNewMacro(PictureProp);

PictureProp::PictureProp() = default;
PictureProp::~PictureProp() = default;

void PictureProp::show(std::shared_ptr<OpenVolume> volume, const ShownItems& items) {
    if (volume != m_volume) {
        m_scene.clear();
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

double* PictureProp::GetBounds() { return m_volume ? m_bounds.data() : nullptr; }

int PictureProp::RenderOpaqueGeometry(vtkViewport* viewport) {
    auto* renderer = vtkRenderer::SafeDownCast(viewport);
    const vtkMultiProcessController* processes = vtkMultiProcessController::GetGlobalController();
    const bool is_first = processes == nullptr || const_cast<vtkMultiProcessController*>(processes)->GetLocalProcessId() == 0;
    if (renderer == nullptr || renderer->GetSelector() != nullptr || !m_volume || !is_first || !draw(*renderer)) {
        return 0;
    }
    put(*renderer);
    return 1;
}

bool PictureProp::draw(vtkRenderer& renderer) {
    const std::string scene = scene_of_view(renderer, m_items);
    if (scene == m_scene) {
        return m_has_picture;
    }
    m_scene = scene;
    m_size = size_of(renderer);
    m_has_picture = m_is_uploaded = false;
    try {
        const elvis::picture picture = m_volume->data.render(m_volume->context.parse_scene(scene));
        m_colors = picture.read<std::uint8_t>(ELVIS_CHANNEL_COLOR);
        m_depths = picture.read<double>(ELVIS_CHANNEL_DEPTH);
        tell(picture.remarks());
        m_has_picture = true;
    } catch (const elvis::error& error) {
        m_remarks = error.what();
        vtkErrorMacro(<< error.what());
    }
    return m_has_picture;
}

void PictureProp::tell(const std::vector<elvis::picture::remark>& remarks) {
    m_remarks.clear();
    std::string warnings;
    for (const elvis::picture::remark& remark : remarks) {
        m_remarks += (m_remarks.empty() ? "" : "\n") + remark.text;
        if (remark.is_warning) {
            warnings += (warnings.empty() ? "" : "\n") + remark.text;
        }
    }
    // Once, not with each turn of the camera.
    if (!warnings.empty() && warnings != m_warnings) {
        vtkWarningMacro(<< warnings);
    }
    m_warnings = warnings;
}

void PictureProp::put(vtkRenderer& renderer) {
    auto& window = *vtkOpenGLRenderWindow::SafeDownCast(renderer.GetRenderWindow());
    const auto width = static_cast<unsigned>(m_size[0]), height = static_cast<unsigned>(m_size[1]);
    if (!m_quad) {
        m_quad = std::make_unique<vtkOpenGLQuadHelper>(&window, nullptr, fragment_shader, nullptr, true);
        m_color_texture = make_texture(window);
        m_depth_texture = make_texture(window);
        m_is_uploaded = false;
    }
    if (!m_is_uploaded) {
        m_color_texture->Create2DFromRaw(width, height, 4, VTK_UNSIGNED_CHAR, m_colors.data());
        m_is_uploaded = true;
    }
    // The clipping range may have changed though the picture has not.
    std::vector<float> depths = buffer_depths(renderer, m_size, m_depths);
    m_depth_texture->Create2DFromRaw(width, height, 1, VTK_FLOAT, depths.data());

    vtkOpenGLState* state = window.GetState();
    const vtkOpenGLState::ScopedglEnableDisable tests(state, GL_DEPTH_TEST), blends(state, GL_BLEND);
    state->vtkglEnable(GL_DEPTH_TEST);
    state->vtkglDisable(GL_BLEND);
    state->vtkglDepthMask(GL_TRUE);
    window.GetShaderCache()->ReadyShaderProgram(m_quad->Program);
    m_color_texture->Activate();
    m_depth_texture->Activate();
    m_quad->Program->SetUniformi("colors", m_color_texture->GetTextureUnit());
    m_quad->Program->SetUniformi("depths", m_depth_texture->GetTextureUnit());
    m_quad->Render();
    m_depth_texture->Deactivate();
    m_color_texture->Deactivate();
}

void PictureProp::ReleaseGraphicsResources(vtkWindow* window) {
    if (m_quad) {
        m_quad->ReleaseGraphicsResources(window);
        m_quad.reset();
        m_color_texture->ReleaseGraphicsResources(window);
        m_depth_texture->ReleaseGraphicsResources(window);
    }
}

} // namespace elvis_paraview
