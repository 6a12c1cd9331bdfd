// SPDX-License-Identifier: MIT
// Examines a G-buffer and its camera, and says in sentences what does not fit together: most trouble with
// indirect light is an input that is not what the technique takes it for. For development, not for every
// frame; see docs/input_check.md. Of the library rebound::input_check, which brings what is declared here;
// the kernels are rebound::input_check_cpu's and rebound::input_check_shaders'.
//
//   inputCheckKernels() or inputCheckShaders()   for the device's options
//   planInputCheck()     what to run on a device, as for any technique
//   inputCheckInputs()   one frame's images and cameras
//   examineInputs()      what the device wrote, as findings
#pragma once

#include "rebound/camera.hpp"
#include "rebound/device.hpp"
#include "rebound/plan.hpp"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace rebound {

struct Shader;

// The kernels, for moreShaders of a GPU device's options, and for moreKernels of the CPU's.
std::span<const Shader* const> inputCheckShaders();
namespace cpu {
enum class Isa;
struct KernelEntry;
std::span<const KernelEntry* const> inputCheckKernels(Isa);
} // namespace cpu

struct InputCheckSettings {
    Extent2D resolution;              // of the G-buffer, 1x1 to 16384x16384 [pixels]
    GBufferConventions conventions{}; // how the G-buffer is said to be written
    MotionConventions motionConventions{};
    bool albedo = true; // which images a frame hands in beside depth and normal
    bool radiance = true;
    bool lit = false;
    bool emission = false; // tells light that surfaces emit from light that they reflect
    bool motion = false;   // needs a previous camera; the scene has to stand still
};

// Size of the image that the check writes, in 32-bit floats of four channels.
inline constexpr Extent2D inputStatisticsExtent{4, 11};
// Its texels, row by row.
using InputStatistics = std::array<float, size_t(4) * 4 * 11>;

// Fails where the resolution is out of its range.
//
// Inputs   depth, normal    as the conventions say
//          albedo           diffuse reflectance, 0 to 1                     (albedo only)
//          radiance         as planScreenIndirect() takes it                (radiance only)
//          lit              as planScreenIndirect() takes it                (lit only)
//          emission         what surfaces emit, as it is in radiance and lit (emission only)
//          motion           2 channels, as motionConventions say            (motion only)
// Outputs  statistics       4 channels of 32 bits, of inputStatisticsExtent: for examineInputs()
Result<Plan> planInputCheck(const InputCheckSettings&);

// One frame; what the settings leave out stays untouched.
template <class Image>
struct InputCheckFrame {
    Camera camera;
    Camera previousCamera; // with motion: of the picture that motion leads to
    Image depth{}, normal{}, albedo{}, radiance{}, lit{}, emission{}, motion{};
    Image statistics{};
};

// A frame as Program::record() takes it. Fails where a camera contradicts the conventions: that is a finding
// in itself.
template <class Image>
Result<FrameInputs<Image>> inputCheckInputs(const InputCheckSettings&, const InputCheckFrame<Image>&);

enum class InputProblem {
    camera,     // the matrices contradict the conventions
    noSurfaces, // nothing but sky
    depthNotFinite,
    depthNegative,
    depthOutOfRange, // device depth that is not 0 to 1
    depthDirection,  // forward and reversed are confused
    depthEncoding,   // another reading of depth gives the geometry that the normals belong to
    depthUnits,      // distances do not fit the clipping planes, or no scene
    normalsNotFinite,
    normalsNotUnit,
    normalsEncoding,        // signed and unsigned are confused
    normalsSpace,           // view and world space are confused, or world spaces of different axes
    normalsFlipped,         // one axis or all have the wrong sign
    normalsContradictDepth, // and no other reading that is tried explains it
    albedoNotFinite,
    albedoOutOfRange,
    albedoUniform, // all white or all black
    radianceNotFinite,
    radianceNegative,
    radianceClipped, // at the largest half float
    radianceBlack,
    radianceUnits,         // so bright or so dark that half floats lose it
    radianceWithoutAlbedo, // it is irradiance
    radianceAlbedoTwice,   // or albedo is not linear
    radianceSpecular,      // black surfaces shine
    litNotFinite,
    litNegative,
    litBlack,
    motionNotFinite,
    motionUnit,
    motionDirection,
    motionContradictsScene, // which was taken to stand still
};

enum class Certainty {
    suspicion, // a correct frame may look like this; the sentence says which
    mistake,
};

struct InputFinding {
    InputProblem problem;
    Certainty certainty = Certainty::mistake;
    double measure = 0.0; // the value in the sentence: a share of pixels or surfaces 0 to 1, a cosine, a
                          // distance or a radiance
    std::string sentence; // names the input, what was measured, what was expected, and the probable cause
};

// What the statistics of one frame say; nothing where all is well. Those of another frame's settings or
// camera give nonsense.
std::vector<InputFinding> examineInputs(const InputCheckSettings&, const Camera&, const InputStatistics&);

// A problem's name, as above.
const char* name(InputProblem);

} // namespace rebound

#include "rebound/detail/input_check.inl"
