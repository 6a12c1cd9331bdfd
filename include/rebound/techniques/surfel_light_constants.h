// SPDX-License-Identifier: MIT
// Lights and shadow maps as surfel_light's kernels take them; shared by host, CPU and GPU (std140, std430).
#ifndef REBOUND_SURFEL_LIGHT_CONSTANTS_H
#define REBOUND_SURFEL_LIGHT_CONSTANTS_H

// Kinds of LightSource.
const int directionalSource = 0;
const int pointSource = 1;
const int spotSource = 2;
const int discSource = 3;         // a small flat part of a lamp, that shines to the side of its normal
const int twoSidedDiscSource = 4; // and to the other one

struct LightSource {
    vec4 position; // .xyz [m]; of a directional one, nothing
    vec4
        direction; // .xyz unit: the way light travels, a spot's axis, a disc's normal; .w cosine of a spot's outer cone
    // .rgb directional: irradiance on a plane that faces it [W m^-2]; point, spot: radiant intensity [W sr^-1]; disc: radiance
    // times area, which is intensity along the normal [W sr^-1]. .w cosine of a spot's inner cone; a disc's area over pi [m^2]
    vec4 intensity;
    ivec4 kind; // .x of the above; .y its first shadow view, .z how many: 0, and it shines through everything
};

// One image of depth as seen from a light, or a part of it: a cascade, a cube's face. Of a light's views, the first one that
// holds a place decides; what none of them holds is lit.
struct ShadowView {
    // Rows, whose products with (place in the world, 1) are: texel, x and y; stored depth; all three times the last one.
    vec4 x;
    vec4 y;
    vec4 z;
    vec4 w;
    vec4 tile;   // .xy first texel, .zw behind the last one
    ivec4 image; // .x number of the shadow map; .y 1: larger depths are farther, -1: nearer
    vec4
        distance; // .x how far a place is moved off its surface, times the last row's product [1], .y and besides that [m]
};

// A place on a surfel. .xy within the unit disc
struct SurfelPlace {
    vec4 place;
};

struct SurfelLightConstants {
    ivec4 counts; // .x surfels, .y from one kind of their numbers to the next, .z places on each
    ivec4 limits; // .x light sources that the buffer holds, .y shadow views
};

struct SurfelLightFrameConstants {
    ivec4 counts; // .x light sources
};

// Values of a feature: what an image of surfels holds.
const int imageOfIrradiance = 0;
const int imageOfReflection = 1;

struct SurfelImageConstants {
    ivec4 extent; // .xy of the images [pixels]
    ivec4 counts; // .x surfels, .y from one kind of their numbers to the next
};

#endif
