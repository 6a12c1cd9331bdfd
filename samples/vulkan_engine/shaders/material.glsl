// SPDX-License-Identifier: MIT
// A mesh's material; MaterialConstants in engine/scene_data.hpp is its twin.
layout(set = 1, binding = 0) uniform sampler2D baseColorTexture;
layout(set = 1, binding = 1) uniform sampler2D emissionTexture;
layout(push_constant) uniform Material {
    vec4 baseColor;
    vec4 emission; // .rgb radiance [W m^-2 sr^-1], .a opacity below which there is a hole
} material;

vec4 baseColorAt(vec2 coordinate, vec4 vertexColor) {
    vec4 color = vertexColor * material.baseColor * texture(baseColorTexture, coordinate);
    if (color.a < material.emission.a) discard;
    return color;
}
