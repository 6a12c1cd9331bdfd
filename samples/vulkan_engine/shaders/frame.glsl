// SPDX-License-Identifier: MIT
// What every pass of a frame knows; FrameConstants in renderer.hpp is its twin.
layout(set = 0, binding = 0, std140) uniform Frame {
    mat4 viewProjection;         // world to clip space
    mat4 previousViewProjection; // of the frame before
    mat4 inverseViewProjection;
    mat4 shadowMatrix;           // world to the shadow map's clip space
    vec4 eye;                    // .xyz the camera's position, .w 1; orthographic: the direction towards the camera, .w 0
    vec4 shadow;                 // .x a texel's side: at unit distance [1] if .y is 1, anywhere [m] if .y is 0;
                                 // .z 1: emissive surfaces are among the lights
    ivec4 counts;                // .x lights, .y of them shadowed, .zw the picture's size [pixels]
} frame;
