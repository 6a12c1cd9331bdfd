// SPDX-License-Identifier: MIT
// Which places shadow maps say are lit. Kernel language, of kernels that declare
//   RB_FEATURE    maps                         how many shadow maps, minus 1
//   RB_BUFFER     views                        ShadowView
//   RB_INPUT      map0, map1, map2, map3       stored depth
#ifndef REBOUND_SHADOW_VIEWS_H
#define REBOUND_SHADOW_VIEWS_H

RB_FUNCTION Real alongRow(vec4 row, Vec3 position) RB_OF_KERNEL {
    return position.x * row.x + position.y * row.y + position.z * row.z + row.w;
}

RB_FUNCTION Real depthAt(int map, IVec2 at) RB_OF_KERNEL {
    Real depth = Real(0.0f);
    if (map == 0) depth = fetchAt(map0, at).x;
    if (maps > 0 && map == 1) depth = fetchAt(map1, at).x;
    if (maps > 1 && map == 2) depth = fetchAt(map2, at).x;
    if (maps > 2 && map == 3) depth = fetchAt(map3, at).x;
    return depth;
}

// 1 where the first of these views that holds the place sees it, or none holds it; 0 elsewhere.
RB_FUNCTION Real litByViews(int first, int count, Vec3 position, Vec3 normal) RB_OF_KERNEL {
    Real lit = Real(1.0f);
    Mask waiting = Real(0.0f) < Real(1.0f);
    for (int i = first; i < first + count; ++i) {
        ShadowView view = views[i];
        Vec3 moved = position + normal * (alongRow(view.w, position) * view.distance.x + view.distance.y);
        Real w = alongRow(view.w, moved);
        Real x = alongRow(view.x, moved) / w;
        Real y = alongRow(view.y, moved) / w;
        Real depth = alongRow(view.z, moved) / w;
        Mask holds = waiting && w > 0.0f && x >= view.tile.x && x < view.tile.z && y >= view.tile.y &&
                     y < view.tile.w && depth >= 0.0f && depth <= 1.0f;
        if (anyLane(holds)) {
            IVec2 texel = IVec2(toInt(select(holds, x, Real(0.0f))), toInt(select(holds, y, Real(0.0f))));
            Real behind = (depth - depthAt(view.image.x, texel)) * float(view.image.y);
            lit = select(holds && behind > 0.0f, Real(0.0f), lit);
            waiting = waiting && !holds;
        }
    }
    return lit;
}

#endif
