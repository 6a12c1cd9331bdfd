// SPDX-License-Identifier: MIT
// An engine's frame, read back, against the CPU device's and the lab's.
#pragma once

#include "pictures.hpp"

#include "lab/images/image_files.hpp"
#include "lab/rays/frame.hpp"
#include "lab/scenes/scene_files.hpp"

#include <string>

namespace rebound::engine {

// Kernels round to halves before they store, on every backend alike, so that means agree to a fraction of a half's last
// place, 2^-11 of a value at most: a driver's rounding towards zero, a dozen stores in a row, would darken by ten times
// that. Beside it, sums are ordered differently, and halves are 2^-10 apart, in the output as well; and where two of four
// texels represent a coarser one equally well, last bits choose between them, and light moves a little around it.
constexpr double mostMeansApart = 0x1p-12;
constexpr double mostOtherwise = 0x1p-10;

inline void checkAgreement(const std::string& what, lab::Image image, const lab::Image& expected) {
    const double ratio = mean(image) / mean(expected);
    for (float& value : image.data) value = float(double(value) / ratio);
    const Difference d = difference(image, expected);
    MESSAGE(what, ": means' ratio ", ratio, "; beside it ", d.average, " of the mean on average, ", d.root,
            " as root of the mean square, ", d.largest, " at most");
    CHECK(std::abs(ratio - 1.0) < mostMeansApart);
    CHECK(d.average < mostOtherwise);
    CHECK(d.root < 4.0 * mostOtherwise);
}

// The frame's indirect light and composition are the CPU device's on its G-buffer.
inline void checkIndirectLight(const ScreenIndirectSettings& settings,
                               const ScreenIndirectFrame<lab::Image>& frame) {
    const Light cpu = onCpu(settings, frame);
    CHECK(mean(frame.indirect) > 0.02 * mean(frame.lit)); // there is light to compare
    checkAgreement("indirect", frame.indirect, cpu.indirect);
    checkAgreement("composed", frame.composed, cpu.composed);
}

// Looks down into the atrium's court: seen straight on, walls and floor would be edges.
inline lab::CameraView orthographicView(const lab::Scene& atrium) {
    lab::CameraView view = atrium.cameras.at(0);
    view.position.y = 8.0f;
    view.orthographic = true;
    view.orthographicHeight = 8.0f;
    view.farPlane = 40.0f;
    return view;
}

// A G-buffer of halves, row 0 on top, is the lab's. distance: along the viewing axis, 0 where there is no surface.
inline void checkGBuffer(const lab::Image& distance, const lab::Image& normal, const lab::Image& albedo,
                         const lab::Frame& expected) {
    int different = 0;
    for (size_t i = 0; i < distance.data.size(); ++i) {
        bool same = std::abs(distance.data[i] - expected.depth.data[i]) <= 1e-4f * expected.depth.data[i];
        for (size_t c = 0; c < 3; ++c) // halves
            same = same && std::abs(normal.data[3 * i + c] - expected.normal.data[3 * i + c]) < 1e-3f &&
                   std::abs(albedo.data[3 * i + c] - expected.albedo.data[3 * i + c]) < 1e-3f;
        different += same ? 0 : 1;
    }
    MESSAGE(different, " of ", distance.data.size(), " pixels differ from the lab's G-buffer");
    // Where an edge passes through a pixel's centre, rasterisation and rays may decide differently.
    CHECK(different < int(distance.data.size() / 200));
}

// Through one tone curve: the mean of the differences of values 0 to 255, and the share of those above 32.
struct PictureDifference {
    double average = 0.0, far = 0.0;
};
inline PictureDifference pictureDifference(const lab::Image& image, const lab::Image& expected) {
    const lab::ToneCurve curve = lab::automaticToneCurve(expected);
    const lab::Picture a = lab::toneMap(image, curve), b = lab::toneMap(expected, curve);
    PictureDifference d;
    const double share = 1.0 / double(a.rgb.size());
    for (size_t i = 0; i < a.rgb.size(); ++i) {
        const int e = std::abs(int(a.rgb[i]) - int(b.rgb[i]));
        d.average += e * share;
        d.far += e > 32 ? share : 0.0;
    }
    return d;
}

// Of the Cornell box against `rebound render`'s picture. The lamp's soft shadows are one hard shadow of its centre here,
// and its near field 16 discs; edges are rasterised. That touches the shadows' rims, about a hundredth of the picture.
constexpr PictureDifference mostOfCornell{2.5, 0.02};

} // namespace rebound::engine
