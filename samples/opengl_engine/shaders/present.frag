#version 430
// SPDX-License-Identifier: MIT
// The lab's tone curve; the window's framebuffer encodes sRGB.
layout(binding = 0) uniform sampler2D composed;
layout(location = 0) uniform float exposure;
layout(location = 0) out vec4 color;

void main() {
    vec3 radiance = texelFetch(composed, ivec2(gl_FragCoord.xy), 0).rgb;
    color = vec4(1.0 - exp(-max(radiance, vec3(0.0)) * exposure), 1.0);
}
