// SPDX-License-Identifier: MIT
// GpuLight in engine/lights.hpp is its twin.
struct Light {
    vec4 position;  // .xyz [m], .w kind
    vec4 direction; // .xyz the way light travels, or a surface's normal; .w the cosine of a spot's outer cone
    vec4 intensity; // .rgb [W m^-2], [W sr^-1]; .w the cosine of a spot's inner cone, or a surface's area over pi [m^2]
};
const int directional = 0, point = 1, spot = 2, surface = 3, twoSidedSurface = 4;
