// SPDX-License-Identifier: MIT
#include "explain_scenes.hpp"

#include "lab/scenes/scene_files.hpp"

using namespace rebound;
using namespace rebound::explain;

TEST_CASE("the causes add up to the whole error") {
    const lab::Scene scene = lab::makeCornellBox();
    const Explanation explanation = explained(scene, scene.cameras[0], optionsOf());
    double bias = 0.0, part = 0.0;
    lab::Image sum(explanation.whole.difference.extent(), 3);
    for (const Cause& cause : explanation.causes) {
        bias += cause.bias;
        part += cause.part;
        for (size_t i = 0; i < sum.data.size(); ++i) sum.data[i] += cause.difference.data[i];
    }
    // Differences of floats, summed in doubles.
    CHECK(bias == doctest::Approx(explanation.whole.bias).epsilon(1e-5));
    CHECK(part == doctest::Approx(explanation.whole.rms).epsilon(1e-5));
    CHECK(explanation.whole.part == doctest::Approx(explanation.whole.rms).epsilon(1e-9));
    for (size_t i = 0; i < sum.data.size(); ++i)
        CHECK(sum.data[i] == doctest::Approx(double(explanation.whole.difference.data[i])).epsilon(1e-3));
    for (size_t i = 0; i < sum.data.size(); ++i)
        CHECK(explanation.whole.difference.data[i] ==
              doctest::Approx(double(explanation.result.data[i] - explanation.truth.data[i])).epsilon(1e-6));
}

TEST_CASE("where the camera sees all of a convex corner, nothing is hidden, off the screen or in between") {
    const Explanation explanation = explained(cornerScene(), cornerCamera(), optionsOf());
    CHECK(causeNamed(explanation, "missing visibility").rms == 0.0);
    CHECK(causeNamed(explanation, "hidden senders").rms == 0.0);
    CHECK(causeNamed(explanation, "senders off the screen").rms == 0.0);
    CHECK(causeNamed(explanation, "missing bounces").bias < -0.01);
    CHECK(explanation.screenLimit->rms == 0.0);
    // The sum over all pixels against the integral: 64 paths' noise, and discs for squares where floor and
    // wall meet. The mean is that of 2000 pixels.
    CHECK(std::abs(causeNamed(explanation, "disc form factor").bias) < 0.02);
    CHECK(explanation.truthMean > 0.01);
}

TEST_CASE("what a panel hides from the camera is a hidden sender, and what it keeps from a receiver is "
          "visibility") {
    lab::Scene scene = cornerScene();
    // Upright, between the camera and the foot of the wall, and edge-on to the sun.
    lab::addQuad(scene, {1.2f, 0.5f, 0}, {0, 0.45f, 0}, {0, 0, 0.9f});
    const Explanation explanation = explained(scene, cornerCamera(), optionsOf());
    CHECK(causeNamed(explanation, "hidden senders").bias < -0.02);
    CHECK(causeNamed(explanation, "missing visibility").bias > 0.005);
    CHECK(causeNamed(explanation, "senders off the screen").rms == 0.0);
}

TEST_CASE(
    "a camera that sees only the wall misses what lies off the screen, and nothing else of one bounce") {
    const lab::CameraView camera = lab::patchCamera({0, 1, 0}, {-1, 0, 0}, 1.0f, 1.0f);
    ExplainOptions options = optionsOf({32, 32});
    options.bounces = 1;
    const Explanation explanation = explained(cornerScene(), camera, options);
    CHECK(causeNamed(explanation, "senders off the screen").bias == doctest::Approx(-1.0));
    CHECK(explanation.whole.bias == doctest::Approx(-1.0));
    CHECK(causeNamed(explanation, "hidden senders").rms == 0.0);
    CHECK(causeNamed(explanation, "missing bounces").rms == 0.0);
    CHECK(explanation.screenLimit->bias == doctest::Approx(-1.0));
}

TEST_CASE("more samples leave less of the error that samples cause, and a finer start less of its own") {
    ExplainOptions options = optionsOf({96, 72}, 8, 1);
    options.draft["radius"] = "12"; // of a few hundred texels
    options.draft["samples"] = "8";
    const Explanation few = explained(cornerScene(), cornerCamera(), options);
    options.draft["samples"] = "128";
    options.draft["start"] = "full";
    options.draft["smooth"] = "off";
    const Explanation many = explained(cornerScene(), cornerCamera(), options);
    CHECK(causeNamed(many, "too few samples").rms < 0.5 * causeNamed(few, "too few samples").rms);
    CHECK(causeNamed(many, "start resolution").rms < 1e-5); // the same sum twice
    CHECK(causeNamed(few, "start resolution").rms > 0.005);
}

TEST_CASE("options out of range are named") {
    const auto failure = [](ExplainOptions options) {
        const auto explanation = explainError(cornerScene(), cornerCamera(), options);
        REQUIRE(!explanation);
        return explanation.error().message;
    };
    ExplainOptions options = optionsOf({16, 16});
    options.bounces = 0;
    CHECK(failure(options) == "path tracer option bounces is 0; expected 1 to 64");
    options = optionsOf({16, 16});
    options.samples = 0;
    CHECK(failure(options) == "path tracer option samples is 0; expected 1 to 1048576");
    options = optionsOf({16, 16});
    options.draft["levels"] = "9";
    CHECK(failure(options) == "--levels is 9; 1 to 8 was expected");
}
