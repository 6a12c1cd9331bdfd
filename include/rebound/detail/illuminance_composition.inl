// SPDX-License-Identifier: MIT
// Definitions of illuminance_composition.hpp.

#include <vector>

namespace rebound {
namespace detail {

#define RB_FUNCTION inline
#include "rebound/math/cache_layout.h"
#undef RB_FUNCTION

inline ViewToWorldConstants viewToWorld(const Camera& camera, const GBufferConventions& conventions) {
    glm::dmat4 toEngine(1.0);
    toEngine[2][2] = conventions.handedness == Handedness::right ? -1.0 : 1.0;
    const glm::dmat4 rows = glm::transpose(glm::inverse(glm::dmat4(camera.view)) * toEngine);
    return {glm::vec4(rows[0]), glm::vec4(rows[1]), glm::vec4(rows[2])};
}

inline Result<> validate(const IlluminanceCompositionSettings& s) {
    if (!isValidExtent(s.resolution))
        return invalidArgument("settings.resolution is " + toText(s.resolution) + "; 1x1 to " +
                               toText({maximumExtent, maximumExtent}) + " was expected");
    if (auto layout = rebound::validate(s.bake); !layout)
        return Error{layout.error().code, "settings.bake: " + layout.error().message};
    for (int i = 0; i < bakeSectionCount; ++i) {
        const BakeSection section{i};
        if (!isRead(s, section)) continue;
        if (const size_t bytes = 4 * sizeOf(s.bake, section); bytes > maximumBufferSize)
            return invalidArgument(std::string("settings.bake has ") + std::to_string(bytes) + " bytes of " +
                                   name(section) + "; at most " + std::to_string(maximumBufferSize) +
                                   " were expected");
    }
    if (s.lightMap && s.bake.surfaceCaches == 0)
        return invalidArgument(
            "settings.lightMap is true, but settings.bake has no light map; one that has was expected");
    const bool isGlossy = s.glossy != GlossyLobe::none;
    if (!s.writeIndirect && !s.compose && !isGlossy)
        return invalidArgument(
            "settings.writeIndirect and settings.compose are both false, and settings.glossy is "
            "none; one output was expected");
    // NaN is refused as well.
    if (isGlossy && s.glossyExponent && !(*s.glossyExponent >= 0.0f && *s.glossyExponent <= 64.0f))
        return invalidArgument("settings.glossyExponent is " + std::to_string(*s.glossyExponent) +
                               "; 0 to 64 was expected");
    return {};
}

// Builds the plan pass by pass, in the order of the paper's pipeline (fig. 2).
class IlluminanceCompositionPlanner {
public:
    explicit IlluminanceCompositionPlanner(const IlluminanceCompositionSettings& s)
        : settings(s), bake(s.bake) {}

    Plan build() {
        plan.technique = "illuminance_composition";
        addBuffers();
        addLightSurfels();
        if (settings.skipUnchanged) addSettle();
        for (uint32_t stage = 0; stage < bake.stages; ++stage) addPull(stage);
        addLightCaches();
        if (settings.writeIndirect || settings.compose) addShade();
        if (settings.glossy != GlossyLobe::none) addGlossy();
        return std::move(plan);
    }

private:
    const IlluminanceCompositionSettings& settings;
    const BakeLayout& bake;
    Plan plan;
    std::array<ResourceIndex, bakeSectionCount> sections{};
    ResourceIndex surfelLight = -1, surfelEmission = -1, nodes = -1, caches = -1, grid = -1, gridAndMap = -1;
    ResourceIndex kept = -1, settled = -1; // skipUnchanged only

    ResourceIndex section(BakeSection s) const { return sections[size_t(s)]; }
    int bandsFeature() const { return int(bake.bands) - 2; }
    int skipFeature() const { return settings.skipUnchanged ? skippedIfSettled : alwaysComputed; }
    int surfelStride() const { return int(BakeLayout::stride(bake.surfels)); }

    ResourceIndex addBuffer(const char* name, ResourceKind kind, Format format, size_t numbers) {
        return plan.add({name, kind, format, 1, {}, {}, 4 * numbers});
    }
    template <class T>
    ResourceIndex addConstants(const std::string& label, const T& constants) {
        return plan.add(bufferResource(label + " constants", std::vector<T>{constants}));
    }
    ResourceIndex addImage(const char* name, ResourceKind kind, Format format, int channels) {
        return plan.add({name, kind, format, channels, settings.resolution, {}, 0});
    }

    void addBuffers() {
        for (int i = 0; i < bakeSectionCount; ++i) {
            const BakeSection s{i};
            if (!isRead(settings, s)) continue;
            const bool isFloats = s == BakeSection::linkFactors || s == BakeSection::places;
            const size_t numbers = sizeOf(bake, s);
            // A kernel's slot takes no empty buffer: nobody reads the number that stands there instead.
            sections[size_t(i)] = numbers > 0 ? addBuffer(name(s), ResourceKind::inputBuffer,
                                                          isFloats ? Format::r32f : Format::r32ui, numbers)
                                              : plan.add(bufferResource(name(s), std::vector<uint32_t>{0}));
        }
        surfelLight = addBuffer("surfel light", ResourceKind::inputBuffer, Format::r32f,
                                3 * size_t(BakeLayout::stride(bake.surfels)));
        const size_t surfelFloats = 3 * size_t(surfelStride());
        // Its slot takes something: without an emission of the frame nobody reads what stands there.
        surfelEmission = settings.emissionOfFrame ? addBuffer("surfel emission", ResourceKind::inputBuffer,
                                                              Format::r32f, surfelFloats)
                                                  : surfelLight;
        const auto ownKind = [](bool isKept) {
            return isKept ? ResourceKind::persistentBuffer : ResourceKind::transientBuffer;
        };
        nodes =
            addBuffer("nodes", ownKind(settings.skipUnchanged), Format::r32f, 4 * (size_t(bake.nodes) + 1));
        caches = addBuffer("caches", ownKind(settings.bounces || settings.skipUnchanged), Format::r32f,
                           size_t(litCaches()) * size_t(floatsOfCache(bandsFeature())));
        if (settings.skipUnchanged) {
            const size_t planes = settings.emissionOfFrame ? 7 : 4;
            kept = addBuffer("kept", ResourceKind::persistentBuffer, Format::r32f,
                             planes * size_t(surfelStride()));
            settled = addBuffer("settled", ResourceKind::persistentBuffer, Format::r32f, 1);
        }
        const CacheGridConstants place{glm::vec4(bake.origin, 1.0f / bake.spacing),
                                       glm::ivec4(glm::ivec3(bake.bricks), 0)};
        const Extent2D e = settings.resolution;
        const glm::ivec2 map(bake.mapSize);
        if (settings.bounces || !settings.lightMap || settings.glossy != GlossyLobe::none)
            grid = addConstants("grid", place);
        if (settings.lightMap)
            gridAndMap = addConstants(
                "grid and light map",
                CacheMapConstants{place.origin, place.bricks, {e.width, e.height, map.x, map.y}});
    }

    // Those of the map come last.
    uint32_t litCaches() const { return settings.lightMap ? bake.caches : bake.gridCaches(); }

    // What irradianceOfGrid() reads.
    void bindGrid(Pass& pass, ResourceIndex constants) const {
        pass.bindings.insert(pass.bindings.end(), {{4, caches},
                                                   {5, section(BakeSection::places)},
                                                   {6, section(BakeSection::bricks)},
                                                   {7, section(BakeSection::brickCells)},
                                                   {8, section(BakeSection::cells)},
                                                   {9, section(BakeSection::receivers)},
                                                   {10, constants}});
    }

    void addLightSurfels() {
        const LightSurfelsConstants k{
            {int(bake.surfels), int(BakeLayout::stride(bake.surfels)), int(bake.nodes), 0}};
        const int emission = settings.emissionOfFrame ? withEmissionOfFrame
                             : settings.emission      ? withEmission
                                                      : withoutEmission;
        Pass pass{"light surfels",
                  "illuminance_composition/light_surfels",
                  {emission},
                  {{0, section(BakeSection::surfels)},
                   {1, surfelLight},
                   {2, nodes, Access::write},
                   {3, addConstants("light surfels", k)},
                   {11, surfelEmission}},
                  {},
                  int(bake.surfels)};
        if (settings.bounces) {
            pass.kernel += "_again";
            pass.features.push_back(bandsFeature());
            bindGrid(pass, grid);
        }
        if (settings.skipUnchanged) {
            pass.kernel += "_changed";
            pass.readsElsewhere = true; // each surfel's own numbers, before it writes them
            pass.bindings.insert(pass.bindings.end(),
                                 {{12, nodes}, {13, kept}, {14, kept, Access::write}, {15, settled}});
        }
        plan.passes.push_back(pass);
    }

    // Whether no surfel sends anything else, in two steps.
    void addSettle() {
        // Strides are whole 64s: none of the items reads beyond.
        const int items = surfelStride() % 256 == 0 ? 256 : 64;
        const int each = surfelStride() / items;
        const ResourceIndex parts =
            addBuffer("settled parts", ResourceKind::transientBuffer, Format::r32f, size_t(items));
        const SettleConstants ofParts{{items, each, 3 * surfelStride(), 0}}, ofAll{{1, items, 0, 0}};
        plan.passes.push_back(
            {"compare surfels",
             "illuminance_composition/settle",
             {},
             {{0, kept}, {1, parts, Access::write}, {2, addConstants("compare surfels", ofParts)}},
             {},
             items});
        plan.passes.push_back(
            {"compare all",
             "illuminance_composition/settle_all",
             {},
             {{0, parts}, {1, settled, Access::write}, {2, addConstants("compare all", ofAll)}},
             {},
             1});
    }

    void addPull(uint32_t number) {
        const BakeStage& stage = bake.stage[number];
        const std::string label = "pull stage " + std::to_string(number);
        const PullConstants k{{int(stage.nodes), int(BakeLayout::stride(stage.nodes)), int(stage.firstNode),
                               int(stage.firstTerm)},
                              {int(stage.terms), 0, 0, 0}};
        Pass pass{label,
                  "illuminance_composition/pull",
                  {skipFeature()},
                  {{0, section(BakeSection::terms)},
                   {1, nodes},
                   {2, nodes, Access::write},
                   {3, addConstants(label, k)},
                   {4, settings.skipUnchanged ? settled : nodes}}, // nobody reads the latter there
                  {},
                  int(stage.nodes)};
        pass.readsElsewhere = true; // a stage sums up nodes of earlier ones
        plan.passes.push_back(pass);
    }

    void addLightCaches() {
        const LightCachesConstants k{{int(litCaches()), int(bake.links), 0, 0}};
        // Without bounces there is nothing that would have to settle.
        const int update = settings.bounces ? (settings.skipUnchanged ? closeUnlessSettled : keptIfClose)
                                            : (settings.skipUnchanged ? anewUnlessSettled : computedAnew);
        Pass pass = {"light caches",
                     "illuminance_composition/light_caches",
                     {bandsFeature(),
                      bake.linkForm == LinkForm::direction ? directionLinks : coefficientLinks, update},
                     {{0, nodes},
                      {1, section(BakeSection::linkNodes)},
                      {2, section(BakeSection::linkFactors)},
                      {3, section(BakeSection::linkShapes)},
                      {4, caches, Access::write},
                      {5, addConstants("light caches", k)},
                      {6, settings.skipUnchanged ? settled : nodes}, // nobody reads the latter there
                      {7, update == computedAnew ? nodes : caches}},
                     {},
                     int(litCaches())};
        pass.readsElsewhere = true; // each cache's own light, before it is written
        plan.passes.push_back(pass);
    }

    void addGlossy() {
        const Extent2D e = settings.resolution;
        // What lights pixels otherwise may have these, too.
        const auto known = [&](const char* name, auto add) {
            const ResourceIndex index = plan.find(name);
            return index >= 0 ? index : add(name);
        };
        const auto constants = [&](const char* name, size_t size) {
            return known(name, [&](const char* n) {
                return plan.add({n, ResourceKind::frameConstants, {}, 1, {}, {}, size});
            });
        };
        const auto image = [&](const char* name, Format format, int channels) {
            return known(name,
                         [&](const char* n) { return addImage(n, ResourceKind::input, format, channels); });
        };
        const bool isOrthographic = settings.conventions.projection == Projection::orthographic;
        Pass pass{"shade glossy",
                  "illuminance_composition/shade_glossy",
                  {isOrthographic ? orthographicProjection : perspectiveProjection, bandsFeature()},
                  {},
                  e};
        pass.bindings = {{0, image("depth", Format::r32f, 1)},
                         {1, image("normal", Format::rgba16f, 3)},
                         {2, constants("camera", sizeof(CameraConstants))},
                         {3, constants("view to world", sizeof(ViewToWorldConstants))}};
        bindGrid(pass, grid);
        const bool isConstant = settings.glossyExponent.has_value();
        const GlossyConstants k{{e.width, e.height, 0, 0},
                                {settings.glossy == GlossyLobe::mirror ? mirrorLobe : halfwayLobe,
                                 isConstant ? constantExponent : exponentOfPixel, 0, 0},
                                {settings.glossyExponent.value_or(0.0f), 0.0f, 0.0f, 0.0f}};
        // The slot takes an image: nobody reads depth there.
        const ResourceIndex exponents =
            isConstant ? plan.find("depth") : addImage("exponent", ResourceKind::input, Format::r32f, 1);
        pass.bindings.insert(
            pass.bindings.end(),
            {{11, addConstants("shade glossy", k)},
             {12, addImage("glossy", ResourceKind::output, Format::rgba16f, 3), Access::write},
             {13, exponents}});
        plan.passes.push_back(pass);
    }

    void addShade() {
        const Extent2D e = settings.resolution;
        const bool isOrthographic = settings.conventions.projection == Projection::orthographic;
        Pass pass{"shade",
                  "illuminance_composition/shade",
                  {isOrthographic ? orthographicProjection : perspectiveProjection, bandsFeature()},
                  {},
                  e};
        const auto constants = [&](const char* name, size_t size) {
            return plan.add({name, ResourceKind::frameConstants, {}, 1, {}, {}, size});
        };
        pass.bindings = {{0, addImage("depth", ResourceKind::input, Format::r32f, 1)},
                         {1, addImage("normal", ResourceKind::input, Format::rgba16f, 3)}};
        if (settings.lightMap) {
            pass.kernel += "_map";
            pass.bindings.insert(pass.bindings.end(),
                                 {{2, constants("view", sizeof(ShadeViewConstants))},
                                  {3, section(BakeSection::mapTexels)},
                                  {11, addImage("map place", ResourceKind::input, Format::rgba32f, 2)}});
            bindGrid(pass, gridAndMap);
        } else {
            pass.bindings.insert(pass.bindings.end(),
                                 {{2, constants("camera", sizeof(CameraConstants))},
                                  {3, constants("view to world", sizeof(ViewToWorldConstants))},
                                  {11, addConstants("shade", ShadeConstants{{e.width, e.height, 0, 0}})}});
            bindGrid(pass, grid);
        }
        if (settings.writeIndirect)
            pass.bindings.push_back(
                {12, addImage("indirect", ResourceKind::output, Format::rgba16f, 3), Access::write});
        if (settings.compose) {
            pass.label = "shade and compose";
            pass.kernel += settings.writeIndirect ? "_both" : "_compose";
            pass.bindings.insert(
                pass.bindings.end(),
                {{13, addImage("albedo", ResourceKind::input, Format::rgba16f, 3)},
                 {14, addImage("lit", ResourceKind::input, Format::rgba16f, 3)},
                 {15, addImage("composed", ResourceKind::output, Format::rgba16f, 3), Access::write}});
        }
        plan.passes.push_back(pass);
    }
};

} // namespace detail

inline Result<Plan> planIlluminanceComposition(const IlluminanceCompositionSettings& settings) {
    if (auto valid = detail::validate(settings); !valid) return valid.error();
    return detail::IlluminanceCompositionPlanner(settings).build();
}

} // namespace rebound
