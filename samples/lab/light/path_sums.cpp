// SPDX-License-Identifier: MIT
#include "lab/light/path_sums.hpp"

#include "lab/images/luminance.hpp"
#include "lab/scenes/content_hash.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace rebound::lab {

namespace {

constexpr size_t firstSum = 1 + size_t(pathTracerReplicates);
constexpr size_t quantityStride = 9; // two sums and the exact part, three channels each
constexpr int halfReplicates = pathTracerReplicates / 2;

size_t sumOf(PathSums::Quantity quantity) { return firstSum + size_t(quantity) * quantityStride; }

// What stands before the values in saved bytes.
struct Header {
    char format[16] = "rebound paths 2";
    char key[32] = {};
    char hash[32] = {}; // of the values
    uint64_t samples = 0;
    uint64_t count = 0; // of values
};

void store(Image& image, size_t pixel, glm::vec3 value) {
    for (int c = 0; c < 3; ++c) image.data[pixel * 3 + size_t(c)] = value[c];
}

std::string hashOf(std::span<const double> values) {
    ContentHash hash;
    hash.addRange(values);
    return hash.digits();
}

} // namespace

void PathSums::Pixel::add(Quantity quantity, int replicate, glm::vec3 value) const {
    double* sum = values + sumOf(quantity) + (replicate < halfReplicates ? 0 : 3);
    sum[0] += double(value.x);
    sum[1] += double(value.y);
    sum[2] += double(value.z);
}

void PathSums::Pixel::setExact(Quantity quantity, glm::vec3 value) const {
    double* exact = values + sumOf(quantity) + 6;
    exact[0] = double(value.x);
    exact[1] = double(value.y);
    exact[2] = double(value.z);
}

PathSums::PathSums(Extent2D size, bool glossyToo)
    : extent(size), hasGlossy(glossyToo), stride(sumOf(glossy) + (glossyToo ? quantityStride : 0)),
      values(size_t(size.width) * size_t(size.height) * stride, 0.0) {}

glm::vec3 PathSums::mean(size_t pixel, Quantity quantity, int samples) const {
    const double* sum = &values[pixel * stride + sumOf(quantity)];
    const double share = 1.0 / (double(samples) * pathTracerReplicates);
    const auto channel = [&](size_t c) { return float((sum[c] + sum[3 + c]) * share + sum[6 + c]); };
    return {channel(0), channel(1), channel(2)};
}

glm::vec3 PathSums::halfMean(size_t pixel, Quantity quantity, size_t half, int samples) const {
    const double* sum = &values[pixel * stride + sumOf(quantity) + 3 * half];
    const double share = 1.0 / (double(samples) * halfReplicates);
    return {float(sum[0] * share), float(sum[1] * share), float(sum[2] * share)};
}

double PathSums::standardError(size_t pixel, int samples) const {
    const double* sums = &values[pixel * stride + 1];
    double mean = 0.0, variance = 0.0;
    for (int i = 0; i < pathTracerReplicates; ++i) mean += sums[i] / pathTracerReplicates;
    for (int i = 0; i < pathTracerReplicates; ++i)
        variance += (sums[i] - mean) * (sums[i] - mean) / (pathTracerReplicates - 1);
    return std::sqrt(variance / pathTracerReplicates) / double(samples);
}

PathTracedLight PathSums::light(int samples) const {
    PathTracedLight light;
    light.direct = light.firstBounce = light.indirect = Image(extent, 3);
    for (size_t half = 0; half < 2; ++half)
        light.firstBounceHalves[half] = light.indirectHalves[half] = Image(extent, 3);
    light.standardError = Image(extent, 1);
    if (hasGlossy) light.glossy = Image(extent, 3);
    for (size_t pixel = 0; pixel < values.size() / stride; ++pixel) {
        store(light.direct, pixel, mean(pixel, direct, samples));
        store(light.firstBounce, pixel, mean(pixel, firstBounce, samples));
        store(light.indirect, pixel, mean(pixel, indirect, samples));
        if (hasGlossy) store(light.glossy, pixel, mean(pixel, glossy, samples));
        for (size_t half = 0; half < 2; ++half) {
            store(light.firstBounceHalves[half], pixel, halfMean(pixel, firstBounce, half, samples));
            store(light.indirectHalves[half], pixel, halfMean(pixel, indirect, half, samples));
        }
        light.standardError.data[pixel] = float(standardError(pixel, samples));
    }
    return light;
}

double PathSums::relativeError(int samples) const {
    double squared = 0.0, sum = 0.0, visible = 0.0;
    for (size_t pixel = 0; pixel < values.size() / stride; ++pixel) {
        const double* value = &values[pixel * stride];
        visible += value[0];
        squared += std::pow(standardError(pixel, samples), 2.0);
        for (int i = 0; i < pathTracerReplicates; ++i)
            sum += value[1 + i] / (double(samples) * pathTracerReplicates);
    }
    return sum > 0.0 ? std::sqrt(squared / visible) / (sum / visible) : 0.0;
}

std::vector<std::byte> PathSums::save(const std::string& key, int samples) const {
    Header header;
    const std::string hash = hashOf(values);
    std::copy_n(key.begin(), std::min(key.size(), sizeof header.key), header.key);
    std::copy_n(hash.begin(), std::min(hash.size(), sizeof header.hash), header.hash);
    header.samples = uint64_t(samples);
    header.count = values.size();
    std::vector<std::byte> bytes(sizeof header + values.size() * sizeof(double));
    std::memcpy(bytes.data(), &header, sizeof header);
    std::memcpy(bytes.data() + sizeof header, values.data(), values.size() * sizeof(double));
    return bytes;
}

Result<int> PathSums::restore(const std::string& key, std::span<const std::byte> bytes) {
    const Header expected;
    Header header;
    const auto damaged = [](const char* what) {
        return Error{ErrorCode::invalidData, std::string("the stored paths are ") + what};
    };
    if (bytes.size() < sizeof header) return damaged("incomplete");
    std::memcpy(&header, bytes.data(), sizeof header);
    if (std::memcmp(header.format, expected.format, sizeof header.format) != 0)
        return damaged("of another version");
    if (std::string(header.key, sizeof header.key) != key || header.count != values.size())
        return damaged("of another scene, camera or setting");
    if (bytes.size() != sizeof header + values.size() * sizeof(double) || header.samples < 1 ||
        header.samples > uint64_t(1) << 20)
        return damaged("incomplete");
    std::vector<double> restored(values.size());
    std::memcpy(restored.data(), bytes.data() + sizeof header, restored.size() * sizeof(double));
    if (hashOf(restored) != std::string(header.hash, sizeof header.hash)) return damaged("damaged");
    values = std::move(restored);
    return int(header.samples);
}

} // namespace rebound::lab
