// SPDX-License-Identifier: MIT
// The plan of the input check, and a frame's constants.
#include "readings.hpp"

#include <cstring>
#include <string_view>
#include <utility>

namespace rebound {
namespace detail {
namespace {

// Builds the plan: each row of statistics is measured by a grid of texels that sum many pixels each, folded
// and totalled.
class InputCheckPlanner {
public:
    explicit InputCheckPlanner(const InputCheckSettings& s) : settings(s) { rows.fill(-1); }

    Plan build() {
        plan.technique = "input_check";
        addHostImages();
        addMeasures();
        addTable();
        return std::move(plan);
    }

private:
    InputCheckSettings settings;
    Plan plan;
    ResourceIndex depth = -1, normal = -1, albedo = -1, radiance = -1, lit = -1, emission = -1, motion = -1;
    ResourceIndex camera = -1, tiles = -1, foldTiles = -1, totalTiles = -1;
    std::array<ResourceIndex, size_t(statisticRowCount)> rows;
    Extent2D grid, foldGrid; // enough texels for all of a processor; few enough for the next step

    ResourceIndex addImage(std::string name, ResourceKind kind, Format format, int channels,
                           Extent2D extent) {
        return plan.add({std::move(name), kind, format, channels, extent, {}, 0});
    }
    ResourceIndex addFrameConstants(std::string name, size_t size) {
        return plan.add({std::move(name), ResourceKind::frameConstants, {}, 1, {}, {}, size});
    }
    // Of a pass that sums an image on a grid.
    ResourceIndex addTiles(std::string name, Extent2D to, Extent2D from) {
        const TileConstants k{{to.width, to.height, (from.width + to.width - 1) / to.width,
                               (from.height + to.height - 1) / to.height},
                              {float(from.width), float(from.height), 0, 0}};
        return plan.add(bufferResource(std::move(name), std::vector<TileConstants>{k}));
    }

    void addHostImages() {
        const Extent2D full = settings.resolution;
        depth = addImage("depth", ResourceKind::input, Format::r32f, 1, full);
        normal = addImage("normal", ResourceKind::input, Format::rgba16f, 3, full);
        if (settings.albedo) albedo = addImage("albedo", ResourceKind::input, Format::rgba16f, 3, full);
        if (settings.radiance) radiance = addImage("radiance", ResourceKind::input, Format::rgba16f, 3, full);
        if (settings.lit) lit = addImage("lit", ResourceKind::input, Format::rgba16f, 3, full);
        if (settings.emission) emission = addImage("emission", ResourceKind::input, Format::rgba16f, 3, full);
        if (settings.motion) motion = addImage("motion", ResourceKind::input, Format::rgba16f, 2, full);
        camera = addFrameConstants("camera", sizeof(CameraConstants));
        grid = {std::min(full.width, 256), std::min(full.height, 64)};
        foldGrid = {std::min(grid.width, 16), std::min(grid.height, 4)};
        tiles = addTiles("tiles", grid, full);
        foldTiles = addTiles("fold tiles", foldGrid, grid);
        // Each of the four texels of a row sums all of the folded image.
        const TileConstants total{{4, 1, foldGrid.width, foldGrid.height}, {0, 0, 0, 0}};
        totalTiles = plan.add(bufferResource("total tiles", std::vector<TileConstants>{total}));
    }

    std::array<ResourceIndex, 4> addSums(const std::string& name, Extent2D extent) {
        std::array<ResourceIndex, 4> sums{};
        for (size_t i = 0; i < 4; ++i)
            sums[i] =
                addImage(name + " " + std::to_string(i), ResourceKind::transient, Format::rgba32f, 4, extent);
        return sums;
    }

    // A pass whose inputs are bound from slot 0 on, then its four sums, then its constants; and the passes
    // that add up.
    void addRow(StatisticRow row, const std::string& label, const char* kernel, std::vector<int> features,
                const std::vector<ResourceIndex>& inputs, const std::vector<ResourceIndex>& constants) {
        const auto sums = addSums(label, grid);
        Pass measure{label, kernel, std::move(features), {}, grid};
        bind(measure, inputs, Access::read);
        bind(measure, {sums.begin(), sums.end()}, Access::write);
        bind(measure, constants, Access::read);
        plan.passes.push_back(measure);

        const auto folded = addSums(label + " folded", foldGrid);
        Pass fold{"fold " + label, "input_check/fold", {}, {}, foldGrid};
        bind(fold, {sums.begin(), sums.end()}, Access::read);
        bind(fold, {folded.begin(), folded.end()}, Access::write);
        bind(fold, {foldTiles}, Access::read);
        plan.passes.push_back(fold);

        const ResourceIndex total =
            addImage(label + " total", ResourceKind::transient, Format::rgba32f, 4, {4, 1});
        Pass totals{"total " + label, "input_check/total", {}, {}, {4, 1}};
        bind(totals, {folded.begin(), folded.end()}, Access::read);
        bind(totals, {total}, Access::write);
        bind(totals, {totalTiles}, Access::read);
        plan.passes.push_back(totals);
        rows[size_t(row)] = total;
    }

    static void bind(Pass& pass, const std::vector<ResourceIndex>& resources, Access access) {
        for (ResourceIndex r : resources) pass.bindings.push_back({int(pass.bindings.size()), r, access});
    }

    void addMeasures() {
        const int projection = settings.conventions.projection == Projection::orthographic
                                   ? orthographicProjection
                                   : perspectiveProjection;
        const ResourceIndex planes = addFrameConstants("planes", sizeof(PlaneConstants));
        addRow(StatisticRow::values, "values", "input_check/values", {projection}, {depth, normal},
               {camera, planes, tiles});
        // Without radiance its histogram is one of depth, which nobody reads.
        addRow(StatisticRow::levels, "levels", "input_check/levels", {},
               {depth, settings.radiance ? radiance : depth}, {camera, tiles});
        for (int i = 0; i < depthReadingCount; ++i) {
            const std::string label = "depth reading " + std::to_string(i);
            const ResourceIndex reading = addFrameConstants(label, sizeof(DepthReading));
            addRow(StatisticRow(int(StatisticRow::geometry0) + i), "geometry by " + label,
                   "input_check/geometry", {projection}, {depth, normal}, {camera, reading, tiles});
        }
        if (settings.albedo)
            addRow(StatisticRow::albedo, "albedo statistics", "input_check/reflectance", {}, {depth, albedo},
                   {camera, tiles});
        if (settings.radiance) addLight(StatisticRow::radiance, "radiance statistics", radiance, projection);
        if (settings.lit) addLight(StatisticRow::lit, "lit statistics", lit, projection);
        if (settings.motion) {
            const ResourceIndex cameras = addFrameConstants("cameras", sizeof(MotionConstants));
            addRow(StatisticRow::motion, "motion statistics", "input_check/motion", {projection},
                   {depth, motion}, {camera, cameras, tiles});
        }
    }

    // What is absent is bound to the light itself, and not read.
    void addLight(StatisticRow row, const std::string& label, ResourceIndex light, int projection) {
        addRow(row, label, "input_check/light",
               {projection, settings.albedo ? 1 : 0, settings.emission ? 1 : 0},
               {depth, normal, settings.albedo ? albedo : light, settings.emission ? emission : light, light},
               {camera, tiles});
    }

    void addTable() {
        const ResourceIndex statistics =
            addImage("statistics", ResourceKind::output, Format::rgba32f, 4, inputStatisticsExtent);
        const ResourceIndex constants = addTiles("table tiles", inputStatisticsExtent, inputStatisticsExtent);
        Pass table{"table", "input_check/table", {}, {}, inputStatisticsExtent};
        for (ResourceIndex row : rows) bind(table, {row >= 0 ? row : rows[0]}, Access::read);
        bind(table, {statistics}, Access::write);
        bind(table, {constants}, Access::read);
        plan.passes.push_back(table);
    }
};

template <class T>
NamedConstants namedConstants(std::string_view name, const T& constants) {
    NamedConstants named{std::string(name), std::vector<std::byte>(sizeof(T))};
    std::memcpy(named.data.data(), &constants, sizeof(T));
    return named;
}

constexpr std::array<std::string_view, size_t(depthReadingCount)> depthReadingNames{
    "depth reading 0", "depth reading 1", "depth reading 2", "depth reading 3", "depth reading 4"};

} // namespace

Result<std::vector<NamedConstants>> inputCheckConstants(const InputCheckSettings& settings,
                                                        const Camera& camera, const Camera& previousCamera) {
    const auto stated = cameraConstants(camera, settings.conventions, settings.resolution);
    if (!stated) return stated.error();
    std::vector<NamedConstants> constants = {
        namedConstants("camera", *stated),
        namedConstants("planes", planeConstants(camera, settings.conventions))};
    const auto readings = depthReadings(camera, settings.conventions, *stated);
    for (size_t i = 0; i < readings.size(); ++i)
        constants.push_back(namedConstants(depthReadingNames[i], readings[i]));
    if (!settings.motion) return constants;
    if (const auto previous = cameraConstants(previousCamera, settings.conventions, settings.resolution);
        !previous)
        return invalidArgument("previousCamera: " + previous.error().message);
    constants.push_back(namedConstants("cameras", motionConstants(settings, camera, previousCamera)));
    return constants;
}

} // namespace detail

Result<Plan> planInputCheck(const InputCheckSettings& settings) {
    if (!detail::isValidExtent(settings.resolution))
        return invalidArgument("settings.resolution is " + detail::toText(settings.resolution) + "; 1x1 to " +
                               detail::toText({maximumExtent, maximumExtent}) + " was expected");
    return detail::InputCheckPlanner(settings).build();
}

} // namespace rebound
