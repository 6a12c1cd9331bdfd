// SPDX-License-Identifier: MIT
#include "window.hpp"

#include "frame_loop.hpp"
#include "renderer.hpp"
#include "swapchain.hpp"

#include "lab/images/image_files.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <vulkan/vulkan.h>

namespace rebound::engine {
namespace {

struct Surface {
    VkInstance instance = VK_NULL_HANDLE;
    VkSurfaceKHR handle = VK_NULL_HANDLE;
    ~Surface() {
        if (handle) vkDestroySurfaceKHR(instance, handle, nullptr);
    }
};

// Renders one frame aside, for an exposure that stays.
Result<float> exposureOf(const host::VulkanContext& context, Renderer& renderer,
                         const lab::CameraView& view) {
    auto done = context.run([&](VkCommandBuffer commands) { return renderer.record(commands, 0, view); });
    if (!done) return done.error();
    auto composed = renderer.read(renderer.targets().composed, 3);
    if (!composed) return composed.error();
    return lab::automaticToneCurve(*composed).exposure;
}

} // namespace

Result<std::unique_ptr<Window>> Window::create(Extent2D size, host::VulkanOptions& options) {
    if (!glfwInit()) return windowError("no window can be opened here");
    std::unique_ptr<Window> window(new Window);
    uint32_t count = 0;
    const char** extensions = glfwGetRequiredInstanceExtensions(&count);
    if (!extensions) return windowError("this display shows no Vulkan");
    options.instanceExtensions.assign(extensions, extensions + count);
    options.deviceExtensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window->handle = glfwCreateWindow(size.width, size.height, "Rebound", nullptr, nullptr);
    if (!window->handle) return windowError("no window can be opened here");
    return window;
}

Window::~Window() {
    if (handle) glfwDestroyWindow(handle);
    glfwTerminate();
}

Extent2D Window::pixels() const {
    Extent2D size;
    glfwGetFramebufferSize(handle, &size.width, &size.height);
    return size;
}

Result<> Window::show(const Options& o, const host::VulkanContext& context, const lab::Scene& scene,
                      const lab::CameraView& start) {
    orbit.view = start;
    orbit.listen(handle);
    const lab::CameraView& view = orbit.view;
    Surface surface{context.instance()};
    if (glfwCreateWindowSurface(context.instance(), handle, nullptr, &surface.handle) != VK_SUCCESS)
        return windowError("the window cannot show what Vulkan draws");
    auto swapchain = Swapchain::create(context, surface.handle);
    if (!swapchain) return swapchain.error();
    auto renderer = createRenderer(context, scene, o);
    if (!renderer) return renderer.error();
    if (auto sized = (*renderer)->resize(o.size, view); !sized) return sized;
    const auto exposure = exposureOf(context, **renderer, view);
    if (!exposure) return exposure.error();
    auto loop = FrameLoop::create(context); // after the renderer: it is destroyed first, and waits
    if (!loop) return loop.error();

    bool current = false; // whether the swapchain fits the window
    for (int shown = 0; !glfwWindowShouldClose(handle) && (!o.frames || shown < *o.frames);) {
        glfwPollEvents();
        if (pixels().width == 0 || pixels().height == 0) {
            glfwWaitEvents();
            continue;
        }
        if (!current || pixels() != (*swapchain)->extent()) {
            if (auto sized = (*swapchain)->resize(pixels()); !sized) return sized;
            if ((*swapchain)->extent() != (*renderer)->targets().lit.extent)
                if (auto sized = (*renderer)->resize((*swapchain)->extent(), view); !sized) return sized;
        }
        auto commands = (*loop)->begin();
        if (!commands) return commands.error();
        const auto image = (*swapchain)->acquire((*loop)->available());
        if (!image) return image.error();
        current = image->has_value();
        if (!current) {
            (*loop)->abandon();
            continue;
        }
        if (!o.bake.empty()) (*renderer)->set(momentOf(scene, shown), (*loop)->frame());
        if (auto recorded = (*renderer)->record(*commands, (*loop)->frame(), view); !recorded)
            return recorded;
        (*swapchain)
            ->recordPresent(*commands, (*loop)->frame(), **image, (*renderer)->targets().composed, *exposure);
        if (auto done = (*loop)->submit((*loop)->available(), (*swapchain)->drawn(**image)); !done)
            return done;
        const auto presented = (*swapchain)->present(**image);
        if (!presented) return presented.error();
        current = *presented;
        ++shown;
    }
    return {};
}

} // namespace rebound::engine
