/**
 * @file picture_prop.hpp
 * Pictures of libelvis between the other things of a view.
 */
#pragma once

#include "open_volumes.hpp"
#include "scene_of_view.hpp"

#include <vtkProp.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkOpenGLQuadHelper;
class vtkTextureObject;

namespace elvis_paraview {

/**
 * Draws the items of a volume with the view's camera, and puts colours and depths into the view's buffers, so that other things
 * may be in front. With several ranks the first one draws all.
 */
class PictureProp : public vtkProp {
public:
    static PictureProp* New();
    vtkTypeMacro(PictureProp, vtkProp);

    /** Null: nothing is drawn. */
    void show(std::shared_ptr<OpenVolume> volume, const ShownItems& items);
    /** What the last picture's counts say, in sentences; "" if nothing is undecided. */
    const std::string& remarks() const { return m_remarks; }
    /** The scene of the last picture, as JSON. */
    const std::string& scene() const { return m_scene; }

    double* GetBounds() override;
    int RenderOpaqueGeometry(vtkViewport* viewport) override;
    void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
    PictureProp();
    ~PictureProp() override;

private:
    /** Whether there is a picture to be put into the buffers. */
    bool draw(vtkRenderer& renderer);
    void tell(const std::vector<elvis::picture::remark>& remarks);
    void put(vtkRenderer& renderer);

    std::shared_ptr<OpenVolume> m_volume;
    ShownItems m_items;
    std::array<double, 6> m_bounds{};
    /** Of the last picture, also if it failed. */
    std::string m_scene, m_remarks, m_warnings;
    std::array<int, 2> m_size{};
    bool m_has_picture = false, m_is_uploaded = false;
    /** Of each pixel, rows from above: four bytes, and the distance that the ray goes. */
    std::vector<std::uint8_t> m_colors;
    std::vector<double> m_depths;
    std::unique_ptr<vtkOpenGLQuadHelper> m_quad;
    vtkSmartPointer<vtkTextureObject> m_color_texture, m_depth_texture;
};

} // namespace elvis_paraview
