#include "view_buffers.hpp"

#include <vtkCamera.h>
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
#include <limits>
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

/** Where a camera's buffer has what lies at a distance along a pixel's ray. */
class DepthScale {
public:
    DepthScale(vtkCamera& camera, const PictureSize& size)
        : m_size(size), m_is_parallel(camera.GetParallelProjection() != 0),
          m_half(std::tan(camera.GetViewAngle() * std::numbers::pi / 360)) {
        camera.GetClippingRange(m_near, m_far);
    }

    double depth(double distance, int column, int row) const {
        const double ahead = distance * ahead_of_ray(column, row);
        return m_is_parallel ? (ahead - m_near) / (m_far - m_near) : m_far / (m_far - m_near) * (1 - m_near / ahead);
    }
    double distance(double depth, int column, int row) const {
        const double ahead =
            m_is_parallel ? m_near + depth * (m_far - m_near) : m_near * m_far / (m_far - depth * (m_far - m_near));
        return ahead / ahead_of_ray(column, row);
    }

private:
    /** How far a ray goes along the camera's axis in a unit of length. */
    double ahead_of_ray(int column, int row) const {
        const double x = m_half * (2 * column + 1 - m_size[0]) / m_size[1];
        const double y = m_half * (m_size[1] - 2 * row - 1) / m_size[1];
        return m_is_parallel ? 1 : 1 / std::sqrt(1 + x * x + y * y);
    }

    PictureSize m_size;
    bool m_is_parallel;
    double m_half, m_near = 0, m_far = 1;
};

vtkSmartPointer<vtkTextureObject> make_texture(vtkOpenGLRenderWindow& window) {
    auto texture = vtkSmartPointer<vtkTextureObject>::New();
    texture->SetContext(&window);
    texture->SetMinificationFilter(vtkTextureObject::Nearest);
    texture->SetMagnificationFilter(vtkTextureObject::Nearest);
    texture->SetWrapS(vtkTextureObject::ClampToEdge);
    texture->SetWrapT(vtkTextureObject::ClampToEdge);
    return texture;
}

vtkOpenGLRenderWindow& window_of(vtkRenderer& renderer) {
    return *vtkOpenGLRenderWindow::SafeDownCast(renderer.GetRenderWindow());
}

template <class Work> void each_pixel(const PictureSize& size, const Work& work) {
    for (int row = 0; row < size[1]; ++row) {
        for (int column = 0; column < size[0]; ++column) {
            work(static_cast<std::size_t>(row * size[0] + column), column, row);
        }
    }
}

} // namespace

std::vector<float> buffer_depths(vtkRenderer& renderer, const PictureSize& size, const std::vector<double>& distances) {
    const DepthScale scale(*renderer.GetActiveCamera(), size);
    std::vector<float> depths(distances.size(), 1.0F);
    each_pixel(size, [&](std::size_t pixel, int column, int row) {
        if (!std::isnan(distances[pixel])) {
            const double depth = std::max(scale.depth(distances[pixel], column, row), 0.0);
            // What is there is in front of the background.
            depths[pixel] = std::min(static_cast<float>(depth), std::nextafter(1.0F, 0.0F));
        }
    });
    return depths;
}

std::vector<double> drawn_distances(vtkRenderer& renderer, const PictureSize& size, const std::vector<double>& distances) {
    int width = 0, height = 0, left = 0, bottom = 0;
    renderer.GetTiledSizeAndOrigin(&width, &height, &left, &bottom);
    std::vector<float> buffer(distances.size());
    window_of(renderer).GetZbufferData(left, bottom, left + width - 1, bottom + height - 1, buffer.data());
    const std::vector<float> own = buffer_depths(renderer, size, distances);
    const DepthScale scale(*renderer.GetActiveCamera(), size);
    // Buffers of 24 bits round to half of a 2^24th.
    constexpr float rounding = 0x1p-24F;
    std::vector<double> drawn(distances.size(), std::numeric_limits<double>::infinity());
    each_pixel(size, [&](std::size_t pixel, int column, int row) {
        const float depth = buffer[static_cast<std::size_t>((size[1] - 1 - row) * size[0] + column)];
        if (!std::isnan(distances[pixel]) && std::abs(depth - own[pixel]) <= rounding) {
            drawn[pixel] = distances[pixel];
        } else if (depth < 1) {
            drawn[pixel] = scale.distance(depth, column, row);
        }
    });
    return drawn;
}

PictureQuad::PictureQuad() = default;
PictureQuad::~PictureQuad() = default;

void PictureQuad::put(vtkRenderer& renderer, const PictureSize& size, std::vector<std::uint8_t>& colors,
                      std::vector<float>& depths) {
    vtkOpenGLRenderWindow& window = window_of(renderer);
    const auto width = static_cast<unsigned>(size[0]), height = static_cast<unsigned>(size[1]);
    m_colors = make_texture(window);
    m_depths = make_texture(window);
    m_colors->Create2DFromRaw(width, height, 4, VTK_UNSIGNED_CHAR, colors.data());
    m_depths->Create2DFromRaw(width, height, 1, VTK_FLOAT, depths.data());
    vtkOpenGLState* state = window.GetState();
    const vtkOpenGLState::ScopedglEnableDisable tests(state, GL_DEPTH_TEST), blends(state, GL_BLEND);
    const vtkOpenGLState::ScopedglDepthMask masks(state);
    state->vtkglEnable(GL_DEPTH_TEST);
    state->vtkglDisable(GL_BLEND);
    state->vtkglDepthMask(GL_TRUE);
    draw(renderer);
}

void PictureQuad::blend(vtkRenderer& renderer, const PictureSize& size, std::vector<float>& colors) {
    vtkOpenGLRenderWindow& window = window_of(renderer);
    const auto width = static_cast<unsigned>(size[0]), height = static_cast<unsigned>(size[1]);
    std::vector<float> none(colors.size() / 4, 0.0F);
    m_colors = make_texture(window);
    m_depths = make_texture(window);
    m_colors->Create2DFromRaw(width, height, 4, VTK_FLOAT, colors.data());
    m_depths->Create2DFromRaw(width, height, 1, VTK_FLOAT, none.data());
    vtkOpenGLState* state = window.GetState();
    const vtkOpenGLState::ScopedglEnableDisable tests(state, GL_DEPTH_TEST), blends(state, GL_BLEND);
    const vtkOpenGLState::ScopedglBlendFuncSeparate functions(state);
    state->vtkglDisable(GL_DEPTH_TEST);
    state->vtkglEnable(GL_BLEND);
    state->vtkglBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    draw(renderer);
}

void PictureQuad::draw(vtkRenderer& renderer) {
    vtkOpenGLRenderWindow& window = window_of(renderer);
    if (!m_quad) {
        m_quad = std::make_unique<vtkOpenGLQuadHelper>(&window, nullptr, fragment_shader, nullptr, true);
    }
    window.GetShaderCache()->ReadyShaderProgram(m_quad->Program);
    m_colors->Activate();
    m_depths->Activate();
    m_quad->Program->SetUniformi("colors", m_colors->GetTextureUnit());
    m_quad->Program->SetUniformi("depths", m_depths->GetTextureUnit());
    m_quad->Render();
    m_depths->Deactivate();
    m_colors->Deactivate();
    m_colors->ReleaseGraphicsResources(&window);
    m_depths->ReleaseGraphicsResources(&window);
}

void PictureQuad::release(vtkWindow* window) {
    if (m_quad) {
        m_quad->ReleaseGraphicsResources(window);
        m_quad.reset();
    }
}

} // namespace elvis_paraview
