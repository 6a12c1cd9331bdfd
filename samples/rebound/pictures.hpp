// SPDX-License-Identifier: MIT
// Pictures of a frame for people: what went in, and what came out.
#pragma once

#include "lab/images/image_files.hpp"
#include "lab/rays/frame.hpp"

namespace rebound::cli {

struct RenderedImages {
    lab::Image direct;   // emission + albedo * E / pi of direct light [W m^-2 sr^-1]
    lab::Image indirect; // E / pi of indirect light
    lab::Image final;    // direct + albedo * indirect
};

// Direct, indirect and final light with one tone curve, albedo, normals and depth; large images are reduced.
lab::Picture contactSheetOf(const RenderedImages&, const lab::Frame&, const lab::ToneCurve&);

// Luminance of a signed difference: blue at -scale or below, white at 0, red at scale or above.
lab::Picture differencePicture(const lab::Image& difference, double scale);

} // namespace rebound::cli
