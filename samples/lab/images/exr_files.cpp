// SPDX-License-Identifier: MIT
#include "lab/files/output_file.hpp"
#include "lab/images/image_files.hpp"

#include "lab/images/exr_header.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace rebound::lab {

namespace {

namespace fs = std::filesystem;

constexpr float largestHalf = 65504.0f;

// OpenEXR runs in the calling thread, and keeps no pool.
constexpr int noThreads = 0;

Error unreadable(const fs::path& path, ErrorCode code, const std::string& reason) {
    return {code, "cannot read " + path.string() + ": " + reason};
}

Result<> checkWritable(const fs::path& path, const Image& image) {
    const bool sized = image.width >= 1 && image.height >= 1 && image.width <= maximumExtent &&
                       image.height <= maximumExtent;
    const bool known = image.channels == 1 || image.channels == 3 || image.channels == 4;
    if (sized && known &&
        image.data.size() == size_t(image.width) * size_t(image.height) * size_t(image.channels))
        return {};
    return invalidArgument("cannot write " + path.string() + ": the image is " + std::to_string(image.width) +
                           " x " + std::to_string(image.height) + " with " + std::to_string(image.channels) +
                           " channels and " + std::to_string(image.data.size()) + " values; expected 1 to " +
                           std::to_string(maximumExtent) + " pixels a side, and 1, 3 or 4 channels");
}

// Finite values that a half would round to infinity become the largest half; infinities and NaN stay.
std::vector<half> toHalf(const std::vector<float>& values) {
    std::vector<half> halves(values.size());
    std::transform(values.begin(), values.end(), halves.begin(), [](float value) {
        return half(std::isfinite(value) ? std::clamp(value, -largestHalf, largestHalf) : value);
    });
    return halves;
}

template <class Sample>
std::string encodeExr(const Image& image, std::vector<Sample> samples, Imf::PixelType type) {
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer frame;
    const size_t pixelStride = sizeof(Sample) * size_t(image.channels);
    for (int c = 0; c < image.channels; ++c) {
        const std::string name = image.channels == 1 ? "Y" : std::string(1, "RGBA"[c]);
        header.channels().insert(name, Imf::Channel(type));
        frame.insert(name, Imf::Slice(type, reinterpret_cast<char*>(samples.data() + c), pixelStride,
                                      pixelStride * size_t(image.width)));
    }
    Imf::StdOSStream stream;
    {
        Imf::OutputFile file(stream, header, noThreads);
        file.setFrameBuffer(frame);
        file.writePixels(image.height);
    }
    return stream.str();
}

// R,G,B with or without A, or Y; nothing where the file has none of these.
std::vector<std::string> colourChannels(const Imf::ChannelList& channels) {
    const auto has = [&](const char* name) { return channels.findChannel(name) != nullptr; };
    if (has("R") && has("G") && has("B"))
        return has("A") ? std::vector<std::string>{"R", "G", "B", "A"}
                        : std::vector<std::string>{"R", "G", "B"};
    if (has("Y") && !has("RY") && !has("BY")) return {"Y"};
    return {};
}

Result<std::vector<std::string>> readableChannels(const Imf::ChannelList& channels) {
    const std::vector<std::string> names = colourChannels(channels);
    if (names.empty())
        return Error{ErrorCode::invalidData, "it has none of the channels Y; R, G, B; R, G, B, A"};
    for (const std::string& name : names) {
        const Imf::Channel& channel = channels[name];
        if (channel.type != Imf::HALF && channel.type != Imf::FLOAT)
            return Error{ErrorCode::invalidData,
                         "channel " + name + " holds integers; expected half or float"};
        if (channel.xSampling != 1 || channel.ySampling != 1)
            return Error{ErrorCode::invalidData,
                         "channel " + name + " is subsampled; expected one value a pixel"};
    }
    return names;
}

Result<Image> decodeExr(const fs::path& path) {
    if (auto checked = checkExrHeader(path); !checked) return checked.error();
    Imf::InputFile file(path.c_str(), noThreads);
    auto names = readableChannels(file.header().channels());
    if (!names) return names.error();
    const Imath::Box2i window = file.header().dataWindow();
    Image image({window.max.x - window.min.x + 1, window.max.y - window.min.y + 1}, int(names->size()));
    Imf::FrameBuffer frame;
    const size_t pixelStride = sizeof(float) * names->size();
    for (size_t c = 0; c < names->size(); ++c)
        frame.insert((*names)[c], Imf::Slice::Make(Imf::FLOAT, image.data.data() + c, window, pixelStride,
                                                   pixelStride * size_t(image.width)));
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    return image;
}

} // namespace

Result<> writeExr(const fs::path& path, const Image& image, ExrPrecision precision) {
    if (auto writable = checkWritable(path, image); !writable) return writable;
    try {
        const std::string bytes = precision == ExrPrecision::half
                                      ? encodeExr(image, toHalf(image.data), Imf::HALF)
                                      : encodeExr(image, image.data, Imf::FLOAT);
        return writeFile(path, std::as_bytes(std::span(bytes)));
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::outOfMemory, "cannot write " + path.string() + ": out of memory"};
    } catch (const std::exception& failure) {
        return Error{ErrorCode::inputOutput, "cannot write " + path.string() + ": " + failure.what()};
    }
}

Result<Image> readExr(const fs::path& path) {
    std::error_code failure;
    const fs::file_status status = fs::status(path, failure);
    if (!fs::exists(status)) return unreadable(path, ErrorCode::notFound, "there is no such file");
    if (!fs::is_regular_file(status))
        return unreadable(path, ErrorCode::inputOutput, "it is not a regular file");
    try {
        auto image = decodeExr(path);
        if (!image) return unreadable(path, image.error().code, image.error().message);
        return image;
    } catch (const std::bad_alloc&) {
        return unreadable(path, ErrorCode::outOfMemory, "out of memory");
    } catch (const std::exception& thrown) {
        return unreadable(path, ErrorCode::invalidData, thrown.what());
    }
}

} // namespace rebound::lab
