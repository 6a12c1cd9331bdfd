// SPDX-License-Identifier: MIT
#include "rebound/bake/bake_scene.hpp"

#include "bake_parts.hpp"
#include "bake_tasks.hpp"
#include "light_map.hpp"

#include "rebound/bake/packing.hpp"
#include "rebound/bake/surfels.hpp"

#include <bit>
#include <cmath>
#include <memory>
#include <new>

namespace rebound {

namespace {

using namespace detail;

std::vector<uint32_t> packCells(const std::vector<Cell>& cells, const std::vector<uint32_t>& firstReceiver) {
    std::vector<uint32_t> words;
    words.reserve(12 * cells.size());
    for (size_t i = 0; i < cells.size(); ++i) {
        words.insert(words.end(), cells[i].caches.begin(), cells[i].caches.end());
        words.insert(words.end(),
                     {cells[i].key, firstReceiver[i], firstReceiver[i + 1] - firstReceiver[i], 0u});
    }
    return words;
}

std::vector<uint32_t> packPlaces(const std::vector<glm::vec3>& places) {
    std::vector<uint32_t> words;
    words.reserve(4 * places.size());
    for (const glm::vec3 place : places)
        for (int k = 0; k < 4; ++k) words.push_back(k < 3 ? std::bit_cast<uint32_t>(place[k]) : 0u);
    return words;
}

using Sections = std::array<std::vector<uint32_t>, bakeSectionCount>;

Bake assemble(const BakeLayout& layout, Sections&& parts) {
    auto sections = std::make_shared<Sections>(std::move(parts));
    Bake bake;
    bake.layout = layout;
    for (size_t i = 0; i < sections->size(); ++i) bake.sections[i] = (*sections)[i];
    bake.storage = std::move(sections);
    return bake;
}

// Caches of the map behind those of the grid.
void append(const LightMap& map, std::vector<glm::vec3>& caches, std::vector<glm::vec3>& normals) {
    for (const SurfacePlace& place : map.caches) {
        caches.push_back(place.position);
        normals.push_back(place.normal);
    }
}

std::vector<uint32_t> numberedFrom(uint32_t first, std::vector<uint32_t> texels) {
    for (uint32_t& texel : texels)
        if ((texel & BakeLayout::noMapCache) != BakeLayout::noMapCache) texel += first;
    return texels;
}

void setMap(BakeLayout& layout, const LightMap& map) {
    layout.surfaceCaches = uint32_t(map.caches.size());
    layout.mapSize = map.size;
    layout.mapBackRow = map.backRow;
    layout.mapTriangles = uint32_t(map.corners.size() / 3);
    layout.mapTexel = map.texel;
}

// Nothing in a process that only helps.
Result<std::optional<Bake>> bakeValid(const BakeGeometry& geometry, const RayCaster& rays,
                                      const BakeSettings& settings, const BakeExperiments& experiments,
                                      BakeCrew& crew) {
    const auto report = [&](std::string_view what, double share) {
        if (settings.progress) settings.progress(what, share);
    };
    report("surfels", 0.0);
    auto surfels = placeSurfels(geometry, rays, settings);
    if (!surfels) return surfels.error();
    report("hierarchy", 0.0);
    auto tree = buildSurfelTree(*surfels, settings.hierarchy, settings.threads);
    if (!tree) return tree.error();

    report("grid", 0.0);
    const Surroundings around(geometry, rays);
    const ReceivingSides receiving = findReceivingSides(geometry, rays, settings);
    auto grid = chooseCells(geometry, receiving, settings, experiments.gridShift);
    if (!grid) return grid.error();
    report("caches", 0.0);
    const std::vector<CachePlace> places = placeCaches(around, *grid, settings.threads);
    const CellTable table =
        tabulateCells(*grid, places, placeInLostCells(around, *grid, places, receiving.sides));
    if (table.cells.empty())
        return Error{ErrorCode::invalidData,
                     "no place near the geometry's surfaces is outside of it; with a finer grid "
                     "(settings.caches, settings.spacing) there may be"};
    BakeLayout layout;
    layout.geometry = fingerprintOf(geometry);
    const auto done = [&](const BakeTask& task) {
        return crew.run(task, settings.threads, [&](double share) { report(task.name, share); });
    };
    report("receivers", 0.0);
    const ReceiverTask receiverTask(around, grid->lattice, table, receiving.sides, layout.geometry);
    auto receiverParts = done(receiverTask.task());
    if (!receiverParts) return receiverParts.error();
    LightMap map;
    if (settings.lightMap > 0) {
        report("light map", 0.0);
        map = mapLight(around, settings, experiments.map);
    }
    std::vector<glm::vec3> caches = table.caches, normals;
    append(map, caches, normals);
    const LinkTask linkTask(around, caches, normals, *tree, settings, layout.geometry);
    auto linkParts = done(linkTask.task());
    if (!linkParts) return linkParts.error();
    if (linkParts->empty()) return std::optional<Bake>();
    ReceiverSections receivers = receiverTask.merge(*std::move(receiverParts));
    LinkSections links = linkTask.merge(*std::move(linkParts));

    setTree(layout, *tree);
    layout.caches = uint32_t(caches.size());
    layout.links = settings.links;
    layout.bands = settings.bands;
    layout.linkForm = settings.linkForm;
    layout.origin = grid->lattice.origin;
    layout.spacing = grid->lattice.spacing;
    layout.bricks = table.bricks;
    layout.filledBricks = table.filledBricks;
    layout.cells = uint32_t(table.cells.size());
    layout.receivers = uint32_t(receivers.words.size() / 4);
    setMap(layout, map);
    // In the order of BakeSection.
    return {assemble(layout,
                     {packSurfels(*tree, *surfels), std::move(tree->terms), std::move(links.nodes),
                      std::move(links.factors), std::move(links.shapes), packPlaces(caches), table.brickOf,
                      table.cellOf, packCells(table.cells, receivers.first), std::move(receivers.words),
                      numberedFrom(uint32_t(table.caches.size()), std::move(map.texels)),
                      std::move(map.corners)})};
}

} // namespace

Result<std::optional<Bake>> detail::bakeScene(const BakeGeometry& geometry, const RayCaster& rays,
                                              const BakeSettings& settings,
                                              const BakeExperiments& experiments, BakeCrew& crew) {
    if (auto valid = validate(settings); !valid) return valid.error();
    if (auto valid = validate(geometry); !valid) return valid.error();
    try {
        return bakeValid(geometry, rays, settings, experiments, crew);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::outOfMemory, "memory is too short for a bake of " +
                                                 std::to_string(settings.surfels) + " surfels and " +
                                                 std::to_string(settings.caches) + " caches of " +
                                                 std::to_string(settings.links) + " links"};
    }
}

Result<Bake> bakeScene(const BakeGeometry& geometry, const RayCaster& rays, const BakeSettings& settings) {
    LocalBakeCrew alone;
    auto bake = bakeScene(geometry, rays, settings, alone);
    if (!bake) return bake.error();
    return **std::move(bake);
}

Result<std::optional<Bake>> bakeScene(const BakeGeometry& geometry, const RayCaster& rays,
                                      const BakeSettings& settings, BakeCrew& crew) {
    return detail::bakeScene(geometry, rays, settings, detail::BakeExperiments{}, crew);
}

} // namespace rebound
