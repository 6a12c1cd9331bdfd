// SPDX-License-Identifier: MIT
#include "lab/images/image_files.hpp"

#include "temporary_folder.hpp"

#include <doctest/doctest.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace rebound;
using namespace rebound::lab;

namespace {

using Rgb = std::vector<unsigned char>;

Rgb mapped(const std::vector<float>& pixel, float exposure = 1.0f) {
    Image image({1, 1}, int(pixel.size()));
    image.data = pixel;
    return toneMap(image, {exposure}).rgb;
}

Picture filled(int width, int height, unsigned char value) {
    return {width, height, Rgb(size_t(width) * size_t(height) * 3, value)};
}

bool shows(const Picture& sheet, int left, int top, const Picture& part) {
    for (int y = 0; y < part.height; ++y)
        for (int x = 0; x < part.width * 3; ++x)
            if (sheet.rgb[size_t((top + y) * sheet.width + left) * 3 + size_t(x)] !=
                part.rgb[size_t(y * part.width) * 3 + size_t(x)])
                return false;
    return true;
}

} // namespace

TEST_CASE("the tone curve is 1 - exp(-x), then sRGB") {
    CHECK(mapped({0, 0, 0}) == Rgb{0, 0, 0});
    CHECK(mapped({1e30f, 200.0f, -5.0f}) == Rgb{255, 255, 0});
    // 1 - exp(-ln 2) = 1/2, which sRGB encodes as 0.7354 = 188 / 255.
    const float half = std::log(2.0f);
    CHECK(mapped({half, half, half}) == Rgb{188, 188, 188});
    CHECK(mapped({half / 4, 0, half / 4}, 4.0f) == Rgb{188, 0, 188});
    CHECK(mapped({half}) == Rgb{188, 188, 188});
    CHECK(mapped({half, half, half, 0.0f}) == Rgb{188, 188, 188});
}

TEST_CASE("values that are not finite show as magenta") {
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float bad : {infinity, -infinity, std::nanf("")})
        CHECK(mapped({0.5f, bad, 0.5f}) == Rgb{255, 0, 255});
    CHECK(mapped({0.5f, 0.5f, 0.5f, infinity}) == mapped({0.5f, 0.5f, 0.5f}));
}

TEST_CASE("automatic exposure maps the 90th percentile to 0.8") {
    Image image({104, 1}, 1);
    for (int i = 0; i < 100; ++i) image.data[size_t(i)] = float(i + 1);
    image.data[100] = std::nanf("");
    image.data[101] = std::numeric_limits<float>::infinity();
    image.data[102] = 0.0f;
    image.data[103] = -1000.0f;
    const Picture picture = toneMap(image, automaticToneCurve(image));
    CHECK(int(picture.rgb[89 * 3]) == 204); // 0.8 * 255
    CHECK(automaticToneCurve(Image({3, 3}, 3)).exposure == 1.0f);
    CHECK(automaticToneCurve(Image()).exposure == 1.0f);
    CHECK(std::isfinite(
        automaticToneCurve(Image({1, 1}, 3, std::numeric_limits<float>::denorm_min())).exposure));
}

TEST_CASE("PNG files hold the picture") {
    const TemporaryFolder folder;
    Picture picture{5, 3, {}};
    for (int i = 0; i < 5 * 3 * 3; ++i) picture.rgb.push_back(static_cast<unsigned char>(i * 5));
    REQUIRE(writePng(folder / "a.png", picture));
    CHECK(folder.count() == 1);

    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_file(&image, (folder / "a.png").c_str()) != 0);
    CHECK(image.width == 5);
    CHECK(image.height == 3);
    image.format = PNG_FORMAT_RGB;
    Rgb read(picture.rgb.size());
    REQUIRE(png_image_finish_read(&image, nullptr, read.data(), 0, nullptr) != 0);
    CHECK(read == picture.rgb);
}

TEST_CASE("noise, which does not compress, fits as well") {
    const TemporaryFolder folder;
    Picture picture{301, 203, {}};
    uint32_t state = 1;
    for (int i = 0; i < 301 * 203 * 3; ++i) {
        state = state * 1664525u + 1013904223u;
        picture.rgb.push_back(static_cast<unsigned char>(state >> 24));
    }
    CHECK(writePng(folder / "a.png", picture));
}

TEST_CASE("pictures that no PNG can hold are refused") {
    const TemporaryFolder folder;
    for (const Picture& bad : {Picture{}, Picture{2, 2, Rgb(11)}, Picture{-1, -1, Rgb(3)}})
        CHECK_FALSE(writePng(folder / "a.png", bad));
    CHECK(folder.count() == 0);
}

TEST_CASE("a contact sheet shows every picture under its caption") {
    const Picture red = filled(60, 20, 200);
    const Picture small = filled(40, 10, 90);
    const Picture sheet = contactSheet({{"red", red}, {"small", small}, {"third", red}}, 2);
    REQUIRE(sheet.rgb.size() == size_t(sheet.width) * size_t(sheet.height) * 3);
    int found = 0;
    for (int top = 0; top + 20 <= sheet.height; ++top)
        for (int left = 0; left + 60 <= sheet.width; ++left) found += shows(sheet, left, top, red);
    CHECK(found == 2);
    const auto other = contactSheet({{"rod", red}, {"small", small}, {"third", red}}, 2);
    CHECK(other.rgb.size() == sheet.rgb.size());
    CHECK(other.rgb != sheet.rgb);
}

TEST_CASE("contact sheets take any caption and any number of columns") {
    const Picture picture = filled(30, 20, 100);
    CHECK(contactSheet({}, 3).rgb.empty());
    const std::string endless(1000, 'w');
    const Picture plain = contactSheet({{"", picture}, {"", picture}}, 1);
    const Picture captioned = contactSheet({{endless, picture}, {"\xc3\xa9\xff\n", picture}}, -4);
    CHECK(captioned.width == plain.width);
    CHECK(captioned.height >= 2 * 20);
    CHECK(contactSheet({{"x", picture}, {"y", Picture{}}}, 99).width > 2 * 30);
    CHECK(contactSheet({{"torn", Picture{30, 20, Rgb(5)}}}, 1).width > 30);
}
