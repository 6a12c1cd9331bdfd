// SPDX-License-Identifier: MIT
#include "lab/metrics/displayed_pair.hpp"

#include "lab/rays/parallel_rows.hpp"

namespace rebound::metrics {

namespace {

constexpr float black[3] = {0.0f, 0.0f, 0.0f};

void showPixel(const float* pixel, int channels, const lab::ToneCurve& curve, ColorPlanes& shown, size_t at) {
    shown[0].values[at] = double(lab::displayValue(pixel[0], curve));
    for (size_t c = 1; c < 3; ++c)
        shown[c].values[at] =
            channels == 1 ? shown[0].values[at] : double(lab::displayValue(pixel[c], curve));
}

ColorPlanes planesFor(const lab::Image& image) {
    const Plane plane(image.width, image.height);
    return {plane, plane, plane};
}

} // namespace

DisplayedPair displayedPair(const lab::Image& test, const lab::Image& truth, const ComparedPixels& pixels,
                            const lab::ToneCurve& curve) {
    DisplayedPair pair{planesFor(test), planesFor(truth)};
    const int channels = test.channels;
    lab::parallelRows(test.height, 0, {}, [&](int y) {
        for (int x = 0; x < test.width; ++x) {
            const float* t = test.at(x, y);
            const float* r = truth.at(x, y);
            const size_t i = size_t(y) * size_t(test.width) + size_t(x);
            if (pixels.states[i] != PixelState::counts) {
                if (!isFinite(r, channels)) r = isFinite(t, channels) ? t : black;
                t = r;
            }
            showPixel(t, channels, curve, pair.test, i);
            showPixel(r, channels, curve, pair.truth, i);
        }
    });
    return pair;
}

Plane lumaOf(const ColorPlanes& shown) {
    Plane luma(shown[0].width, shown[0].height);
    for (size_t i = 0; i < luma.values.size(); ++i)
        luma.values[i] =
            0.2126 * shown[0].values[i] + 0.7152 * shown[1].values[i] + 0.0722 * shown[2].values[i];
    return luma;
}

} // namespace rebound::metrics
