// SPDX-License-Identifier: MIT
// Definitions of surfel_light.hpp.

#include <cmath>

namespace rebound {
namespace detail {

inline constexpr int maximumLightSources = 4096, maximumPlacesPerSurfel = 16;

inline Result<> validateSurfels(uint32_t surfels, const char* what) {
    if (surfels >= 1 && surfels <= maximumBakeSurfels) return {};
    return invalidArgument(std::string(what) + " is " + std::to_string(surfels) + "; 1 to " +
                           std::to_string(maximumBakeSurfels) + " was expected");
}

inline Result<> validate(const SurfelLightSettings& s) {
    if (auto valid = validateSurfels(s.surfels, "settings.surfels"); !valid) return valid;
    struct Range {
        const char* name;
        int value, last;
    };
    for (const Range& r : {Range{"maximumSources", s.maximumSources, maximumLightSources},
                           {"placesPerSurfel", s.placesPerSurfel, maximumPlacesPerSurfel},
                           {"maximumShadowViews", s.maximumShadowViews, maximumLightSources}})
        if (r.value < 1 || r.value > r.last)
            return invalidArgument(std::string("settings.") + r.name + " is " + std::to_string(r.value) +
                                   "; 1 to " + std::to_string(r.last) + " was expected");
    if (s.shadowMaps.size() > size_t(maximumShadowMaps))
        return invalidArgument("settings.shadowMaps has " + std::to_string(s.shadowMaps.size()) +
                               " sizes; 0 to " + std::to_string(maximumShadowMaps) + " were expected");
    for (size_t i = 0; i < s.shadowMaps.size(); ++i)
        if (!isValidExtent(s.shadowMaps[i]))
            return invalidArgument("settings.shadowMaps[" + std::to_string(i) + "] is " +
                                   toText(s.shadowMaps[i]) + "; 1x1 to " +
                                   toText({maximumExtent, maximumExtent}) + " was expected");
    return {};
}

// Places of equal areas in a golden spiral, around the middle.               [Vogel: A better way to construct the
// sunflower head, 1979]
inline std::vector<SurfelPlace> placesOnSurfel(int count) {
    std::vector<SurfelPlace> places;
    glm::dvec2 mean(0.0);
    for (int i = 0; i < count; ++i) {
        const double radius = std::sqrt((double(i) + 0.5) / double(count)),
                     angle = 2.399963229728653 * double(i);
        const glm::dvec2 place = radius * glm::dvec2(std::cos(angle), std::sin(angle));
        places.push_back({glm::vec4(glm::vec2(place), 0.0f, 0.0f)});
        mean += place / double(count);
    }
    for (SurfelPlace& p : places) p.place -= glm::vec4(glm::vec2(mean), 0.0f, 0.0f);
    return places;
}

inline Resource surfelsResource(uint32_t surfels) {
    const size_t size = 4 * 7 * size_t(BakeLayout::stride(surfels));
    return {name(BakeSection::surfels), ResourceKind::inputBuffer, Format::r32ui, 1, {}, {}, size};
}
inline Resource surfelLightResource(uint32_t surfels, bool isHandedOut) {
    const size_t size = 4 * 3 * size_t(BakeLayout::stride(surfels));
    const ResourceKind kind = isHandedOut ? ResourceKind::outputBuffer : ResourceKind::transientBuffer;
    return {"surfel light", kind, Format::r32f, 1, {}, {}, size};
}

inline void addShadowMaps(Plan& plan, Pass& pass, const SurfelLightSettings& s) {
    pass.kernel = "surfel_light/light_shadowed";
    pass.features = {int(s.shadowMaps.size()) - 1};
    const size_t size = size_t(s.maximumShadowViews) * sizeof(ShadowView);
    pass.bindings.push_back(
        {6, plan.add({"shadow views", ResourceKind::inputBuffer, Format::r32f, 1, {}, {}, size})});
    ResourceIndex map = -1;
    for (int i = 0; i < maximumShadowMaps; ++i) {
        // Slots of maps that there are not take another one: nobody reads it there.
        if (size_t(i) < s.shadowMaps.size())
            map = plan.add({"shadow map " + std::to_string(i),
                            ResourceKind::input,
                            Format::r32f,
                            1,
                            s.shadowMaps[size_t(i)],
                            {},
                            0});
        pass.bindings.push_back({7 + i, map});
    }
}

inline Resource surfelImageConstants(uint32_t surfels) {
    const Extent2D e = surfelImageExtent(surfels);
    const SurfelImageConstants k{{e.width, e.height, 0, 0},
                                 {int(surfels), int(BakeLayout::stride(surfels)), 0, 0}};
    return bufferResource("surfel image constants", std::vector<SurfelImageConstants>{k});
}

} // namespace detail

inline ShadowView shadowView(const glm::mat4& worldToClip, const ShadowMapConventions& conventions,
                             const ShadowMapTile& tile) {
    const glm::mat4 rows = glm::transpose(worldToClip);
    const glm::vec2 first(tile.first), size(tile.extent.width, tile.extent.height);
    const float up = conventions.firstRow == FirstRow::bottom ? 0.5f : -0.5f;
    ShadowView view;
    view.x = size.x * (0.5f * rows[0] + 0.5f * rows[3]) + first.x * rows[3];
    view.y = size.y * (up * rows[1] + 0.5f * rows[3]) + first.y * rows[3];
    view.z = conventions.depthRange == DepthRange::zeroToOne ? rows[2] : 0.5f * (rows[2] + rows[3]);
    view.w = rows[3];
    view.tile = glm::vec4(first, first + size);
    view.image = {tile.map, conventions.depthDirection == DepthDirection::forward ? 1 : -1, 0, 0};
    // A texel's wider side, at unit distance in a perspective.
    const float texel =
        2.0f / std::min(glm::length(glm::vec3(rows[0])) * size.x, glm::length(glm::vec3(rows[1])) * size.y);
    const bool isPerspective = glm::vec3(rows[3]) != glm::vec3(0.0f);
    const float distance = texel * tile.clearance;
    view.distance = isPerspective ? glm::vec4(distance, 0, 0, 0) : glm::vec4(0, distance, 0, 0);
    return view;
}

inline Result<Plan> planSurfelLight(const SurfelLightSettings& s) {
    if (auto valid = detail::validate(s); !valid) return valid.error();
    Plan plan{"surfel_light", {}, {}};
    const detail::SurfelLightConstants k{
        {int(s.surfels), int(BakeLayout::stride(s.surfels)), s.placesPerSurfel, 0},
        {s.maximumSources, s.maximumShadowViews, 0, 0}};
    Pass pass{"light surfels directly", "surfel_light/light", {}, {}, {}, int(s.surfels)};
    const size_t sources = size_t(s.maximumSources) * sizeof(LightSource);
    pass.bindings = {
        {0, plan.add(detail::surfelsResource(s.surfels))},
        {1, plan.add({"light sources", ResourceKind::inputBuffer, Format::r32f, 1, {}, {}, sources})},
        {2, plan.add(bufferResource("places on surfels", detail::placesOnSurfel(s.placesPerSurfel)))},
        {3, plan.add(bufferResource("surfel light constants", std::vector<detail::SurfelLightConstants>{k}))},
        {4, plan.add({"surfel light frame",
                      ResourceKind::frameConstants,
                      {},
                      1,
                      {},
                      {},
                      sizeof(detail::SurfelLightFrameConstants)})},
        {5, plan.add(detail::surfelLightResource(s.surfels, s.handOut)), Access::write}};
    if (!s.shadowMaps.empty()) detail::addShadowMaps(plan, pass, s);
    plan.passes.push_back(std::move(pass));
    return plan;
}

template <class Image>
Result<FrameInputs<Image>> surfelLightInputs(const SurfelLightSettings& s,
                                             const SurfelLightFrame<Image>& frame) {
    if (frame.sources < 0 || frame.sources > s.maximumSources)
        return invalidArgument("frame.sources is " + std::to_string(frame.sources) + "; 0 to " +
                               std::to_string(s.maximumSources) + ", settings.maximumSources, was expected");
    FrameInputs<Image> inputs;
    for (size_t i = 0; i < s.shadowMaps.size(); ++i)
        inputs.images.push_back({"shadow map " + std::to_string(i), frame.shadowMaps[i]});
    inputs.buffers = {{name(BakeSection::surfels), frame.surfels}, {"light sources", frame.lightSources}};
    if (!s.shadowMaps.empty()) inputs.buffers.push_back({"shadow views", frame.shadowViews});
    if (s.handOut) inputs.buffers.push_back({"surfel light", frame.surfelLight});
    const detail::SurfelLightFrameConstants k{{frame.sources, 0, 0, 0}};
    const std::byte* bytes = reinterpret_cast<const std::byte*>(&k);
    inputs.constants = {{"surfel light frame", {bytes, bytes + sizeof k}}};
    return inputs;
}

inline Result<Plan> planSurfelImages(uint32_t surfels) {
    if (auto valid = detail::validateSurfels(surfels, "surfels"); !valid) return valid.error();
    Plan plan{"surfel_images", {}, {}};
    const Extent2D e = surfelImageExtent(surfels);
    const auto image = [&](const char* name, Format format, int channels) {
        return plan.add({name, ResourceKind::output, format, channels, e, {}, 0});
    };
    Pass pass{"unpack surfels", "surfel_light/images", {}, {}, e};
    pass.bindings = {{0, plan.add(detail::surfelsResource(surfels))},
                     {1, image("surfel positions", Format::rgba32f, 4), Access::write},
                     {2, image("surfel normals", Format::rgba16f, 3), Access::write},
                     {3, image("surfel albedo", Format::rgba16f, 3), Access::write},
                     {4, plan.add(detail::surfelImageConstants(surfels))}};
    plan.passes.push_back(std::move(pass));
    return plan;
}

inline Result<Plan> planSurfelLightFromImage(uint32_t surfels, SurfelImageLight light) {
    if (auto valid = detail::validateSurfels(surfels, "surfels"); !valid) return valid.error();
    Plan plan{"surfel_light_from_image", {}, {}};
    const Extent2D e = surfelImageExtent(surfels);
    Pass pass{
        "take surfel light from an image",
        "surfel_light/from_image",
        {light == SurfelImageLight::irradianceOverPi ? detail::imageOfIrradiance : detail::imageOfReflection},
        {},
        e};
    pass.bindings = {{0, plan.add(detail::surfelsResource(surfels))},
                     {1, plan.add({"lit surfels", ResourceKind::input, Format::rgba16f, 3, e, {}, 0})},
                     {2, plan.add(detail::surfelLightResource(surfels, true)), Access::write},
                     {3, plan.add(detail::surfelImageConstants(surfels))}};
    plan.passes.push_back(std::move(pass));
    return plan;
}

} // namespace rebound
