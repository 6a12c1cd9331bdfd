// SPDX-License-Identifier: MIT
#include "rebound/embree/ray_caster.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace rebound {

namespace {

struct DeviceDeleter {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct GeometryDeleter {
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
struct BufferDeleter {
    void operator()(RTCBuffer buffer) const { rtcReleaseBuffer(buffer); }
};
using DeviceOwner = std::unique_ptr<RTCDeviceTy, DeviceDeleter>;
using SceneOwner = std::unique_ptr<RTCSceneTy, SceneDeleter>;
using GeometryOwner = std::unique_ptr<RTCGeometryTy, GeometryDeleter>;
using BufferOwner = std::unique_ptr<RTCBufferTy, BufferDeleter>;

// A geometry of Embree's: those triangles that may have holes, or those that have none. The filter of the former costs the
// latter nothing.
struct Part {
    std::vector<uint32_t> triangles;                         // of BakeGeometry, by number in Embree
    std::function<BakeSurface(uint32_t, glm::vec2)> surface; // empty: no holes
};

// Embree calls this for each hit of a part with holes; its address is the geometry's user data.
void rejectHoles(const RTCFilterFunctionNArguments* arguments) {
    const auto& part = *static_cast<const Part*>(arguments->geometryUserPtr);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        const uint32_t triangle = part.triangles[RTCHitN_primID(arguments->hit, arguments->N, i)];
        const glm::vec2 place(RTCHitN_u(arguments->hit, arguments->N, i),
                              RTCHitN_v(arguments->hit, arguments->N, i));
        if (part.surface(triangle, place).hole) arguments->valid[i] = 0;
    }
}

BufferOwner copyPositions(RTCDevice device, const std::vector<glm::vec3>& positions) {
    const size_t bytes = positions.size() * sizeof(glm::vec3);
    constexpr size_t padding = 16; // Embree reads the last position as four floats
    BufferOwner buffer(rtcNewBuffer(device, bytes + padding));
    if (buffer) std::memcpy(rtcGetBufferData(buffer.get()), positions.data(), bytes);
    return buffer;
}

bool attach(RTCDevice device, RTCScene scene, const BakeGeometry& source, RTCBuffer positions,
            const Part& part, unsigned id) {
    if (part.triangles.empty()) return true;
    const GeometryOwner geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
    if (!geometry) return false;
    rtcSetGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions, 0,
                         sizeof(glm::vec3), source.positions.size());
    auto* index = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0,
                                                                 RTC_FORMAT_UINT3, 3 * sizeof(uint32_t),
                                                                 part.triangles.size()));
    if (!index) return false;
    for (const uint32_t triangle : part.triangles)
        index = std::copy_n(&source.indices[size_t(triangle) * 3], 3, index);
    if (part.surface) {
        rtcSetGeometryUserData(geometry.get(), const_cast<Part*>(&part));
        rtcSetGeometryIntersectFilterFunction(geometry.get(), rejectHoles);
        rtcSetGeometryOccludedFilterFunction(geometry.get(), rejectHoles);
    }
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene, geometry.get(), id);
    return true;
}

RTCRay toEmbree(const BakeRay& ray) {
    RTCRay out{};
    out.org_x = ray.origin.x;
    out.org_y = ray.origin.y;
    out.org_z = ray.origin.z;
    out.tnear = ray.minimum;
    out.dir_x = ray.direction.x;
    out.dir_y = ray.direction.y;
    out.dir_z = ray.direction.z;
    out.tfar = ray.maximum;
    out.mask = ~0u;
    return out;
}

} // namespace

struct EmbreeRayCaster::State {
    Part parts[2]; // by geometry in Embree: without holes, with holes
    DeviceOwner device;
    SceneOwner scene;
};

EmbreeRayCaster::EmbreeRayCaster(std::unique_ptr<State> built) : state(std::move(built)) {}
EmbreeRayCaster::EmbreeRayCaster(EmbreeRayCaster&&) noexcept = default;
EmbreeRayCaster& EmbreeRayCaster::operator=(EmbreeRayCaster&&) noexcept = default;
EmbreeRayCaster::~EmbreeRayCaster() = default;

Result<EmbreeRayCaster> EmbreeRayCaster::build(const BakeGeometry& geometry) {
    if (auto valid = validate(geometry); !valid) return valid.error();
    try {
        auto state = std::make_unique<State>();
        // Built by one thread, the hierarchy does not depend on scheduling, and neither do hits where surfaces overlap.
        state->device.reset(rtcNewDevice("threads=1"));
        state->scene.reset(state->device ? rtcNewScene(state->device.get()) : nullptr);
        if (!state->scene) return Error{ErrorCode::unsupported, "Embree cannot start on this machine"};
        rtcSetSceneFlags(state->scene.get(), RTC_SCENE_FLAG_ROBUST);
        state->parts[1].surface = geometry.surface;
        for (uint32_t i = 0; i < geometry.triangles(); ++i) {
            const bool mayHaveHoles =
                geometry.surface && (!geometry.mayHaveHoles || geometry.mayHaveHoles(i));
            state->parts[mayHaveHoles].triangles.push_back(i);
        }
        const BufferOwner positions = copyPositions(state->device.get(), geometry.positions);
        bool attached = positions != nullptr;
        for (unsigned i = 0; i < 2 && attached; ++i)
            attached = attach(state->device.get(), state->scene.get(), geometry, positions.get(),
                              state->parts[i], i);
        if (attached) rtcCommitScene(state->scene.get());
        const RTCError error = rtcGetDeviceError(state->device.get());
        if (error == RTC_ERROR_NONE && attached) return EmbreeRayCaster(std::move(state));
        return Error{error == RTC_ERROR_OUT_OF_MEMORY ? ErrorCode::outOfMemory : ErrorCode::invalidData,
                     "Embree cannot build the geometry of " + std::to_string(geometry.triangles()) +
                         " triangles: its error is " + std::to_string(int(error))};
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::outOfMemory, "out of memory while building rays for " +
                                                 std::to_string(geometry.triangles()) + " triangles"};
    }
}

// Single rays: packets of 8 and 16 and Embree's streams took 5 to 8 % less time for a million rays that leave surfaces of
// a hall in all directions, and need rays and hits in another order.
void EmbreeRayCaster::intersect(std::span<const BakeRay> rays, std::span<BakeHit> hits) const {
    for (size_t i = 0; i < rays.size(); ++i) {
        RTCRayHit query{};
        query.ray = toEmbree(rays[i]);
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(state->scene.get(), &context, &query);
        hits[i] = query.hit.geomID == RTC_INVALID_GEOMETRY_ID
                      ? BakeHit{}
                      : BakeHit{state->parts[query.hit.geomID].triangles[query.hit.primID], query.ray.tfar,
                                glm::vec2(query.hit.u, query.hit.v)};
    }
}

void EmbreeRayCaster::occluded(std::span<const BakeRay> rays, std::span<uint8_t> answers) const {
    for (size_t i = 0; i < rays.size(); ++i) {
        RTCRay query = toEmbree(rays[i]);
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcOccluded1(state->scene.get(), &context, &query);
        answers[i] = query.tfar < 0.0f;
    }
}

} // namespace rebound
