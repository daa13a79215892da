/**
 * @file picture_prop.hpp
 * Pictures of libelvis between the other things of a view.
 */
#pragma once

#include "open_volumes.hpp"
#include "scene_of_view.hpp"
#include "view_buffers.hpp"

#include <vtkProp.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace elvis_paraview {

/**
 * Draws the items of a volume with the view's camera, and puts colours and depths into the view's buffers, so that other things
 * may be in front; then light of the volume in front of all that is there. With several ranks the first one draws the surfaces,
 * and there is no light, since no rank knows what the others draw.
 */
class PictureProp : public vtkProp {
public:
    static PictureProp* New();
    vtkTypeMacro(PictureProp, vtkProp);

    /** Null: nothing is drawn. */
    void show(std::shared_ptr<OpenVolume> volume, const ShownItems& items);
    /** What the last pictures' counts say, in sentences; "" if nothing is undecided. */
    const std::string& remarks() const { return m_remarks; }
    /** The last picture as a scene, JSON. */
    const std::string& scene() const { return m_scene; }

    double* GetBounds() override;
    int RenderOpaqueGeometry(vtkViewport* viewport) override;
    int RenderVolumetricGeometry(vtkViewport* viewport) override;
    void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
    PictureProp();
    ~PictureProp() override;

private:
    /** A picture that stays while its scene does. */
    struct Drawn {
        std::string scene;
        bool is_there = false;
        std::vector<elvis::picture::remark> remarks;
    };

    /** The viewport, if there is something to be drawn in it. */
    vtkRenderer* shown_in(vtkViewport* viewport) const;
    /** Calls `take` with the picture of another scene than the last one. `hidden_from` as in elvis_render_options. */
    template <class Take> void draw(Drawn& drawn, const std::string& scene, const double* hidden_from, const Take& take);
    void tell();
    double diagonal() const;

    std::shared_ptr<OpenVolume> m_volume;
    ShownItems m_items;
    std::array<double, 6> m_bounds{};
    PictureSize m_size{};
    Drawn m_surfaces, m_light;
    std::string m_scene, m_remarks, m_warnings;
    /** Of surfaces: four bytes a pixel, and the distance that its ray goes. */
    std::vector<std::uint8_t> m_colors;
    std::vector<double> m_distances;
    /** Of light: colours, and what it was that hid the volume. */
    std::vector<float> m_light_colors;
    std::vector<double> m_hidden_from;
    PictureQuad m_quad;
};

} // namespace elvis_paraview
