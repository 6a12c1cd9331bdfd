// SPDX-License-Identifier: MIT
#include "lab/images/reduce.hpp"

#include <algorithm>
#include <cmath>

namespace rebound::lab {

Image reduced(const Image& image, int factor) {
    const Extent2D extent{(image.width + factor - 1) / factor, (image.height + factor - 1) / factor};
    Image result(extent, image.channels);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const int columns = std::min(factor, image.width - x / factor * factor);
            const int rows = std::min(factor, image.height - y / factor * factor);
            for (int c = 0; c < image.channels; ++c)
                result.at(x / factor, y / factor)[c] += image.at(x, y)[c] / float(columns * rows);
        }
    return result;
}

Picture reduced(const Picture& picture, int factor) {
    Image image({picture.width, picture.height}, 3);
    std::copy(picture.rgb.begin(), picture.rgb.end(), image.data.begin());
    const Image small = reduced(image, factor);
    Picture result{small.width, small.height, std::vector<unsigned char>(small.data.size())};
    std::transform(small.data.begin(), small.data.end(), result.rgb.begin(),
                   [](float value) { return static_cast<unsigned char>(std::lround(value)); });
    return result;
}

} // namespace rebound::lab
