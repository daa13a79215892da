#include "presenter.hpp"

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
#include <cstring>
#include <optional>

namespace elvis::view {

namespace {

constexpr const char* place = "window";

std::span<const char* const> window_extensions() {
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    if (names == nullptr) {
        throw Error(place, "this machine has no Vulkan driver that can show pictures in windows (Debian package "
                           "mesa-vulkan-drivers has one for the CPU)");
    }
    return {names, count};
}

bool has_swapchains(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data());
    return std::any_of(extensions.begin(), extensions.end(), [](const VkExtensionProperties& extension) {
        return std::strcmp(extension.extensionName, VK_KHR_SWAPCHAIN_EXTENSION_NAME) == 0;
    });
}

/** A family with graphics that can present to the surface, if the device has one. */
std::optional<std::uint32_t> queue_family(VkPhysicalDevice device, VkSurfaceKHR surface) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    for (std::uint32_t family = 0; family < count; ++family) {
        VkBool32 presents = VK_FALSE;
        if (vkGetPhysicalDeviceSurfaceSupportKHR(device, family, surface, &presents) == VK_SUCCESS && presents == VK_TRUE &&
            (families[family].queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0) {
            return family;
        }
    }
    return std::nullopt;
}

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
    std::string name;
    std::uint32_t family = 0;
    VkQueue queue = VK_NULL_HANDLE;
    VkSurfaceFormatKHR format{};
    VkRenderPass render_pass = VK_NULL_HANDLE;
    VkDescriptorPool descriptors = VK_NULL_HANDLE;
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    VkSemaphore acquired = VK_NULL_HANDLE;
    bool has_backend = false;
    std::unique_ptr<Swapchain> swapchain;
    std::unique_ptr<PictureImage> picture;

    Impl(GLFWwindow* shown_in, const std::string& wanted, bool validation)
        : window(shown_in), instance(validation, window_extensions()) {
        try {
            check_vulkan(glfwCreateWindowSurface(instance.handle(), window, nullptr, &target.surface), place,
                         "making it known to Vulkan");
            choose_device(wanted);
            create_device();
            create_render_pass();
            create_commands();
            make_swapchain();
            start_backend();
        } catch (...) {
            release();
            throw;
        }
    }
    ~Impl() { release(); }

    /** The wanted one if it can present, else the first that can. */
    void choose_device(const std::string& wanted) {
        const std::vector<DeviceSummary> summaries = instance.summaries();
        const std::vector<VkPhysicalDevice> devices = instance.physical_devices();
        std::vector<DeviceSummary> able;
        for (std::size_t i = 0; i < devices.size(); ++i) {
            if (has_swapchains(devices[i]) && queue_family(devices[i], target.surface)) {
                able.push_back(summaries[i]);
            }
        }
        if (able.empty()) {
            throw Error(place, "no Vulkan device of this machine can show pictures in it");
        }
        DeviceSummary chosen = able.front();
        try {
            chosen = choose_among(able, wanted);
        } catch (const Error& error) {
            spdlog::info("window: {}; it is shown by {}", error.what(), chosen.name);
        }
        target.physical = devices[chosen.index];
        name = chosen.name;
        family = *queue_family(target.physical, target.surface);
    }

    void create_device() {
        const float priority = 1;
        VkDeviceQueueCreateInfo queue_info{};
        queue_info.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
        queue_info.queueFamilyIndex = family;
        queue_info.queueCount = 1;
        queue_info.pQueuePriorities = &priority;
        const char* extension = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
        VkDeviceCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
        info.queueCreateInfoCount = 1;
        info.pQueueCreateInfos = &queue_info;
        info.enabledExtensionCount = 1;
        info.ppEnabledExtensionNames = &extension;
        check_vulkan(vkCreateDevice(target.physical, &info, nullptr, &target.device), place, "creating its device");
        vkGetDeviceQueue(target.device, family, 0, &queue);
    }

    void create_render_pass() {
        format = display_format(target.physical, target.surface);
        VkAttachmentDescription attachment{};
        attachment.format = format.format;
        attachment.samples = VK_SAMPLE_COUNT_1_BIT;
        attachment.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD; // The picture is there already.
        attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachment.initialLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
        attachment.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
        const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        VkSubpassDescription subpass{};
        subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
        subpass.colorAttachmentCount = 1;
        subpass.pColorAttachments = &reference;
        VkSubpassDependency before{};
        before.srcSubpass = VK_SUBPASS_EXTERNAL;
        before.srcStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT;
        before.dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
        before.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
        before.dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
        VkRenderPassCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
        info.attachmentCount = 1;
        info.pAttachments = &attachment;
        info.subpassCount = 1;
        info.pSubpasses = &subpass;
        info.dependencyCount = 1;
        info.pDependencies = &before;
        check_vulkan(vkCreateRenderPass(target.device, &info, nullptr, &render_pass), place, "creating its render pass");
    }

    void create_commands() {
        VkCommandPoolCreateInfo pool_info{};
        pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
        pool_info.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
        pool_info.queueFamilyIndex = family;
        check_vulkan(vkCreateCommandPool(target.device, &pool_info, nullptr, &pool), place, "creating its commands");
        VkCommandBufferAllocateInfo commands_info{};
        commands_info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        commands_info.commandPool = pool;
        commands_info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
        commands_info.commandBufferCount = 1;
        check_vulkan(vkAllocateCommandBuffers(target.device, &commands_info, &commands), place, "creating its commands");
        VkFenceCreateInfo fence_info{};
        fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        check_vulkan(vkCreateFence(target.device, &fence_info, nullptr, &fence), place, "creating its fence");
        VkSemaphoreCreateInfo semaphore_info{};
        semaphore_info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
        check_vulkan(vkCreateSemaphore(target.device, &semaphore_info, nullptr, &acquired), place, "creating its semaphore");
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
        check_vulkan(vkCreateDescriptorPool(target.device, &info, nullptr, &descriptors), place, "creating its descriptors");

        ImGui_ImplVulkan_InitInfo init{};
        init.Instance = instance.handle();
        init.PhysicalDevice = target.physical;
        init.Device = target.device;
        init.QueueFamily = family;
        init.Queue = queue;
        init.DescriptorPool = descriptors;
        init.MinImageCount = swapchain->least_images();
        init.ImageCount = static_cast<std::uint32_t>(swapchain->images().size());
        init.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
        init.CheckVkResultFn = check_backend;
        if (!ImGui_ImplVulkan_Init(&init, render_pass)) {
            throw Error(place, "the panels could not be set up");
        }
        has_backend = true;
        submit_and_wait([](VkCommandBuffer buffer) { ImGui_ImplVulkan_CreateFontsTexture(buffer); });
        ImGui_ImplVulkan_DestroyFontUploadObjects();
    }

    template <class Record> void submit_and_wait(const Record& record) {
        begin_commands();
        record(commands);
        check_vulkan(vkEndCommandBuffer(commands), place, "recording");
        VkSubmitInfo submit{};
        submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        submit.commandBufferCount = 1;
        submit.pCommandBuffers = &commands;
        check_vulkan(vkQueueSubmit(queue, 1, &submit, fence), place, "submitting");
        wait();
    }

    void begin_commands() {
        check_vulkan(vkResetCommandPool(target.device, pool, 0), place, "resetting commands");
        VkCommandBufferBeginInfo begin{};
        begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
        check_vulkan(vkBeginCommandBuffer(commands, &begin), place, "recording");
    }

    void wait() {
        check_vulkan(vkWaitForFences(target.device, 1, &fence, VK_TRUE, UINT64_MAX), place, "waiting for its device");
        check_vulkan(vkResetFences(target.device, 1, &fence), place, "resetting its fence");
    }

    /** Background and picture, into an image that is then ready for the render pass. */
    void record_picture(VkImage image, const PixelBox& box, const std::array<float, 4>& background) {
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
        if (!picture) {
            return;
        }
        barrier.oldLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
        barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
        vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0,
                             nullptr, 1, &barrier);
        picture->record_copy(commands, image, swapchain->size(), {box.x, box.y}, {box.width, box.height});
    }

    void present(ImDrawData* panels, const PixelBox& box, const std::array<float, 4>& background) {
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
            check_vulkan(result, place, "getting an image");
        }
        const Swapchain::Image& image = swapchain->images()[index];
        begin_commands();
        record_picture(image.image, box, background);
        VkRenderPassBeginInfo pass{};
        pass.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
        pass.renderPass = render_pass;
        pass.framebuffer = image.framebuffer;
        pass.renderArea.extent = swapchain->size();
        vkCmdBeginRenderPass(commands, &pass, VK_SUBPASS_CONTENTS_INLINE);
        ImGui_ImplVulkan_RenderDrawData(panels, commands);
        vkCmdEndRenderPass(commands);
        check_vulkan(vkEndCommandBuffer(commands), place, "recording");

        const VkPipelineStageFlags wait_stage = VK_PIPELINE_STAGE_TRANSFER_BIT;
        VkSubmitInfo submit{};
        submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        submit.waitSemaphoreCount = 1;
        submit.pWaitSemaphores = &acquired;
        submit.pWaitDstStageMask = &wait_stage;
        submit.commandBufferCount = 1;
        submit.pCommandBuffers = &commands;
        submit.signalSemaphoreCount = 1;
        submit.pSignalSemaphores = &image.drawn;
        check_vulkan(vkQueueSubmit(queue, 1, &submit, fence), place, "submitting");
        wait();

        VkPresentInfoKHR info{};
        info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
        info.waitSemaphoreCount = 1;
        info.pWaitSemaphores = &image.drawn;
        info.swapchainCount = 1;
        const VkSwapchainKHR handle = swapchain->handle();
        info.pSwapchains = &handle;
        info.pImageIndices = &index;
        result = vkQueuePresentKHR(queue, &info);
        const bool is_size_old = swapchain->size().width != static_cast<std::uint32_t>(width) ||
                                 swapchain->size().height != static_cast<std::uint32_t>(height);
        if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR || is_size_old) {
            make_swapchain();
        } else {
            check_vulkan(result, place, "presenting");
        }
    }

    void release() noexcept {
        if (target.device != VK_NULL_HANDLE) {
            vkDeviceWaitIdle(target.device);
            if (has_backend) {
                ImGui_ImplVulkan_Shutdown();
            }
            picture.reset();
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

void Presenter::set_picture(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba) {
    Impl& impl = *m_impl;
    if (!impl.picture || impl.picture->width() != width || impl.picture->height() != height) {
        impl.picture.reset();
        impl.picture =
            std::make_unique<PictureImage>(impl.target.physical, impl.target.device, impl.format.format, width, height);
    }
    impl.picture->write(rgba);
    impl.submit_and_wait([&](VkCommandBuffer commands) { impl.picture->record_upload(commands); });
}

void Presenter::clear_picture() { m_impl->picture.reset(); }

void Presenter::present(ImDrawData* panels, const PixelBox& box, const std::array<float, 4>& background) {
    m_impl->present(panels, box, background);
}

const std::string& Presenter::device_name() const { return m_impl->name; }

std::vector<std::string> Presenter::validation_messages() const {
    const ValidationLog& log = m_impl->instance.log();
    const std::lock_guard lock(log.mutex);
    return log.messages;
}

} // namespace elvis::view
