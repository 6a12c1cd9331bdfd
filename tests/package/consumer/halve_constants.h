// SPDX-License-Identifier: MIT
// Shared by the kernel and its host.
struct HalveConstants {
    ivec4 extent; // .xy of the image [texels]
};
