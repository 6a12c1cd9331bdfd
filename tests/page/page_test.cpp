// SPDX-License-Identifier: MIT
#include "../charts/made_results.hpp"
#include "browser.hpp"
#include "lab/charts/report.hpp"
#include "lab/images/image_files.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace rebound::page {
namespace {

namespace fs = std::filesystem;
using charts::Results;

void writePicture(const fs::path& path, int width, unsigned char shade) {
    const lab::Picture picture{width, 9, std::vector<unsigned char>(size_t(width) * 27, shade)};
    REQUIRE(lab::writePng(path, picture));
}

// Pictures that are told apart by their width.
std::string madePage(const Results& results) {
    const lab::TemporaryFolder pictures;
    writePicture(pictures / "a-picture-small.png", 16, 200);
    writePicture(pictures / "a-picture-error-small.png", 17, 90);
    writePicture(pictures / "a-view-small.png", 18, 150);
    const auto page = charts::resultsPage(results, pictures.path());
    REQUIRE_MESSAGE(page, page.error().message);
    return *page;
}

std::string insertedBefore(std::string text, const std::string& mark, const std::string& inserted) {
    const size_t place = text.rfind(mark);
    REQUIRE(place != std::string::npos);
    return text.insert(place, inserted);
}

std::string decoded(const std::string& text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const size_t digit = digits.find(c);
        if (digit == std::string::npos) break;
        bits = bits << 6 | uint32_t(digit);
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes += char(bits >> count & 255u);
        }
    }
    return bytes;
}

// What drive.js saw.
nlohmann::json driven(const Results& results) {
    const lab::TemporaryFolder folder;
    const std::string driver = lab::readText(fs::path(REBOUND_PAGE_TESTS) / "drive.js");
    REQUIRE(!driver.empty());
    std::string page = madePage(results);
    // A browser that only dumps its document may draw no frame, and Chart.js waits for frames.
    page.insert(page.find("<style>"),
                "<script>window.requestAnimationFrame = callback => setTimeout(callback, 16);"
                "window.failures = []; window.alerts = 0; window.alert = () => { ++window.alerts; };"
                "addEventListener('error', e => failures.push(e.message));</script>");
    lab::writeText(folder / "page.html", insertedBefore(page, "</body>", "<script>" + driver + "</script>"));
    const Visit seen = visit(folder / "page.html", "--window-size=1440,1000 --dump-dom");
    CHECK_MESSAGE(seen.console.empty(), seen.console);
    const std::string mark = "<pre id=\"report\">";
    const size_t place = seen.document.find(mark);
    REQUIRE_MESSAGE(place != std::string::npos, seen.console);
    const auto report = nlohmann::json::parse(decoded(seen.document.substr(place + mark.size())));
    CHECK_MESSAGE(report.at("failures").empty(), report.at("failures").dump());
    return report;
}

using Counts = std::vector<int>; // in the text below the chart, in the chart, in the table

TEST_CASE("the page loads, filters, selects and sorts") {
    const nlohmann::json seen = driven(charts::madeResults());
    // Two views of three settings on cpu and two on vulkan; one of cpu's is on no front.
    CHECK(seen.at("all") == Counts{10, 10, 10});
    CHECK(seen.at("withoutAtrium") == Counts{5, 5, 5});
    CHECK(seen.at("withoutCpu") == Counts{4, 4, 4});
    CHECK(seen.at("withoutTechnique") == Counts{0, 0, 0});
    CHECK(seen.at("frontOnly") == Counts{8, 8, 8});
    CHECK(seen.at("onlyAtrium") == Counts{5, 5, 5});
    CHECK(seen.at("allAgain") == Counts{10, 10, 10});

    CHECK(seen.at("panelAtFirst").at("widths").empty());
    CHECK(seen.at("clicked").at("title") == "slow");
    CHECK(seen.at("clicked").at("widths") == std::vector<int>{16, 18, 17}); // result, truth, error
    for (const char* text : {"atrium nave", "9 ms", "20 frames", "0.1", "preset"})
        CHECK(seen.at("clicked").at("text").get<std::string>().find(text) != std::string::npos);
    CHECK(seen.at("selectedRows") == std::vector<int>{2});
    CHECK(seen.at("afterArrow").at("text").get<std::string>().find("cornell front") != std::string::npos);
    CHECK(seen.at("fromTable").at("title") == "fast");

    CHECK(seen.at("axis") == "FLIP");
    auto heights = seen.at("heights").get<std::vector<double>>();
    std::sort(heights.begin(), heights.end());
    CHECK(heights.front() == doctest::Approx(0.025)); // a quarter of the smallest relative RMSE
    const auto ascending = seen.at("ascending").get<std::vector<double>>();
    CHECK(std::is_sorted(ascending.begin(), ascending.end()));
    const auto descending = seen.at("descending").get<std::vector<double>>();
    CHECK(std::is_sorted(descending.rbegin(), descending.rend()));
}

TEST_CASE("names are shown as text, whatever they hold") {
    Results results = charts::madeResults();
    const std::string hostile = "</script><img src=x onerror=alert(1)>";
    for (charts::Point& point : results.points) point.name = hostile;
    const nlohmann::json seen = driven(results);
    CHECK(seen.at("all") == Counts{10, 10, 10});
    CHECK(seen.at("clicked").at("title") == hostile);
    CHECK(seen.at("alerts") == 0);
}

TEST_CASE("a failure in the page is seen by this test") {
    const lab::TemporaryFolder folder;
    lab::writeText(folder / "page.html", insertedBefore(madePage(charts::madeResults()), "</body>",
                                                        "<script>missingFunction();</script>"));
    const Visit seen = visit(folder / "page.html", "--dump-dom");
    CHECK(seen.console.find("missingFunction") != std::string::npos);
}

TEST_CASE("screenshots in light and dark, on a desktop and a phone") {
    const fs::path folder = REBOUND_SCREENSHOTS;
    fs::create_directories(folder);
    const lab::TemporaryFolder pages;
    const std::string select = "<script>select(points[2]);</script>";
    lab::writeText(pages / "page.html", insertedBefore(madePage(charts::madeResults()), "</body>", select));
    // A browser's window has a least width; a frame within it has none.
    lab::writeText(pages / "phone.html",
                   "<!DOCTYPE html><body style='margin:0'><iframe src='page.html' style='border:0;"
                   "width:390px;height:1800px'></iframe>");
    const std::pair<const char*, const char*> schemes[] = {
        {"light", ""}, {"dark", " --blink-settings=preferredColorScheme=0"}};
    for (const auto& [scheme, option] : schemes) {
        const auto shoot = [&, o = option](const char* page, const std::string& name, const char* size) {
            const fs::path file = folder / (name + ".png");
            fs::remove(file);
            visit(pages / page,
                  "--window-size=" + std::string(size) + " --screenshot='" + file.string() + "'" + o);
            CHECK(lab::readText(file).starts_with("\x89PNG"));
        };
        shoot("page.html", std::string("desktop-") + scheme, "1440,1100");
        shoot("phone.html", std::string("phone-") + scheme, "500,1800");
    }
}

} // namespace
} // namespace rebound::page
