/**
 * @file presenter.hpp
 * Shows the picture and the panels in a window: swapchain, upload, and ImGui's Vulkan backend.
 */
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

struct GLFWwindow;
struct ImDrawData;

namespace elvis::view {

/** Pixels of the framebuffer, from its upper left corner. */
struct PixelBox {
    int x = 0, y = 0, width = 0, height = 0;
};

/**
 * Has a Vulkan device of its own, with graphics and presentation: the one that computes needs neither, and need not even be the
 * same. Pictures pass through host memory. Use from the thread that owns the window; an ImGui context must be current.
 */
class Presenter {
public:
    /** `wanted`: index or part of the name of a device that is preferred. An Error if no device can draw into this window. */
    Presenter(GLFWwindow* window, const std::string& wanted, bool validation);
    ~Presenter();
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;

    /** Before ImGui::NewFrame. */
    void begin_frame();
    /** Of a view: four bytes a pixel, top row first; kept until the next one. */
    void set_picture(std::size_t view, std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba);
    void clear_picture(std::size_t view);
    /** The pictures, stretched to the places of their views, and the panels above them. */
    void present(ImDrawData* panels, std::span<const PixelBox> places, const std::array<float, 4>& background);

    const std::string& device_name() const;
    std::vector<std::string> validation_messages() const;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace elvis::view
