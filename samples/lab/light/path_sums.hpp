// SPDX-License-Identifier: MIT
// What paths have brought to every pixel, in double precision, and the estimates and errors that follow from
// it.
#pragma once

#include "lab/light/path_tracer.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace rebound::lab {

class PathSums {
public:
    enum Quantity { direct, firstBounce, indirect, glossy };

    // One pixel's. Pixels may be added to in parallel.
    class Pixel {
    public:
        void show() const { *values = 1.0; }
        void add(Quantity, int replicate, glm::vec3) const;
        // Of direct and glossy: what every path brings, exactly; counted once.
        void setExact(Quantity, glm::vec3) const;
        void addToReplicate(int replicate, float luminance) const {
            values[1 + replicate] += double(luminance);
        }

    private:
        friend class PathSums;
        explicit Pixel(double* first) : values(first) {}
        double* values;
    };

    PathSums(Extent2D, bool hasGlossy);

    Pixel at(int x, int y) { return Pixel(values.data() + index(x, y)); }

    // Means of so many samples of each replicate; at least one.
    PathTracedLight light(int samples) const;
    double relativeError(int samples) const;

    // The sums as bytes, with what they are of, and back. restore() returns the number of samples; it fails,
    // and changes nothing, where the bytes are damaged, or of another key or size.
    std::vector<std::byte> save(const std::string& key, int samples) const;
    Result<int> restore(const std::string& key, std::span<const std::byte>);

private:
    size_t index(int x, int y) const { return (size_t(y) * size_t(extent.width) + size_t(x)) * stride; }
    glm::vec3 mean(size_t pixel, Quantity, int samples) const;
    // Of the half of the replicates that begins with this one, without exact parts.
    glm::vec3 halfMean(size_t pixel, Quantity, size_t half, int samples) const;
    double standardError(size_t pixel, int samples) const;

    Extent2D extent;
    bool hasGlossy;
    size_t stride;
    // A pixel: whether it is visible, replicates' luminance, then for each quantity its sums over the first and over the
    // second half of the replicates, and its exact part.
    std::vector<double> values;
};

} // namespace rebound::lab
