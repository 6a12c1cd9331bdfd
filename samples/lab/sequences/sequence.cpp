// SPDX-License-Identifier: MIT
#include "lab/sequences/sequence.hpp"

#include "lab/rays/camera_rays.hpp"

#include <utility>

namespace rebound::lab {

namespace {

PreviousFrame asPrevious(const Scene& scene, const CameraView& camera) {
    PreviousFrame previous{camera, {}};
    for (const Mesh& mesh : scene.meshes) previous.positions.push_back(mesh.positions);
    return previous;
}

} // namespace

SceneMoment Sequence::momentAt(double time) const {
    SceneMoment moment = options.moment;
    if (moment.animation || moment.time) moment.time = float(double(moment.time.value_or(0.0f)) + time);
    for (const ObjectPath& object : options.path.objects)
        moment.moved[object.name] = placeAt(options.path, object, time);
    return moment;
}

Result<> Sequence::moveTo(double time) {
    const SceneMoment moment = momentAt(time);
    // A camera alone leaves the scene as it is.
    const bool isStill = moment.moved.empty() && !moment.animation && !moment.time;
    if (scene.meshes.empty() || !isStill) {
        auto moved = source.at(moment);
        if (!moved) return moved.error();
        scene = *std::move(moved);
    }
    auto found = findCamera(scene, options.camera);
    if (!found) return found.error();
    camera = cameraAt(options.path, *found, time);
    return validate(camera);
}

Sequence::Sequence(MovingScene moving, const SequenceOptions& sequenceOptions)
    : source(std::move(moving)), options(sequenceOptions) {}

Result<Sequence> Sequence::open(const SequenceOptions& options) {
    auto source = MovingScene::open(options.scene, options.viewFile);
    if (!source) return source.error();
    Sequence sequence(*std::move(source), options);
    if (auto moved = sequence.moveTo(0.0); !moved) return moved.error();
    return sequence;
}

Result<Frame> Sequence::next(const FrameOptions& frameOptions) {
    if (number > 0) {
        previous = asPrevious(scene, camera);
        if (auto moved = moveTo(double(number) / options.framesPerSecond); !moved) return moved.error();
    }
    FrameOptions withMotion = frameOptions;
    withMotion.previous = previous ? &*previous : nullptr;
    auto frame = renderFrame(scene, camera, withMotion);
    if (frame) ++number;
    return frame;
}

} // namespace rebound::lab
