// SPDX-License-Identifier: MIT
#include "lab/engine/orbit.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <string>

namespace rebound::engine {

void Orbit::turn(double right, double up) {
    const glm::vec3 arm = view.position - view.target;
    const glm::vec3 axis = glm::normalize(glm::cross(view.up, arm));
    const glm::mat4 turned =
        glm::rotate(glm::rotate(glm::mat4(1.0f), float(-right), view.up), float(-up), axis);
    const glm::vec3 next = glm::mat3(turned) * arm;
    // Not over the poles, where up is along the view.
    if (glm::length(glm::cross(glm::normalize(next), glm::normalize(view.up))) > 0.05f)
        view.position = view.target + next;
}

void Orbit::listen(GLFWwindow* window) {
    glfwSetWindowUserPointer(window, this);
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
        Orbit& self = *static_cast<Orbit*>(glfwGetWindowUserPointer(w));
        constexpr double radiansPerPixel = 0.005;
        if (glfwGetMouseButton(w, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS)
            self.turn((x - self.lastX) * radiansPerPixel, (y - self.lastY) * radiansPerPixel);
        self.lastX = x;
        self.lastY = y;
    });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double notches) {
        lab::CameraView& v = static_cast<Orbit*>(glfwGetWindowUserPointer(w))->view;
        const float factor = float(std::pow(0.9, notches));
        v.position = v.target + (v.position - v.target) * factor;
        v.orthographicHeight *= factor;
    });
}

Error windowError(const char* what) {
    const char* reason = nullptr;
    glfwGetError(&reason);
    return {ErrorCode::unsupported,
            std::string("--window: ") + what + (reason ? std::string(": ") + reason : "")};
}

} // namespace rebound::engine
