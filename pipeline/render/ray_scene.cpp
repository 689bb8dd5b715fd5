#include "pipeline/render/ray_scene.h"

#if MFAR_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace mfar {
namespace {

#if MFAR_EMBREE_MAJOR >= 4
void intersectOne(RTCScene scene, RTCRayHit& query) {
    rtcIntersect1(scene, &query);
}
void intersectPacket(const int* valid, RTCScene scene, RTCRayHit4& query) {
    rtcIntersect4(valid, scene, &query);
}
void intersectPacket(const int* valid, RTCScene scene, RTCRayHit8& query) {
    rtcIntersect8(valid, scene, &query);
}
void intersectPacket(const int* valid, RTCScene scene, RTCRayHit16& query) {
    rtcIntersect16(valid, scene, &query);
}
void occludedOne(RTCScene scene, RTCRay& query) {
    rtcOccluded1(scene, &query);
}
#else
void intersectOne(RTCScene scene, RTCRayHit& query) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &query);
}
template <auto Intersect, typename Packet>
void intersectCoherent(const int* valid, RTCScene scene, Packet& query) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    Intersect(valid, scene, &context, &query);
}
void intersectPacket(const int* valid, RTCScene scene, RTCRayHit4& query) {
    intersectCoherent<rtcIntersect4>(valid, scene, query);
}
void intersectPacket(const int* valid, RTCScene scene, RTCRayHit8& query) {
    intersectCoherent<rtcIntersect8>(valid, scene, query);
}
void intersectPacket(const int* valid, RTCScene scene, RTCRayHit16& query) {
    intersectCoherent<rtcIntersect16>(valid, scene, query);
}
void occludedOne(RTCScene scene, RTCRay& query) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &query);
}
#endif

// A hit is on an edge if one of its barycentric weights is below this limit. The rounding errors of
// the weights grow with the distance of the hit. They are as large as this limit if the triangle is
// only a thousandth of the distance wide.
constexpr float kEdge = 4e-3F;

RTCRay embreeRay(const Ray& ray) {
    RTCRay out{};
    out.org_x = ray.origin.x();
    out.org_y = ray.origin.y();
    out.org_z = ray.origin.z();
    out.tnear = ray.least;
    out.dir_x = ray.direction.x();
    out.dir_y = ray.direction.y();
    out.dir_z = ray.direction.z();
    out.tfar = ray.most;
    out.mask = 0xFFFFFFFFU;
    return out;
}

template <typename Packet>
void setLane(Packet& query, std::size_t i, const Ray& ray) {
    query.ray.org_x[i] = ray.origin.x();
    query.ray.org_y[i] = ray.origin.y();
    query.ray.org_z[i] = ray.origin.z();
    query.ray.tnear[i] = ray.least;
    query.ray.dir_x[i] = ray.direction.x();
    query.ray.dir_y[i] = ray.direction.y();
    query.ray.dir_z[i] = ray.direction.z();
    query.ray.time[i] = 0;
    query.ray.tfar[i] = ray.most;
    query.ray.mask[i] = 0xFFFFFFFFU;
    query.ray.id[i] = 0;
    query.ray.flags[i] = 0;
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
}

/// True if the hit is on a triangle's edge. The adjacent triangle may be hit at the same distance.
/// Embree then returns the triangle that it tests first. A packet of rays may test the two
/// triangles in another order than a single ray.
bool onEdge(const RayHit& hit) {
    return hit.found() && !(std::min({hit.u, hit.v, 1 - hit.u - hit.v}) > kEdge);
}

std::size_t packetWidthOf(RTCDevice device) {
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0) return 16;
    return rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0 ? 8 : 4;
}

void rejectHoles(const RTCFilterFunctionNArguments* arguments) {
    const auto& holes = *static_cast<const HoleTest*>(arguments->geometryUserPtr);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        const unsigned n = arguments->N;
        if (holes.isHole(holes.context, RTCHitN_primID(arguments->hit, n, i),
                         RTCHitN_u(arguments->hit, n, i), RTCHitN_v(arguments->hit, n, i)))
            arguments->valid[i] = 0;
    }
}

void check(RTCDevice device, const char* what) {
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE)
        throw std::runtime_error(std::string("Embree: ") + what + " failed with error " +
                                 std::to_string(static_cast<int>(error)));
}

std::shared_ptr<RTCDeviceTy> newDevice(int buildThreads) {
    const std::string settings = "threads=" + std::to_string(buildThreads);
    RTCDevice device = rtcNewDevice(settings.c_str());
    if (device == nullptr) check(nullptr, "starting");
    if (device == nullptr) throw std::runtime_error("Embree: a device cannot be created");
    return {device, rtcReleaseDevice};
}

}  // namespace

void RayScene::Release::operator()(RTCSceneTy* scene) const {
    rtcReleaseScene(scene);
}

RayScene::RayScene(int buildThreads) : RayScene(newDevice(buildThreads)) {}

RayScene::RayScene(std::shared_ptr<RTCDeviceTy> device) : device_(std::move(device)) {
    scene_.reset(rtcNewScene(device_.get()));
    check(device_.get(), "creating a scene");
    packetWidth_ = packetWidthOf(device_.get());
    // Without this flag, rays can pass between triangles that share an edge.
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
}

std::uint32_t RayScene::add(std::span<const Eigen::Vector3f> positions,
                            std::span<const std::array<std::uint32_t, 3>> triangles,
                            const HoleTest& holes) {
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    // Embree reads past the end of the last vertex, so it must allocate the vertices itself.
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), positions.size()));
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            3 * sizeof(std::uint32_t), triangles.size());
    for (std::size_t i = 0; vertices != nullptr && i < positions.size(); ++i)
        std::copy_n(positions[i].data(), 3, vertices + 3 * i);
    if (indices != nullptr) std::memcpy(indices, triangles.data(), triangles.size_bytes());
    if (holes.isHole != nullptr) {
        holes_.push_back(std::make_unique<HoleTest>(holes));
        rtcSetGeometryUserData(geometry, holes_.back().get());
        rtcSetGeometryIntersectFilterFunction(geometry, rejectHoles);
        rtcSetGeometryOccludedFilterFunction(geometry, rejectHoles);
    }
    attach(geometry, meshes_);
    for (const auto& triangle : triangles)
        for (const std::uint32_t corner : triangle)
            box_.extend(positions[corner]);
    return meshes_++;
}

void RayScene::attach(RTCGeometryTy* geometry, std::uint32_t firstMesh) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_.get(), geometry, static_cast<unsigned>(firstMeshes_.size()));
    rtcReleaseGeometry(geometry);
    check(device_.get(), "adding a mesh");
    firstMeshes_.push_back(firstMesh);
}

std::uint32_t RayScene::place(const RayScene& part, const RigidTransform& T_scene_part) {
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, part.scene_.get());
    Eigen::Matrix<float, 3, 4, Eigen::RowMajor> T;
    T << T_scene_part.rotation.toRotationMatrix().cast<float>(),
        T_scene_part.translation.cast<float>();
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, T.data());
    const std::uint32_t first = meshes_;
    attach(geometry, first);
    meshes_ += part.meshes_;
    for (int i = 0; i < 8 && !part.box_.isEmpty(); ++i)
        box_.extend(
            T * part.box_.corner(static_cast<Eigen::AlignedBox3f::CornerType>(i)).homogeneous());
    return first;
}

std::uint32_t RayScene::meshOf(std::uint32_t instance, std::uint32_t geometry) const {
    return instance == RTC_INVALID_GEOMETRY_ID ? geometry : firstMeshes_[instance] + geometry;
}

void RayScene::commit() {
    rtcCommitScene(scene_.get());
    check(device_.get(), "building the search structure");
}

RayHit RayScene::first(const Ray& ray) const {
    RTCRayHit query;
    query.ray = embreeRay(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    intersectOne(scene_.get(), query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {query.ray.tfar, meshOf(query.hit.instID[0], query.hit.geomID), query.hit.primID,
            query.hit.u, query.hit.v};
}

bool RayScene::blocked(const Ray& ray) const {
    RTCRay query = embreeRay(ray);
    occludedOne(scene_.get(), query);
    return query.tfar < 0;
}

template <std::size_t Width, typename Packet>
void RayScene::intersectInPackets(std::span<const Ray> rays, std::span<RayHit> hits) const {
    for (std::size_t first = 0; first < rays.size(); first += Width) {
        const std::size_t count = std::min(Width, rays.size() - first);
        Packet query;
        alignas(Packet) std::array<int, Width> valid{};
        for (std::size_t i = 0; i < Width; ++i) {
            valid[i] = i < count ? -1 : 0;
            setLane(query, i, rays[first + std::min(i, count - 1)]);
        }
        intersectPacket(valid.data(), scene_.get(), query);
        for (std::size_t i = 0; i < count; ++i) {
            RayHit& hit = hits[first + i];
            hit = {};
            if (query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
            hit = {query.ray.tfar[i], meshOf(query.hit.instID[0][i], query.hit.geomID[i]),
                   query.hit.primID[i], query.hit.u[i], query.hit.v[i]};
        }
    }
}

void RayScene::firstOfEach(std::span<const Ray> rays, std::span<RayHit> hits) const {
    if (packetWidth_ == 16)
        intersectInPackets<16, RTCRayHit16>(rays, hits);
    else if (packetWidth_ == 8)
        intersectInPackets<8, RTCRayHit8>(rays, hits);
    else
        intersectInPackets<4, RTCRayHit4>(rays, hits);
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (onEdge(hits[i])) hits[i] = first(rays[i]);
}

}  // namespace mfar
