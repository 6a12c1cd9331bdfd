#version 450
// SPDX-License-Identifier: MIT
// The lab's tone curve; the swapchain's format encodes sRGB.
layout(set = 0, binding = 0) uniform sampler2D composed;
layout(push_constant) uniform Curve { float exposure; } curve;
layout(location = 0) out vec4 color;

void main() {
    vec3 radiance = texelFetch(composed, ivec2(gl_FragCoord.xy), 0).rgb;
    color = vec4(1.0 - exp(-max(radiance, vec3(0.0)) * curve.exposure), 1.0);
}
