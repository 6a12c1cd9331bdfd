// SPDX-License-Identifier: MIT
#include "lab/charts/pictures.hpp"

#include "lab/images/reduce.hpp"

#include <algorithm>
#include <cmath>

namespace rebound::charts {

namespace {

constexpr int largestOnSheet = 800; // of each picture
constexpr int largestOnPage = 320;  // width and height [pixels]

// By which a picture becomes small enough.
int factorFor(Extent2D extent, int largest) {
    return (std::max(extent.width, extent.height) + largest - 1) / largest;
}

double meanOf(const lab::Image& image, const lab::Image& mask) {
    double sum = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < mask.data.size(); ++i)
        for (size_t c = 0; c < 3; ++c)
            if (const float value = image.data[i * 3 + c]; mask.data[i] > 0.0f && std::isfinite(value)) {
                sum += double(value);
                ++count;
            }
    return count == 0 ? 0.0 : sum / double(count);
}

} // namespace

double roundUp(double value) {
    if (!(value > 0.0) || !std::isfinite(value)) return 1.0;
    const double decade = std::pow(10.0, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0})
        if (value <= step * decade * (1.0 + 1e-9)) // of rounding in the logarithm
            return step * decade;
    return 10.0 * decade;
}

ViewPictures::ViewPictures(Truth of)
    : truth(std::move(of)), curve(lab::automaticToneCurve(truth.light)),
      scale(roundUp(meanOf(truth.light, truth.visible))),
      factor(factorFor(truth.light.extent(), largestOnPage)) {}

metrics::CompareOptions ViewPictures::options() const {
    metrics::CompareOptions chosen;
    chosen.mask = &truth.visible;
    chosen.curve = curve;
    if (!truth.halves[0].empty()) chosen.halves = metrics::TruthHalves{&truth.halves[0], &truth.halves[1]};
    return chosen;
}

Result<metrics::ErrorMetrics> ViewPictures::compare(const lab::Image& light) const {
    return metrics::compareImages(light, truth.light, options());
}

Result<PointPictures> ViewPictures::show(lab::Image light) const {
    auto error = metrics::errorPicture(light, truth.light, options(), scale);
    if (!error) return error.error();
    PointPictures pictures;
    pictures.shown = lab::toneMap(light, curve);
    pictures.smallShown = lab::toneMap(lab::reduced(light, factor), curve);
    pictures.smallError = lab::reduced(*error, factorFor({error->width, error->height}, largestOnPage));
    pictures.error = *std::move(error);
    pictures.light = std::move(light);
    return pictures;
}

Result<lab::Picture> ViewPictures::sheet(const std::vector<Captioned>& all) const {
    const int reduction = factorFor(truth.light.extent(), largestOnSheet);
    const auto shown = [&](const lab::Image& image, const lab::ToneCurve& through) {
        return lab::toneMap(lab::reduced(image, reduction), through);
    };
    std::vector<lab::CaptionedPicture> pictures = {
        {"truth: indirect light, albedo not in it", shown(truth.light, curve)},
        {"direct light", shown(truth.direct, lab::automaticToneCurve(truth.direct))}};
    for (const Captioned& one : all) {
        auto error = metrics::errorPicture(one.light, truth.light, options(), scale);
        if (!error) return error.error();
        pictures.push_back({one.caption, shown(one.light, curve)});
        pictures.push_back({"its error", lab::reduced(*error, reduction)});
    }
    return lab::contactSheet(pictures, 2);
}

Result<> ViewPictures::writeView(const std::string& base) const {
    if (auto written = lab::writePng(base + ".png", lab::toneMap(truth.light, curve)); !written)
        return written;
    const lab::Picture small = lab::toneMap(lab::reduced(truth.light, factor), curve);
    if (auto written = lab::writePng(base + "-small.png", small); !written) return written;
    return lab::writePng(base + "-direct.png",
                         lab::toneMap(truth.direct, lab::automaticToneCurve(truth.direct)));
}

} // namespace rebound::charts
