/**
 * @file view_buffers.hpp
 * OpenGL's colours and depths of a view, and pictures that are put into them. Pictures have rows from the top.
 */
#pragma once

#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkRenderer;
class vtkTextureObject;
class vtkWindow;

namespace elvis_paraview {

/** Columns and rows. */
using PictureSize = std::array<int, 2>;

/** In OpenGL's buffer, of points that rays meet at a distance from their origins; 1 where they meet nothing (NaN). */
std::vector<float> buffer_depths(vtkRenderer& renderer, const PictureSize& size, const std::vector<double>& distances);

/**
 * The other way round, of what the view has drawn; infinite where there is nothing. Where it is what buffer_depths(distances)
 * put there, the distance is the given one, else as exact as the buffer is.
 */
std::vector<double> drawn_distances(vtkRenderer& renderer, const PictureSize& size, const std::vector<double>& distances);

/** Puts pictures into the buffers of one window, in its context. */
class PictureQuad {
public:
    PictureQuad();
    ~PictureQuad();

    /** Opaque: four bytes a pixel, and depths of the buffer; nothing where alpha is 0. */
    void put(vtkRenderer& renderer, const PictureSize& size, std::vector<std::uint8_t>& colors, std::vector<float>& depths);
    /** Over what is there: red, green, blue, and alpha, by which they are not multiplied. */
    void blend(vtkRenderer& renderer, const PictureSize& size, std::vector<float>& colors);
    void release(vtkWindow* window);

private:
    void draw(vtkRenderer& renderer);

    std::unique_ptr<vtkOpenGLQuadHelper> m_quad;
    vtkSmartPointer<vtkTextureObject> m_colors, m_depths;
};

} // namespace elvis_paraview
