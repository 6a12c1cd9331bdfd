// SPDX-License-Identifier: MIT
// Truth by path tracing: irradiance at the visible surfaces, separated by how many surfaces light met in
// between.
#pragma once

#include "lab/rays/embree_scene.hpp"
#include "lab/rays/frame.hpp"
#include "lab/scenes/scene.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rebound::lab {

// How surfaces shine, besides reflecting diffusely. All take the material's metallic and roughness as
// glTF 2.0 defines them: reflectance 0.04 at normal incidence for dielectrics, the base colour for metals,
// Schlick's Fresnel term, and width alpha = roughness^2; metals then have no diffuse reflectance.
enum class GlossyModel {
    diffuseOnly, // every surface is Lambertian with its base colour, metals too: what Rebound's techniques
                 // assume
    phong, // a lobe about the mirror direction, exponent 2 / alpha^2 - 2 (Neumann et al.: Compact Metallic
           // Reflectance Models), which becomes a mirror where it is narrow
    blinnPhong, // a lobe about the half vector, exponent 2 / alpha^2 - 2
    ggx,        // Trowbridge-Reitz with Smith's shadowing
};

struct PathTracerOptions {
    Extent2D extent{320, 180};
    int bounces = 8; // surfaces that light meets between the first it lights and the visible one, 0 to 64
    GlossyModel glossy = GlossyModel::diffuseOnly;
    int samples = 256; // paths a pixel at most, 1 to 2^20; rounded up to a multiple of pathTracerReplicates
    double error =
        0.0;           // ends as soon as relativeError is at most this; 0: never before all samples are taken
    uint32_t seed = 0; // another seed gives an independent estimate
    int threads = 0;   // 0: one a core
    Progress progress = {}; // of the share that is likely done
};

// Fails where an option is out of its range; the message names it.
Result<> validate(const PathTracerOptions&);

// Every pixel's paths belong to so many independent sequences, whose spread tells the error of their mean.
inline constexpr int pathTracerReplicates = 8;

// Row 0 on top, 3 channels but for the last; pixels that see nothing are 0. Light is in W m^-2 sr^-1; what
// the visible point sends to the camera is its emission + albedo * (direct + indirect) + glossy.
struct PathTracedLight {
    Image direct;      // E / pi of light straight from the lights, the environment and emissive surfaces
    Image firstBounce; // E / pi of light that met exactly one surface in between
    Image indirect;    // E / pi of light that met 1 to `bounces` surfaces in between
    // Estimates of the same by the first and by the second half of the paths, which are independent; the mean of both is
    // the estimate above.
    std::array<Image, 2> firstBounceHalves, indirectHalves;
    Image albedo; // diffuse reflectance under the options' glossy model
    Image glossy; // radiance by specular reflection at the visible point, whatever came before; empty without
    Image standardError; // 1 channel: of the luminance of indirect; of direct with 0 bounces
    int samples = 0;     // paths a pixel
    // Root of the mean of standardError^2 over the visible pixels, over the mean luminance there; 0 where
    // that is dark.
    double relativeError = 0.0;
};

// 32 hexadecimal digits: a hash of all that path-traced light depends on, the text of the path tracer and of what casts
// its rays included, but for how many samples are taken.
std::string pathTracerKey(const Scene&, const CameraView&, const PathTracerOptions&);

// Adds paths pass by pass; can be stopped after each, and taken up again from what it saved. The same scene,
// camera and options but for threads give the same bits for the same number of samples, whatever the passes
// and interruptions.
class PathTracer {
public:
    // The scene has to outlive the result. Fails where an option is out of its range, or the scene or camera
    // invalid.
    static Result<PathTracer> create(const Scene&, const CameraView&, const PathTracerOptions&);

    PathTracer(PathTracer&&) noexcept;
    PathTracer& operator=(PathTracer&&) noexcept;
    ~PathTracer();

    bool isDone() const;
    void addPass(); // up to 64 paths a pixel; precondition: not done
    PathTracedLight light() const;
    int samples() const; // paths a pixel so far

    // The scene that the paths run through; what observes its rays sees every one of them.
    EmbreeScene& embreeScene();

    // All that has been added up, about 290 bytes a pixel.
    std::vector<std::byte> save() const;
    // Takes up what was saved by a tracer of the same key. Fails, and changes nothing, where the bytes are
    // not that.
    Result<> restore(std::span<const std::byte>);

private:
    struct State;
    explicit PathTracer(std::unique_ptr<State>);

    std::unique_ptr<State> state;
};

// All passes.
Result<PathTracedLight> tracePaths(const Scene&, const CameraView&, const PathTracerOptions&);

} // namespace rebound::lab
