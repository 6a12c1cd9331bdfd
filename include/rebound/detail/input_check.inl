// SPDX-License-Identifier: MIT
// Definitions of input_check.hpp that depend on a device's images.

namespace rebound {
namespace detail {

// previousCamera: with motion only.
Result<std::vector<NamedConstants>> inputCheckConstants(const InputCheckSettings&, const Camera&,
                                                        const Camera& previousCamera);

} // namespace detail

template <class Image>
Result<FrameInputs<Image>> inputCheckInputs(const InputCheckSettings& settings,
                                            const InputCheckFrame<Image>& frame) {
    auto constants = detail::inputCheckConstants(settings, frame.camera, frame.previousCamera);
    if (!constants) return constants.error();
    FrameInputs<Image> inputs;
    inputs.images = {{"depth", frame.depth}, {"normal", frame.normal}, {"statistics", frame.statistics}};
    if (settings.albedo) inputs.images.push_back({"albedo", frame.albedo});
    if (settings.radiance) inputs.images.push_back({"radiance", frame.radiance});
    if (settings.lit) inputs.images.push_back({"lit", frame.lit});
    if (settings.emission) inputs.images.push_back({"emission", frame.emission});
    if (settings.motion) inputs.images.push_back({"motion", frame.motion});
    inputs.constants = *std::move(constants);
    return inputs;
}

} // namespace rebound
