// SPDX-License-Identifier: MIT
#include "lab/rays/embree_scene.hpp"

#include "lab/rays/texture_lookup.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <string>
#include <vector>

namespace rebound::lab {

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
using DeviceOwner = std::unique_ptr<RTCDeviceTy, DeviceDeleter>;
using SceneOwner = std::unique_ptr<RTCSceneTy, SceneDeleter>;
using GeometryOwner = std::unique_ptr<RTCGeometryTy, GeometryDeleter>;

glm::uvec3 corners(const Mesh& mesh, uint32_t triangle) {
    const uint32_t* index = &mesh.indices[size_t(triangle) * 3];
    return {index[0], index[1], index[2]};
}

template <class Value>
Value interpolate(const std::vector<Value>& values, glm::uvec3 corner, const SurfaceLocation& at) {
    return values[corner.x] * (1.0f - at.u - at.v) + values[corner.y] * at.u + values[corner.z] * at.v;
}

glm::vec2 textureCoordinate(const Mesh& mesh, const SurfaceLocation& at) {
    return mesh.textureCoordinates.empty()
               ? glm::vec2(0.0f)
               : interpolate(mesh.textureCoordinates, corners(mesh, at.triangle), at);
}

glm::vec2 emissionCoordinate(const Mesh& mesh, const SurfaceLocation& at) {
    return mesh.emissionCoordinates.empty()
               ? textureCoordinate(mesh, at)
               : interpolate(mesh.emissionCoordinates, corners(mesh, at.triangle), at);
}

// A mesh with what its rays look up; the address is the geometry's user data in Embree.
struct MeshLookup {
    const Mesh* mesh = nullptr;
    const Material* material = nullptr;
    const Texture* color = nullptr;
    const Texture* emission = nullptr;

    bool isHole(const SurfaceLocation& at) const {
        if (!material->alphaMasked) return false;
        float opacity = color ? sampleOpacity(*color, textureCoordinate(*mesh, at)) : 1.0f;
        if (!mesh->colors.empty()) opacity *= interpolate(mesh->colors, corners(*mesh, at.triangle), at).a;
        return opacity * material->baseColor.a < material->alphaCutoff;
    }
};

MeshLookup makeLookup(const Scene& scene, const Mesh& mesh) {
    const auto texture = [&](int index) { return index == none ? nullptr : &scene.textures[size_t(index)]; };
    const Material& material = scene.materials[size_t(mesh.material)];
    return {&mesh, &material, texture(material.baseColorTexture), texture(material.emissionTexture)};
}

// Embree calls this for each candidate hit of a masked mesh; only single rays are ever cast.
void rejectHoles(const RTCFilterFunctionNArguments* arguments) {
    const auto& lookup = *static_cast<const MeshLookup*>(arguments->geometryUserPtr);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        const SurfaceLocation at{
            RTCHitN_geomID(arguments->hit, arguments->N, i), RTCHitN_primID(arguments->hit, arguments->N, i),
            RTCHitN_u(arguments->hit, arguments->N, i), RTCHitN_v(arguments->hit, arguments->N, i)};
        if (lookup.isHole(at)) arguments->valid[i] = 0;
    }
}

template <class Element>
bool copyBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const void* data, size_t count) {
    void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Element), count);
    if (buffer) std::memcpy(buffer, data, sizeof(Element) * count);
    return buffer != nullptr;
}

bool attach(RTCDevice device, RTCScene scene, const MeshLookup& lookup, unsigned id) {
    const Mesh& mesh = *lookup.mesh;
    if (mesh.indices.empty()) return true;
    const GeometryOwner geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
    if (!geometry ||
        !copyBuffer<glm::vec3>(geometry.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3,
                               mesh.positions.data(), mesh.positions.size()) ||
        !copyBuffer<glm::uvec3>(geometry.get(), RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.indices.data(),
                                mesh.indices.size() / 3))
        return false;
    if (lookup.material->alphaMasked) {
        rtcSetGeometryUserData(geometry.get(), const_cast<MeshLookup*>(&lookup));
        rtcSetGeometryIntersectFilterFunction(geometry.get(), rejectHoles);
        rtcSetGeometryOccludedFilterFunction(geometry.get(), rejectHoles);
    }
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene, geometry.get(), id);
    return true;
}

RTCRay toEmbree(const Ray& ray) {
    RTCRay out{};
    out.org_x = ray.origin.x;
    out.org_y = ray.origin.y;
    out.org_z = ray.origin.z;
    out.dir_x = ray.direction.x;
    out.dir_y = ray.direction.y;
    out.dir_z = ray.direction.z;
    out.tnear = ray.minimum;
    out.tfar = ray.maximum;
    out.mask = ~0u;
    return out;
}

float largestComponent(glm::vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

constexpr float fewUnitsInLastPlace = 6.0f * std::numeric_limits<float>::epsilon();

// How far off the plane rounding may put a point, or Embree a ray that leaves it: a few units in the last
// place of the coordinates and of the triangle's extent.
float clearanceOf(glm::vec3 position, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const float extent = std::max(
        {largestComponent(a - position), largestComponent(b - position), largestComponent(c - position)});
    return fewUnitsInLastPlace * std::max(largestComponent(position), extent);
}

// The hit point from the triangle's plane in double precision: closer to it than Embree's distance is.
void refine(const Ray& ray, const Mesh& mesh, SurfaceHit& hit) {
    const glm::uvec3 corner = corners(mesh, hit.point.location.triangle);
    const glm::dvec3 a = mesh.positions[corner.x];
    const glm::dvec3 normal =
        glm::cross(glm::dvec3(mesh.positions[corner.y]) - a, glm::dvec3(mesh.positions[corner.z]) - a);
    const glm::dvec3 origin = ray.origin;
    const glm::dvec3 direction = ray.direction;
    const double distance = glm::dot(a - origin, normal) / glm::dot(direction, normal);
    // Where a triangle is edge-on or has no area, the quotient is noise.
    constexpr double agreement = 1e-3;
    if (!(std::abs(distance - double(hit.distance)) <= agreement * double(hit.distance))) return;
    hit.distance = float(distance);
    hit.point.position = glm::vec3(origin + distance * direction);
}

} // namespace

float endClearance(float rayLength) { return fewUnitsInLastPlace * rayLength; }

struct EmbreeScene::State {
    const Scene* scene = nullptr;
    std::vector<MeshLookup> lookups;
    DeviceOwner device;
    SceneOwner handle;
    RayObserver observer;
};

EmbreeScene::EmbreeScene(std::unique_ptr<State> built) : state(std::move(built)) {}
EmbreeScene::EmbreeScene(EmbreeScene&&) noexcept = default;
EmbreeScene& EmbreeScene::operator=(EmbreeScene&&) noexcept = default;
EmbreeScene::~EmbreeScene() = default;

Result<EmbreeScene> EmbreeScene::build(const Scene& scene) {
    if (auto valid = validate(scene); !valid) return valid.error();
    try {
        auto state = std::make_unique<State>();
        state->scene = &scene;
        // Built by one thread, the hierarchy does not depend on scheduling, and neither do hits where
        // surfaces overlap.
        state->device.reset(rtcNewDevice("threads=1"));
        state->handle.reset(state->device ? rtcNewScene(state->device.get()) : nullptr);
        if (!state->handle) return Error{ErrorCode::unsupported, "Embree cannot start on this machine"};
        rtcSetSceneFlags(state->handle.get(), RTC_SCENE_FLAG_ROBUST);
        for (const Mesh& mesh : scene.meshes) state->lookups.push_back(makeLookup(scene, mesh));
        bool attached = true;
        for (size_t i = 0; i < scene.meshes.size() && attached; ++i)
            attached = attach(state->device.get(), state->handle.get(), state->lookups[i], unsigned(i));
        if (attached) rtcCommitScene(state->handle.get());
        if (const RTCError error = rtcGetDeviceError(state->device.get());
            error != RTC_ERROR_NONE || !attached)
            return Error{error == RTC_ERROR_OUT_OF_MEMORY ? ErrorCode::outOfMemory : ErrorCode::invalidData,
                         "Embree cannot build scene \"" + scene.name + "\": its error is " +
                             std::to_string(int(error))};
        return EmbreeScene(std::move(state));
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::outOfMemory, "out of memory while building scene \"" + scene.name + "\""};
    }
}

std::optional<LocationHit> EmbreeScene::locate(const Ray& ray) const {
    if (state->observer) state->observer(ray, false);
    RTCRayHit query{};
    query.ray = toEmbree(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(state->handle.get(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const SurfaceLocation at{query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v};
    return LocationHit{at, query.ray.tfar};
}

std::optional<SurfaceHit> EmbreeScene::intersect(const Ray& ray) const {
    const auto found = locate(ray);
    if (!found) return std::nullopt;
    SurfaceHit hit{surfaceAt(found->location, ray.direction), found->distance};
    refine(ray, *state->lookups[found->location.mesh].mesh, hit);
    return hit;
}

bool EmbreeScene::occluded(const Ray& ray) const {
    if (state->observer) state->observer(ray, true);
    RTCRay query = toEmbree(ray);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(state->handle.get(), &context, &query);
    return query.tfar < 0.0f;
}

bool EmbreeScene::visible(const SurfacePoint& from, glm::vec3 target) const {
    const glm::vec3 origin = from.position + from.geometricNormal * from.clearance;
    return !occluded({origin, target - origin, 0.0f, 1.0f});
}

bool EmbreeScene::visible(const SurfacePoint& from, const SurfacePoint& target) const {
    const float clearance = target.clearance + endClearance(glm::length(target.position - from.position));
    return visible(from, target.position + target.geometricNormal * clearance);
}

bool EmbreeScene::open(const SurfacePoint& from, glm::vec3 direction) const {
    return !occluded({from.position + from.geometricNormal * from.clearance, direction});
}

SurfacePoint EmbreeScene::surfaceAt(const SurfaceLocation& at, glm::vec3 viewDirection) const {
    const MeshLookup& lookup = state->lookups[at.mesh];
    const Mesh& mesh = *lookup.mesh;
    const Material& material = *lookup.material;
    const glm::uvec3 corner = corners(mesh, at.triangle);
    const glm::vec3 a = mesh.positions[corner.x];
    const glm::vec3 b = mesh.positions[corner.y];
    const glm::vec3 c = mesh.positions[corner.z];

    SurfacePoint point;
    point.location = at;
    point.position = interpolate(mesh.positions, corner, at);
    point.clearance = clearanceOf(point.position, a, b, c);
    // In double precision, the cross product of edges of 1e-4 m or 1e5 m neither vanishes nor overflows.
    const glm::dvec3 scaled = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
    const glm::vec3 towards = -viewDirection;
    const auto turned = [&](glm::vec3 normal) { return glm::dot(normal, towards) < 0.0f ? -normal : normal; };
    const double area = glm::length(scaled);
    point.geometricNormal = turned(area > 0.0 ? glm::vec3(scaled / area) : glm::normalize(towards));
    const glm::vec3 interpolated = interpolate(mesh.normals, corner, at);
    const float length = glm::length(interpolated);
    point.shadingNormal = length > 0.0f ? turned(interpolated / length) : point.geometricNormal;

    point.albedo = glm::vec3(material.baseColor);
    if (lookup.color) point.albedo *= glm::vec3(sampleTexture(*lookup.color, textureCoordinate(mesh, at)));
    if (!mesh.colors.empty()) point.albedo *= glm::vec3(interpolate(mesh.colors, corner, at));
    if (material.emission != glm::vec3(0.0f)) {
        point.emission = material.emission;
        if (lookup.emission)
            point.emission *= glm::vec3(sampleTexture(*lookup.emission, emissionCoordinate(mesh, at)));
    }
    return point;
}

glm::vec3 EmbreeScene::positionAt(const SurfaceLocation& at) const {
    const Mesh& mesh = *state->lookups[at.mesh].mesh;
    return interpolate(mesh.positions, corners(mesh, at.triangle), at);
}

const Material& EmbreeScene::materialAt(const SurfaceLocation& at) const {
    return *state->lookups[at.mesh].material;
}

bool EmbreeScene::isHole(const SurfaceLocation& at) const { return state->lookups[at.mesh].isHole(at); }

const Scene& EmbreeScene::scene() const { return *state->scene; }

void EmbreeScene::observeRays(RayObserver observer) { state->observer = std::move(observer); }

} // namespace rebound::lab
