// SPDX-License-Identifier: MIT
// A mesh's material; MaterialConstants in engine/scene_data.hpp is its twin.
layout(binding = 0) uniform sampler2D baseColorTexture;
layout(binding = 1) uniform sampler2D emissionTexture;
layout(location = 0) uniform vec4 baseColor;
layout(location = 1) uniform vec4 emission; // .rgb radiance [W m^-2 sr^-1], .a opacity below which there is a hole

vec4 baseColorAt(vec2 coordinate, vec4 vertexColor) {
    vec4 color = vertexColor * baseColor * texture(baseColorTexture, coordinate);
    if (color.a < emission.a) discard;
    return color;
}
