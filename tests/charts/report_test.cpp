// SPDX-License-Identifier: MIT
#include "../lab/temporary_folder.hpp"
#include "lab/charts/gnuplot.hpp"
#include "lab/charts/pictures.hpp"
#include "lab/charts/report.hpp"
#include "made_results.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>

namespace rebound::charts {
namespace {

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_CASE("fields of CSV stand in quotes where they must, with quotes doubled") {
    CHECK(csvField("plain text") == "plain text");
    CHECK(csvField("") == "");
    CHECK(csvField("a,b") == "\"a,b\"");
    CHECK(csvField("say \"yes\"") == "\"say \"\"yes\"\"\"");
    CHECK(csvField("two\nlines") == "\"two\nlines\"");
}

// Fields of a text after RFC 4180.
std::vector<std::vector<std::string>> parseCsv(const std::string& text) {
    std::vector<std::vector<std::string>> rows(1, {""});
    bool isQuoted = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const bool isDouble = text.compare(i, 2, "\"\"") == 0 && isQuoted;
        if (text[i] == '"' && !isDouble) isQuoted = !isQuoted;
        else if (!isQuoted && text[i] == ',') rows.back().push_back("");
        else if (!isQuoted && text.compare(i, 2, "\r\n") == 0) rows.push_back({""}), ++i;
        else rows.back().back() += text[i], i += isDouble;
    }
    rows.pop_back();
    return rows;
}

TEST_CASE("the CSV has a line for each point and a field for each heading") {
    Results results = madeResults();
    results.points[0].name = "fast, \"really\"";
    const auto rows = parseCsv(resultsCsv(results));
    REQUIRE(rows.size() == 11);
    for (const auto& row : rows) CHECK(row.size() == rows[0].size());
    const auto field = [&](size_t row, const char* heading) {
        const auto column = std::find(rows[0].begin(), rows[0].end(), heading);
        REQUIRE(column != rows[0].end());
        return rows[row][size_t(column - rows[0].begin())];
    };
    CHECK(field(1, "name") == "fast, \"really\"");
    CHECK(field(1, "scene") == "builtin:atrium");
    CHECK(field(1, "camera") == "nave");
    CHECK(field(1, "width") == "64");
    CHECK(std::stod(field(1, "median_ms")) == 2.0);
    CHECK(std::stod(field(1, "p90_ms")) == doctest::Approx(2.6));
    CHECK(std::stod(field(1, "relative_rmse")) == doctest::Approx(0.4));
    CHECK(field(1, "frames") == "20");
    CHECK(nlohmann::json::parse(field(1, "settings")).at("levels") == 4);
}

TEST_CASE("a point is the same after it was written and read") {
    const Point point = madePoint("a view", "a \"name\" </script>", 2.5, 0.3);
    const nlohmann::json written = toJson(point);
    CHECK(nlohmann::json(toJson(pointFromJson(nlohmann::json::parse(written.dump())))) == written);
}

TEST_CASE("base64 is that of RFC 4648, section 10") {
    const std::pair<const char*, const char*> all[] = {{"", ""},
                                                       {"f", "Zg=="},
                                                       {"fo", "Zm8="},
                                                       {"foo", "Zm9v"},
                                                       {"foob", "Zm9vYg=="},
                                                       {"fooba", "Zm9vYmE="},
                                                       {"foobar", "Zm9vYmFy"}};
    for (const auto& [bytes, text] : all) CHECK(base64(bytes) == text);
    CHECK(base64(std::string("\xff\xfe\x00", 3)) == "//4A");
}

TEST_CASE("no text within the page's data can end its element, and all of it is read back") {
    const Json json = {
        {"name", "</script><script>alert(1)</script><!-- \"quoted\" \\ \xc3\xa9 \xe2\x80\xa8"}};
    const std::string text = jsonForScript(json);
    CHECK(!holds(text, "<"));
    CHECK(nlohmann::json::parse(text) == nlohmann::json(json));
}

TEST_CASE("the page needs nothing from elsewhere, and holds each distinct picture once") {
    const lab::TemporaryFolder folder;
    lab::writeText(folder / "a-view-small.png", "view");
    lab::writeText(folder / "a-picture-small.png", "result");
    lab::writeText(folder / "a-picture-error-small.png", "error");
    Results results = madeResults();
    results.points[3].name = "@STYLE@ </script>";
    const auto page = resultsPage(results, folder.path());
    REQUIRE_MESSAGE(page, page.error().message);
    for (const char* mark :
         {"@RESULTS@", "@LIBRARY@", "@MODEL@", "@CHART@", "@SCRIPT@", "src=\"http", "href=\"http"})
        CHECK(!holds(*page, mark));
    for (const char* bytes : {"view", "result", "error"}) {
        const std::string text = "\"" + base64(bytes) + "\"";
        CHECK(holds(*page, text));
        CHECK(page->find(text) == page->rfind(text));
    }
    CHECK(holds(*page, "@STYLE@ \\u003c/script>")); // as it is in the results
    const auto missing = resultsPage(results, folder / "nowhere");
    REQUIRE(!missing);
    CHECK(holds(missing.error().message, "a-view-small.png"));
}

TEST_CASE("the summary has the fronts, and what is never worth its time") {
    const std::string text = summaryText(madeResults());
    for (const char* part :
         {"### atrium nave, cpu (avx2 on 2 threads)", "### cornell front", "geometric means",
          "one other surface", "256 paths a pixel", "Never worth their time"})
        CHECK(holds(text, part));
    const std::string never = text.substr(text.find("Never worth"));
    CHECK(holds(never, "middling"));
    CHECK(holds(never, "2 of 2"));
    CHECK(!holds(text, "not finite"));
    Results results = madeResults();
    results.bounces = 8;
    CHECK(holds(summaryText(results), "1 to 8 other surfaces"));
}

TEST_CASE("names in a chart's script cannot leave their quotes") {
    Results results = madeResults();
    results.points[0].name = "it's \" `rm` \\ \n $x";
    results.points[0].backend = "o'neil";
    const std::string script = plotScript(chartsOf(results), {"it's", "x", "y"}, "/tmp/it's");
    CHECK(holds(script, "'it''s'"));
    CHECK(holds(script, "/tmp/it''s/chart-atrium-nave.svg"));
    CHECK(holds(script, "on o''neil"));
    CHECK(holds(script, "\"it's   `rm`     $x\""));
}

TEST_CASE("gnuplot draws each chart as SVG and PNG, or says why not") {
    const auto gnuplot = findGnuplot();
    REQUIRE_MESSAGE(gnuplot, gnuplot.error().message);
    const lab::TemporaryFolder folder;
    lab::writeText(folder / "script",
                   plotScript(chartsOf(madeResults()), {"subtitle", "x", "y"}, folder.path()));
    const auto drawn = runGnuplot(*gnuplot, folder / "script");
    REQUIRE_MESSAGE(drawn, drawn.error().message);
    for (const char* name : {"chart", "chart-atrium-nave", "chart-cornell-front"}) {
        CHECK(holds(lab::readText(folder / (std::string(name) + ".svg")), "</svg>"));
        CHECK(lab::readText(folder / (std::string(name) + ".png")).starts_with("\x89PNG"));
    }
    lab::writeText(folder / "broken", "set output 'x'\nfrobnicate\n");
    const auto broken = runGnuplot(*gnuplot, folder / "broken");
    REQUIRE(!broken);
    CHECK(holds(broken.error().message, "invalid command"));
    CHECK(!holds(broken.error().message, "\n"));
    CHECK(!runGnuplot(folder / "missing", folder / "script"));
}

TEST_CASE("without gnuplot in PATH there is one sentence") {
    const std::string path = std::getenv("PATH");
    const lab::TemporaryFolder folder;
    setenv("PATH", folder.path().c_str(), 1);
    const auto gnuplot = findGnuplot();
    setenv("PATH", path.c_str(), 1);
    REQUIRE(!gnuplot);
    CHECK(holds(gnuplot.error().message, "gnuplot-nox"));
}

TEST_CASE("scales end at 1, 2 or 5 times a power of ten") {
    const std::pair<double, double> all[] = {{1.0, 1.0},   {1.01, 2.0},  {2.0, 2.0}, {3.0, 5.0},
                                             {5.1, 10.0},  {0.03, 0.05}, {0.2, 0.2}, {700, 1000},
                                             {1e-6, 1e-6}, {0.0, 1.0}};
    for (const auto& [value, rounded] : all) CHECK(roundUp(value) == doctest::Approx(rounded));
}

TEST_CASE("names of files hold letters, digits and dashes") {
    CHECK(fileNameOf("atrium nave half-64, cpu") == "atrium-nave-half-64-cpu");
    CHECK(fileNameOf("../../etc/passwd") == "etc-passwd");
    CHECK(fileNameOf("...") == "point");
    CHECK(fileNameOf(std::string(500, 'a')).size() == 80);
}

} // namespace
} // namespace rebound::charts
