#include "presenter.hpp"

#include "error_place.hpp"
#include "picture_image.hpp"
#include "swapchain.hpp"

#include <core/base/error.hpp>
#include <core/vulkan/check.hpp>
#include <core/vulkan/instance.hpp>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>
#include <spdlog/spdlog.h>

#include <algorithm>

namespace elvis::view {

namespace {

/** ImGui's backend knows no other way to report. */
void check_backend(VkResult result) {
    if (result < 0) {
        spdlog::error("window: {}", vulkan_result_text(result));
    }
}

} // namespace

struct Presenter::Impl {
    GLFWwindow* window;
    Instance instance;
    SurfaceDevice target;
    VkSurfaceFormatKHR format{};
    VkRenderPass render_pass = VK_NULL_HANDLE;
    VkDescriptorPool descriptors = VK_NULL_HANDLE;
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    VkSemaphore acquired = VK_NULL_HANDLE;
    bool has_backend = false;
    std::unique_ptr<Swapchain> swapchain;
    /** By view. */
    std::array<std::unique_ptr<PictureImage>, 2> pictures;

    Impl(GLFWwindow* shown_in, const std::string& wanted, bool validation)
        : window(shown_in), instance(validation, window_extensions()) {
        try {
            check_vulkan(glfwCreateWindowSurface(instance.handle(), window, nullptr, &target.surface), error_place,
                         "making it known to Vulkan");
            choose_device(target, instance, wanted);
            create_device(target);
            format = display_format(target.physical, target.surface);
            render_pass = create_render_pass(target, format.format);
            create_commands();
            make_swapchain();
            start_backend();
        } catch (...) {
            release();
            throw;
        }
    }
    ~Impl() { release(); }

    void create_commands() {
        VkCommandPoolCreateInfo pool_info{};
        pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
        pool_info.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
        pool_info.queueFamilyIndex = target.family;
        check_vulkan(vkCreateCommandPool(target.device, &pool_info, nullptr, &pool), error_place, "creating its commands");
        VkCommandBufferAllocateInfo commands_info{};
        commands_info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        commands_info.commandPool = pool;
        commands_info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
        commands_info.commandBufferCount = 1;
        check_vulkan(vkAllocateCommandBuffers(target.device, &commands_info, &commands), error_place, "creating its commands");
        VkFenceCreateInfo fence_info{};
        fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        check_vulkan(vkCreateFence(target.device, &fence_info, nullptr, &fence), error_place, "creating its fence");
        VkSemaphoreCreateInfo semaphore_info{};
        semaphore_info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
        check_vulkan(vkCreateSemaphore(target.device, &semaphore_info, nullptr, &acquired), error_place,
                     "creating its semaphore");
    }

    void make_swapchain() {
        vkDeviceWaitIdle(target.device);
        int width = 0, height = 0;
        glfwGetFramebufferSize(window, &width, &height);
        const VkExtent2D size{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
        swapchain = std::make_unique<Swapchain>(target, format, render_pass, size, swapchain.get());
        if (has_backend) {
            ImGui_ImplVulkan_SetMinImageCount(swapchain->least_images());
        }
    }

    void start_backend() {
        const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 8};
        VkDescriptorPoolCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
        info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
        info.maxSets = 8;
        info.poolSizeCount = 1;
        info.pPoolSizes = &size;
        check_vulkan(vkCreateDescriptorPool(target.device, &info, nullptr, &descriptors), error_place,
                     "creating its descriptors");

        ImGui_ImplVulkan_InitInfo init{};
        init.Instance = instance.handle();
        init.PhysicalDevice = target.physical;
        init.Device = target.device;
        init.QueueFamily = target.family;
        init.Queue = target.queue;
        init.DescriptorPool = descriptors;
        init.MinImageCount = swapchain->least_images();
        init.ImageCount = static_cast<std::uint32_t>(swapchain->images().size());
        init.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
        init.CheckVkResultFn = check_backend;
        if (!ImGui_ImplVulkan_Init(&init, render_pass)) {
            throw Error(error_place, "the panels could not be set up");
        }
        has_backend = true;
        submit_and_wait([](VkCommandBuffer buffer) { ImGui_ImplVulkan_CreateFontsTexture(buffer); });
        ImGui_ImplVulkan_DestroyFontUploadObjects();
    }

    template <class Record> void submit_and_wait(const Record& record) {
        begin_commands();
        record(commands);
        submit();
    }

    /** What has been recorded, after one semaphore and before another; waits until it is done. */
    void submit(const VkSemaphore* awaited = nullptr, const VkSemaphore* signalled = nullptr) {
        check_vulkan(vkEndCommandBuffer(commands), error_place, "recording");
        const VkPipelineStageFlags wait_stage = VK_PIPELINE_STAGE_TRANSFER_BIT;
        VkSubmitInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        info.waitSemaphoreCount = awaited != nullptr ? 1 : 0;
        info.pWaitSemaphores = awaited;
        info.pWaitDstStageMask = &wait_stage;
        info.commandBufferCount = 1;
        info.pCommandBuffers = &commands;
        info.signalSemaphoreCount = signalled != nullptr ? 1 : 0;
        info.pSignalSemaphores = signalled;
        check_vulkan(vkQueueSubmit(target.queue, 1, &info, fence), error_place, "submitting");
        check_vulkan(vkWaitForFences(target.device, 1, &fence, VK_TRUE, UINT64_MAX), error_place, "waiting for its device");
        check_vulkan(vkResetFences(target.device, 1, &fence), error_place, "resetting its fence");
    }

    void begin_commands() {
        check_vulkan(vkResetCommandPool(target.device, pool, 0), error_place, "resetting commands");
        VkCommandBufferBeginInfo begin{};
        begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
        check_vulkan(vkBeginCommandBuffer(commands, &begin), error_place, "recording");
    }

    /** Background and pictures, into an image that is then ready for the render pass. */
    void record_pictures(VkImage image, std::span<const PixelBox> boxes, const std::array<float, 4>& background) {
        VkImageMemoryBarrier barrier{};
        barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
        barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.image = image;
        barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
        barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
        barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
        // The wait for the acquired image is for this stage, too.
        vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0,
                             nullptr, 1, &barrier);
        VkClearColorValue color{};
        std::copy(background.begin(), background.end(), color.float32);
        vkCmdClearColorImage(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &color, 1, &barrier.subresourceRange);
        barrier.oldLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
        barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
        vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0,
                             nullptr, 1, &barrier);
        for (std::size_t view = 0; view < boxes.size(); ++view) {
            const PixelBox& box = boxes[view];
            if (pictures[view]) {
                pictures[view]->record_copy(commands, image, swapchain->size(), {box.x, box.y}, {box.width, box.height});
            }
        }
    }

    /** Background, pictures and panels. */
    void record(const Swapchain::Image& image, ImDrawData* panels, std::span<const PixelBox> boxes,
                const std::array<float, 4>& background) {
        begin_commands();
        record_pictures(image.image, boxes, background);
        VkRenderPassBeginInfo pass{};
        pass.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
        pass.renderPass = render_pass;
        pass.framebuffer = image.framebuffer;
        pass.renderArea.extent = swapchain->size();
        vkCmdBeginRenderPass(commands, &pass, VK_SUBPASS_CONTENTS_INLINE);
        ImGui_ImplVulkan_RenderDrawData(panels, commands);
        vkCmdEndRenderPass(commands);
    }

    VkResult show(std::uint32_t index) {
        VkPresentInfoKHR info{};
        info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
        info.waitSemaphoreCount = 1;
        info.pWaitSemaphores = &swapchain->images()[index].drawn;
        info.swapchainCount = 1;
        const VkSwapchainKHR handle = swapchain->handle();
        info.pSwapchains = &handle;
        info.pImageIndices = &index;
        return vkQueuePresentKHR(target.queue, &info);
    }

    void present(ImDrawData* panels, std::span<const PixelBox> boxes, const std::array<float, 4>& background) {
        int width = 0, height = 0;
        glfwGetFramebufferSize(window, &width, &height);
        if (width == 0 || height == 0) {
            return; // Minimised.
        }
        std::uint32_t index = 0;
        // A display server may keep all images, as of a window that nobody sees: the rest of the program goes on.
        constexpr std::uint64_t patience = 500'000'000; // nanoseconds
        VkResult result = vkAcquireNextImageKHR(target.device, swapchain->handle(), patience, acquired, VK_NULL_HANDLE, &index);
        if (result == VK_TIMEOUT || result == VK_NOT_READY) {
            return;
        }
        if (result == VK_ERROR_OUT_OF_DATE_KHR) {
            make_swapchain();
            return; // The next frame comes at once: a change of size is followed by a wish to be drawn.
        }
        if (result != VK_SUBOPTIMAL_KHR) {
            check_vulkan(result, error_place, "getting an image");
        }
        const Swapchain::Image& image = swapchain->images()[index];
        record(image, panels, boxes, background);
        submit(&acquired, &image.drawn);
        result = show(index);
        const bool is_size_old = swapchain->size().width != static_cast<std::uint32_t>(width) ||
                                 swapchain->size().height != static_cast<std::uint32_t>(height);
        if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR || is_size_old) {
            make_swapchain();
        } else {
            check_vulkan(result, error_place, "presenting");
        }
    }

    void release() noexcept {
        if (target.device != VK_NULL_HANDLE) {
            vkDeviceWaitIdle(target.device);
            if (has_backend) {
                ImGui_ImplVulkan_Shutdown();
            }
            pictures = {};
            swapchain.reset();
            vkDestroyDescriptorPool(target.device, descriptors, nullptr);
            vkDestroySemaphore(target.device, acquired, nullptr);
            vkDestroyFence(target.device, fence, nullptr);
            vkDestroyCommandPool(target.device, pool, nullptr);
            vkDestroyRenderPass(target.device, render_pass, nullptr);
            vkDestroyDevice(target.device, nullptr);
        }
        if (target.surface != VK_NULL_HANDLE) {
            vkDestroySurfaceKHR(instance.handle(), target.surface, nullptr);
        }
    }
};

Presenter::Presenter(GLFWwindow* window, const std::string& wanted, bool validation)
    : m_impl(std::make_unique<Impl>(window, wanted, validation)) {}
Presenter::~Presenter() = default;

void Presenter::begin_frame() { ImGui_ImplVulkan_NewFrame(); }

void Presenter::set_picture(std::size_t view, std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba) {
    Impl& impl = *m_impl;
    std::unique_ptr<PictureImage>& picture = impl.pictures[view];
    if (!picture || picture->width() != width || picture->height() != height) {
        picture.reset();
        picture = std::make_unique<PictureImage>(impl.target.physical, impl.target.device, impl.format.format, width, height);
    }
    picture->write(rgba);
    impl.submit_and_wait([&](VkCommandBuffer commands) { picture->record_upload(commands); });
}

void Presenter::clear_picture(std::size_t view) { m_impl->pictures[view].reset(); }

void Presenter::present(ImDrawData* panels, std::span<const PixelBox> places, const std::array<float, 4>& background) {
    m_impl->present(panels, places, background);
}

const std::string& Presenter::device_name() const { return m_impl->target.name; }

std::vector<std::string> Presenter::validation_messages() const {
    const ValidationLog& log = m_impl->instance.log();
    const std::lock_guard lock(log.mutex);
    return log.messages;
}

} // namespace elvis::view
