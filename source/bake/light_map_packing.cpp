// SPDX-License-Identifier: MIT
#include "light_map_packing.hpp"

#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#include <stb_rect_pack.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rebound::detail {

namespace {

constexpr double firstFill = 0.9; // of a map that is tried first
constexpr double growth = 1.1;    // of a side that was too short

// Rectangles of one size change places as they like: in the order of their numbers again, whatever sorting did.
void orderEqualOnes(const std::vector<glm::ivec2>& sizes, std::vector<glm::ivec2>& corners) {
    std::vector<size_t> order(sizes.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        return sizes[a].y != sizes[b].y ? sizes[a].y < sizes[b].y : sizes[a].x < sizes[b].x;
    });
    std::vector<glm::ivec2> places;
    for (size_t first = 0; first < order.size();) {
        size_t last = first;
        places.clear();
        for (; last < order.size() && sizes[order[last]] == sizes[order[first]]; ++last)
            places.push_back(corners[order[last]]);
        std::sort(places.begin(), places.end(),
                  [](glm::ivec2 a, glm::ivec2 b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
        for (size_t i = first; i < last; ++i) corners[order[i]] = places[i - first];
        first = last;
    }
}

bool pack(std::vector<stbrp_rect>& rectangles, int side) {
    stbrp_context context;
    std::vector<stbrp_node> nodes(static_cast<size_t>(side));
    stbrp_init_target(&context, side, side, nodes.data(), side);
    return stbrp_pack_rects(&context, rectangles.data(), int(rectangles.size())) != 0;
}

} // namespace

std::optional<PackedRectangles> packRectangles(const std::vector<glm::ivec2>& sizes, int most) {
    double area = 0.0;
    int longest = 1;
    std::vector<stbrp_rect> rectangles(sizes.size());
    for (size_t i = 0; i < sizes.size(); ++i) {
        area += double(sizes[i].x) * double(sizes[i].y);
        longest = std::max({longest, sizes[i].x, sizes[i].y});
        rectangles[i] = {int(i), sizes[i].x, sizes[i].y, 0, 0, 0};
    }
    if (longest > most || area > double(most) * double(most)) return std::nullopt;
    for (int side = std::max(longest, int(std::ceil(std::sqrt(area / firstFill))));;
         side = int(std::ceil(double(side) * growth))) {
        side = std::min(side, most);
        if (pack(rectangles, side)) break;
        if (side == most) return std::nullopt;
    }
    PackedRectangles packed;
    packed.corners.resize(sizes.size());
    for (const stbrp_rect& r : rectangles) {
        packed.corners[size_t(r.id)] = {r.x, r.y};
        packed.size = glm::max(packed.size, glm::ivec2(r.x + r.w, r.y + r.h));
    }
    orderEqualOnes(sizes, packed.corners);
    return packed;
}

} // namespace rebound::detail
