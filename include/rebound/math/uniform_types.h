// SPDX-License-Identifier: MIT
// GLSL's names for uniform vectors, for host code that includes shared structs. Included inside a namespace.
using glm::ivec2;
using glm::ivec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
