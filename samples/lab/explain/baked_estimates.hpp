// SPDX-License-Identifier: MIT
// Light at the visible surfaces by rays to the surfels of a bake, and under rules that step by step give up surfels.
#pragma once

#include "lab/baking/lit_bake.hpp"
#include "lab/explain/estimates.hpp"

#include <vector>

namespace rebound::explain {

// E / pi at every pixel, 3 channels, 0 where nothing is visible. All come from the same paths, so that what two of them
// share cancels in their difference.
struct BakedEstimates {
    lab::Image fromSurfels; // every ray ends at what the nearest surfel sends
    lab::Image
        exactDirect;       // what the ray meets has its own albedo and direct light; the rest is the surfel's
    lab::Image allBounces; // of the path tracer
    lab::Image standardError; // 1 channel: of the luminance of allBounces, as if the paths were independent
};

// sent: by surfel, the radiance that it sends, of all its light [W m^-2 sr^-1]. Fails as path tracing does.
Result<BakedEstimates> estimateFromSurfels(const lab::Scene&, const lab::CameraView&, const lab::LitBake&,
                                           const std::vector<glm::vec3>& sent, const EstimateOptions&);

} // namespace rebound::explain
