// SPDX-License-Identifier: MIT
// Rays for baking, cast by Embree.
#pragma once

#include "rebound/bake/geometry.hpp"
#include "rebound/bake/rays.hpp"
#include "rebound/result.hpp"

#include <memory>

namespace rebound {

class EmbreeRayCaster : public RayCaster {
public:
    // Copies what it needs of the geometry, which need not outlive it; `surface` is copied, and called for triangles that
    // may have holes. Fails where the geometry is not valid, Embree cannot start, or memory is short.
    static Result<EmbreeRayCaster> build(const BakeGeometry&);

    EmbreeRayCaster(EmbreeRayCaster&&) noexcept;
    EmbreeRayCaster& operator=(EmbreeRayCaster&&) noexcept;
    ~EmbreeRayCaster() override;

    void intersect(std::span<const BakeRay>, std::span<BakeHit>) const override;
    void occluded(std::span<const BakeRay>, std::span<uint8_t>) const override;

private:
    struct State;
    explicit EmbreeRayCaster(std::unique_ptr<State>);

    std::unique_ptr<State> state;
};

} // namespace rebound
