// SPDX-License-Identifier: MIT
// Definitions of screen_indirect.hpp.

#include "rebound/math/rings.hpp"

#include <array>
#include <cstdio>

namespace rebound {
namespace detail {

#include "rebound/techniques/screen_indirect_constants.h"

inline int startShift(StartResolution s) {
    return s == StartResolution::full ? 0 : s == StartResolution::half ? 1 : 2;
}

// Size of an image reduced 2^shift times; every pixel stays inside some texel.
inline Extent2D reducedExtent(Extent2D e, int shift) {
    const int round = (1 << shift) - 1;
    return {(e.width + round) >> shift, (e.height + round) >> shift};
}

// A number as people write it: six significant digits, no zeros behind them.
inline std::string toText(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", value);
    return text.data();
}

inline std::string rangeMessage(const char* setting, double value, double low, double high) {
    return std::string("settings.") + setting + " is " + toText(value) + "; " + toText(low) + " to " +
           toText(high) + " was expected";
}

inline Result<> validate(const ScreenIndirectSettings& s) {
    if (!isValidExtent(s.resolution))
        return invalidArgument("settings.resolution is " + toText(s.resolution) + "; 1x1 to " +
                               toText({maximumExtent, maximumExtent}) + " was expected");
    if (s.levels < 1 || s.levels > 8) return invalidArgument(rangeMessage("levels", s.levels, 1, 8));
    if ((s.samplesPerLevel < 4 || s.samplesPerLevel > 256) && s.samplesPerLevel != wholeRings)
        return invalidArgument("settings.samplesPerLevel is " + toText(s.samplesPerLevel) +
                               "; 4 to 256, or wholeRings, was expected");
    if (!(s.ringRadius >= 1.0f && s.ringRadius <= 1024.0f))
        return invalidArgument(rangeMessage("ringRadius", s.ringRadius, 1.0f, 1024.0f));
    if (!(s.minimumCosine >= 0.001f && s.minimumCosine <= 1.0f))
        return invalidArgument(rangeMessage("minimumCosine", s.minimumCosine, 0.001f, 1.0f));
    if (s.onlyLevel && (*s.onlyLevel < 0 || *s.onlyLevel >= s.levels))
        return invalidArgument(rangeMessage("onlyLevel", *s.onlyLevel, 0, s.levels - 1));
    if (!s.writeIndirect && !s.compose)
        return invalidArgument(
            "settings.writeIndirect and settings.compose are both false; one output was expected");
    return {};
}

// Builds the plan pass by pass, in the order of RR-7162's pipeline (fig. 3).
class ScreenIndirectPlanner {
public:
    explicit ScreenIndirectPlanner(const ScreenIndirectSettings& s) : settings(s) {}

    Plan build() {
        plan.technique = "screen_indirect";
        addHostImages();
        camera = plan.add({"camera", ResourceKind::frameConstants, {}, 1, {}, {}, sizeof(CameraConstants)});
        addReductions();
        addGathers();
        addOutputs();
        return std::move(plan);
    }

private:
    struct Level {
        int shift = 0; // full-resolution pixels a texel: 2^shift
        Extent2D extent;
        ResourceIndex surface = -1, light = -1;
    };

    ScreenIndirectSettings settings;
    Plan plan;
    ResourceIndex camera = -1, depth = -1, normal = -1, radiance = -1;
    std::vector<Level> levels; // from the start resolution on
    ResourceIndex result = -1; // indirect light at the start resolution

    int projection() const {
        return settings.conventions.projection == Projection::orthographic ? orthographicProjection
                                                                           : perspectiveProjection;
    }
    // The levels that gather: all, or the one that is shown alone.
    int coarsest() const { return settings.onlyLevel.value_or(settings.levels - 1); }
    int finestGathered() const { return settings.onlyLevel.value_or(0); }

    ResourceIndex addImage(std::string name, ResourceKind kind, Format format, int channels,
                           Extent2D extent) {
        return plan.add({std::move(name), kind, format, channels, extent, {}, 0});
    }
    template <class T>
    ResourceIndex addConstants(const std::string& label, const T& constants) {
        return plan.add(bufferResource(label + " constants", std::vector<T>{constants}));
    }
    static std::string numbered(const char* what, int level) { return what + std::to_string(level); }

    void addHostImages() {
        const Extent2D full = settings.resolution;
        depth = addImage("depth", ResourceKind::input, Format::r32f, 1, full);
        normal = addImage("normal", ResourceKind::input, Format::rgba16f, 3, full);
        radiance = addImage("radiance", ResourceKind::input, Format::rgba16f, 3, full);
    }

    Level addLevel(const std::string& suffix, int shift) {
        Level level{shift, reducedExtent(settings.resolution, shift), -1, -1};
        level.surface =
            addImage("surface " + suffix, ResourceKind::transient, Format::rgba32f, 4, level.extent);
        level.light = addImage("light " + suffix, ResourceKind::transient, Format::rgba16f, 4, level.extent);
        return level;
    }

    void addReductions() {
        const int start = startShift(settings.start);
        levels.push_back(addLevel("0", start));
        addPrepare(levels[0]);
        for (int k = 1; k <= coarsest(); ++k) {
            const std::string suffix = std::to_string(k);
            levels.push_back(addLevel(suffix, start + k));
            addReduce("reduce to level " + suffix, levels[size_t(k) - 1], levels[size_t(k)]);
        }
    }

    int reduction() const { return settings.reduction == Reduction::voting ? reduceVoting : reduceNearest; }

    void addPrepare(const Level& to) {
        const ReduceConstants k{{to.extent.width, to.extent.height, 0, 0},
                                {1.0f, settings.minimumCosine, 0, 0}};
        Pass pass{"prepare", "screen_indirect/prepare", {projection()}, {}, to.extent};
        if (to.shift > 0) {
            pass.kernel = to.shift == 1 ? "screen_indirect/prepare_half" : "screen_indirect/prepare_quarter";
            pass.features = {projection(), reduction()};
        }
        pass.bindings = {{0, depth},
                         {1, normal},
                         {2, radiance},
                         {3, to.surface, Access::write},
                         {4, to.light, Access::write},
                         {5, camera},
                         {6, addConstants("prepare", k)}};
        plan.passes.push_back(pass);
    }

    void addReduce(const std::string& label, const Level& from, const Level& to) {
        const ReduceConstants k{{to.extent.width, to.extent.height, 0, 0},
                                {float(1 << from.shift), settings.minimumCosine, 0, 0}};
        const ResourceIndex constants = addConstants(label, k);
        plan.passes.push_back({label,
                               "screen_indirect/reduce",
                               {projection(), reduction()},
                               {{0, from.surface},
                                {1, from.light},
                                {2, to.surface, Access::write},
                                {3, to.light, Access::write},
                                {4, camera},
                                {5, constants}},
                               to.extent});
    }

    // A coarser level has a quarter of the texels, so more samples cost little there.
    int samplesOf(int k) const {
        if (settings.samplesPerLevel == wholeRings) return wholeRings;
        return int(std::lround(settings.samplesPerLevel * std::pow(1.5, k)));
    }

    ResourceIndex addGather(int k) {
        const Level& level = levels[size_t(k)];
        const std::string label = numbered("gather level ", k);
        std::vector<RingSample> samples;
        const bool open = settings.coverScreen && k == settings.levels - 1;
        const Ring shape{settings.ringRadius, k == 0, open};
        const RingPatterns patterns =
            ringPatterns(shape, samplesOf(k), settings.smooth ? 4 : 1, level.extent);
        for (const RingTexel& t : patterns.texels) samples.push_back({t.offset, t.weight, 0.0f});
        if (samples.empty()) samples.push_back({{0, 0}, 0.0f, 0.0f});
        const ResourceIndex ring = plan.add(bufferResource(label + " ring", samples));
        const GatherConstants constants{
            {level.extent.width, level.extent.height, patterns.count, patterns.isShared ? 0 : patterns.count},
            {float(1 << level.shift), 0, 0, 0}};
        const ResourceIndex gathered =
            addImage(numbered("gathered ", k), ResourceKind::transient, Format::rgba16f, 3, level.extent);
        plan.passes.push_back(
            {label,
             "screen_indirect/gather",
             {projection(),
              settings.formFactor == FormFactor::pointToPoint ? pointFormFactor : discFormFactor},
             {{0, level.surface},
              {1, level.light},
              {2, gathered, Access::write},
              {3, ring},
              {4, camera},
              {5, addConstants(label, constants)}},
             level.extent});
        return gathered;
    }

    UpsampleConstants upsampleConstants(Extent2D extent, int shift, int coarseShift) const {
        return {{extent.width, extent.height, coarseShift - shift, 0},
                {float(1 << shift), float(1 << coarseShift), 0, 0}};
    }

    void addSmooth(const Level& level) {
        const ResourceIndex mean =
            addImage("smoothed", ResourceKind::transient, Format::rgba16f, 3, level.extent);
        const ResourceIndex constants =
            addConstants("smooth", upsampleConstants(level.extent, level.shift, level.shift));
        plan.passes.push_back(
            {"smooth",
             "screen_indirect/smooth",
             {projection()},
             {{0, level.surface}, {1, result}, {2, mean, Access::write}, {3, camera}, {4, constants}},
             level.extent});
        result = mean;
    }

    // combined = gathered + upsampled coarser level, from the coarsest on; or just the latter where one level is shown.
    void addGathers() {
        result = addGather(coarsest());
        if (settings.smooth) addSmooth(levels[size_t(coarsest())]);
        for (int k = coarsest() - 1; k >= 0; --k) {
            const Level& level = levels[size_t(k)];
            const Level& coarser = levels[size_t(k) + 1];
            const bool gathers = k >= finestGathered();
            const ResourceIndex gathered = gathers ? addGather(k) : -1;
            const std::string label = numbered("combine level ", k);
            const ResourceIndex combined =
                addImage(numbered("combined ", k), ResourceKind::transient, Format::rgba16f, 3, level.extent);
            const ResourceIndex constants =
                addConstants(label, upsampleConstants(level.extent, level.shift, coarser.shift));
            Pass pass{label,
                      gathers ? "screen_indirect/combine" : "screen_indirect/carry",
                      {projection()},
                      {},
                      level.extent};
            pass.bindings = {{0, level.surface},           {1, coarser.surface}, {2, result},
                             {3, combined, Access::write}, {4, camera},          {5, constants}};
            if (gathers) {
                pass.features.push_back(settings.smooth ? smoothed : unsmoothed);
                pass.bindings.push_back({6, gathered});
            }
            plan.passes.push_back(pass);
            result = combined;
        }
    }

    void addOutputs() {
        const Extent2D full = settings.resolution;
        ResourceIndex indirect = -1, composed = -1, albedo = -1, lit = -1;
        if (settings.writeIndirect)
            indirect = addImage("indirect", ResourceKind::output, Format::rgba16f, 3, full);
        if (settings.compose) {
            albedo = addImage("albedo", ResourceKind::input, Format::rgba16f, 3, full);
            lit = addImage("lit", ResourceKind::input, Format::rgba16f, 3, full);
            composed = addImage("composed", ResourceKind::output, Format::rgba16f, 3, full);
        }
        const Level& start = levels[0];
        const ResourceIndex constants = addConstants("upsample", upsampleConstants(full, 0, start.shift));
        Pass upsample{"upsample", "screen_indirect/upsample", {projection()}, {}, full};
        upsample.bindings = {{0, depth},  {1, normal}, {2, start.surface},
                             {3, result}, {4, camera}, {5, constants}};
        if (settings.compose) {
            upsample.label = "upsample and compose";
            upsample.kernel =
                settings.writeIndirect ? "screen_indirect/upsample_both" : "screen_indirect/upsample_compose";
            upsample.bindings.insert(upsample.bindings.end(),
                                     {{6, albedo}, {7, lit}, {8, composed, Access::write}, {9, radiance}});
            if (settings.writeIndirect) upsample.bindings.push_back({10, indirect, Access::write});
        } else {
            upsample.bindings.insert(upsample.bindings.end(), {{6, indirect, Access::write}, {7, radiance}});
        }
        plan.passes.push_back(upsample);
    }
};

struct ScreenIndirectPreset {
    std::string_view name;
    StartResolution start;
    int samples;
    int levels;
};
inline constexpr std::array<ScreenIndirectPreset, 8> screenIndirectPresets{{
    {"quarter-64", StartResolution::quarter, 64, 4},
    {"quarter-256", StartResolution::quarter, 256, 4},
    {"half-64", StartResolution::half, 64, 4},
    {"half-256", StartResolution::half, 256, 4},
    {"quarter-64-5", StartResolution::quarter, 64, 5},
    {"quarter-256-5", StartResolution::quarter, 256, 5},
    {"half-64-5", StartResolution::half, 64, 5},
    {"half-256-5", StartResolution::half, 256, 5},
}};
inline constexpr auto screenIndirectNames = [] {
    std::array<std::string_view, screenIndirectPresets.size()> names;
    for (size_t i = 0; i < names.size(); ++i) names[i] = screenIndirectPresets[i].name;
    return names;
}();

} // namespace detail

inline std::span<const std::string_view> screenIndirectPresetNames() { return detail::screenIndirectNames; }

inline Result<ScreenIndirectSettings> screenIndirectPreset(std::string_view name, Extent2D resolution) {
    std::string known;
    for (const detail::ScreenIndirectPreset& preset : detail::screenIndirectPresets) {
        if (preset.name == name) {
            ScreenIndirectSettings s;
            s.resolution = resolution;
            s.start = preset.start;
            s.samplesPerLevel = preset.samples;
            s.levels = preset.levels;
            s.ringRadius = std::clamp(40.0f * float(resolution.height) / 720.0f, 1.0f, 1024.0f);
            return s;
        }
        known += (known.empty() ? "" : ", ") + std::string(preset.name);
    }
    return Error{ErrorCode::notFound,
                 "preset is \"" + std::string(name) + "\"; one of " + known + " was expected"};
}

inline float coveringRingRadius(const ScreenIndirectSettings& s) {
    const Extent2D full{std::clamp(s.resolution.width, 1, maximumExtent),
                        std::clamp(s.resolution.height, 1, maximumExtent)};
    const Extent2D e = detail::reducedExtent(full, detail::startShift(s.start));
    const float diagonal = std::hypot(float(e.width), float(e.height));
    const int levels = std::clamp(s.levels, 1, 8);
    return std::clamp(std::ceil(diagonal / float(1 << (levels - 1))), 1.0f, 1024.0f);
}

inline Result<Plan> planScreenIndirect(const ScreenIndirectSettings& settings) {
    if (auto valid = detail::validate(settings); !valid) return valid.error();
    return detail::ScreenIndirectPlanner(settings).build();
}

} // namespace rebound
