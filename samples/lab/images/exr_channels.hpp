// SPDX-License-Identifier: MIT
// Which channels of an OpenEXR file make a picture.
#pragma once

#include "lab/images/image_files.hpp"

#include <ImfChannelList.h>

#include <string>
#include <vector>

namespace rebound::lab {

struct ExrChannels {
    std::vector<std::string> names;  // in the file, in the picture's order
    bool areColors = false;          // red, green and blue, which primaries belong to
    std::vector<std::string> others; // that the picture leaves out
};

// A layer's prefix, as in "ViewLayer.Normal.X", counts for nothing where there is one layer alone. Refuses channels that
// do not say which of them make the picture, integers and subsampled ones.
Result<ExrChannels> chooseExrChannels(const Imf::ChannelList&, ExrContent);

} // namespace rebound::lab
