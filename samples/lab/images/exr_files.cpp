// SPDX-License-Identifier: MIT
#include "lab/files/output_file.hpp"
#include "lab/images/image_files.hpp"

#include "lab/images/exr_channels.hpp"
#include "lab/images/exr_colors.hpp"
#include "lab/images/exr_header.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <string>
#include <vector>

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

Extent2D sizeOf(const Imath::Box2i& window) {
    return {window.max.x - window.min.x + 1, window.max.y - window.min.y + 1};
}

Image readPixels(Imf::InputFile& file, const ExrChannels& channels) {
    const Imath::Box2i window = file.header().dataWindow();
    Image image(sizeOf(window), int(channels.names.size()));
    Imf::FrameBuffer frame;
    const size_t pixelStride = sizeof(float) * channels.names.size();
    for (size_t c = 0; c < channels.names.size(); ++c)
        frame.insert(channels.names[c], Imf::Slice::Make(Imf::FLOAT, image.data.data() + c, window,
                                                         pixelStride, pixelStride * size_t(image.width)));
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    return image;
}

// Cut to the display window, or set into it.
Image display(Image stored, const Imath::Box2i& data, const Imath::Box2i& shown, float outside) {
    if (data == shown) return stored;
    Image image(sizeOf(shown), stored.channels, outside);
    const int left = std::max(data.min.x, shown.min.x), right = std::min(data.max.x, shown.max.x);
    for (int y = std::max(data.min.y, shown.min.y); y <= std::min(data.max.y, shown.max.y); ++y)
        std::copy_n(stored.at(left - data.min.x, y - data.min.y),
                    size_t(right - left + 1) * size_t(stored.channels),
                    image.at(left - shown.min.x, y - shown.min.y));
    return image;
}

std::string toText(const Imath::Box2i& window) {
    return std::to_string(window.min.x) + ", " + std::to_string(window.min.y) + " to " +
           std::to_string(window.max.x) + ", " + std::to_string(window.max.y);
}

void noteHeader(const Imf::Header& header, const ExrChannels& channels, bool converts,
                std::vector<std::string>& notes) {
    const Imath::Box2i data = header.dataWindow(), shown = header.displayWindow();
    if (data != shown) {
        const bool covers = data.min.x <= shown.min.x && data.min.y <= shown.min.y &&
                            data.max.x >= shown.max.x && data.max.y >= shown.max.y;
        notes.push_back("its data window, " + toText(data) + ", is not its display window, " + toText(shown) +
                        ", whose size the picture has" +
                        (covers ? "" : "; where they do not overlap it holds nothing"));
    }
    if (std::abs(header.pixelAspectRatio() - 1.0f) > 1e-3f)
        notes.push_back("its pixels are " + std::to_string(header.pixelAspectRatio()) +
                        " times as wide as high; they are taken for squares");
    if (converts) notes.push_back("its header states other primaries; its colours are converted to Rec. 709");
    std::string others;
    for (const std::string& name : channels.others)
        others += (others.empty() ? "" : ", ") + name.substr(0, 40);
    if (!others.empty()) notes.push_back("its channels " + others + " are left out");
}

// Runs a step; OpenEXR's words would name things that a file's author has never heard of.
template <class Step>
auto orProblem(const char* problem, const Step& step) -> decltype(step()) {
    try {
        return step();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {
        return Error{ErrorCode::invalidData, problem};
    }
}

Result<Image> decodeExr(const fs::path& path, const ExrReading& reading) {
    constexpr const char* badHeader = "its header is damaged or cut off, or it is no OpenEXR file";
    if (auto checked = orProblem(badHeader, [&] { return checkExrHeader(path); }); !checked)
        return checked.error();
    std::optional<Imf::InputFile> file;
    auto channels = orProblem(badHeader, [&]() -> Result<ExrChannels> {
        file.emplace(path.c_str(), noThreads);
        return chooseExrChannels(file->header().channels(), reading.content);
    });
    if (!channels) return channels.error();
    const Imf::Header& header = file->header();
    std::optional<glm::dmat3> conversion;
    if (channels->areColors && reading.content != ExrContent::normal) {
        auto primaries = toRec709(header);
        if (!primaries) return primaries.error();
        conversion = *primaries;
    }
    auto stored = orProblem("its pixels are damaged or cut off",
                            [&]() -> Result<Image> { return readPixels(*file, *channels); });
    if (!stored) return stored;
    Image image = display(*std::move(stored), header.dataWindow(), header.displayWindow(), reading.outside);
    if (conversion) convertColors(image, *conversion);
    if (reading.notes) {
        std::vector<std::string> notes;
        noteHeader(header, *channels, conversion.has_value(), notes);
        for (const std::string& note : notes) reading.notes->push_back(path.string() + ": " + note);
    }
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
    } catch (const std::exception&) {
        return Error{ErrorCode::inputOutput, "cannot write " + path.string() + ": it cannot be encoded"};
    }
}

Result<Image> readExr(const fs::path& path, const ExrReading& reading) {
    std::error_code failure;
    const fs::file_status status = fs::status(path, failure);
    if (!fs::exists(status)) return unreadable(path, ErrorCode::notFound, "there is no such file");
    if (!fs::is_regular_file(status))
        return unreadable(path, ErrorCode::inputOutput, "it is not a regular file");
    try {
        auto image = decodeExr(path, reading);
        if (!image) return unreadable(path, image.error().code, image.error().message);
        return image;
    } catch (const std::bad_alloc&) {
        return unreadable(path, ErrorCode::outOfMemory, "out of memory");
    }
}

} // namespace rebound::lab
