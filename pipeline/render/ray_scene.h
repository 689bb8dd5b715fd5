#pragma once

#include "base/geometry.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

struct RTCDeviceTy;
struct RTCSceneTy;
struct RTCGeometryTy;

namespace mfar {

/// The points origin + t * direction with least <= t <= most. `direction` may have any length.
struct Ray {
    Eigen::Vector3f origin, direction;
    float least = 0, most = std::numeric_limits<float>::infinity();
};

struct RayHit {
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    float t = std::numeric_limits<float>::infinity();
    /// `mesh` is the mesh's index in the RayScene, see add() and place(). `triangle` is an index in
    /// this mesh.
    std::uint32_t mesh = kNone, triangle = 0;
    float u = 0, v = 0;  ///< weights of the second and third corners

    [[nodiscard]] bool found() const { return mesh != kNone; }
};

/// isHole() must return true for each point of a triangle at which rays pass through the triangle.
/// Any thread may call it.
struct HoleTest {
    bool (*isHole)(const void* context, std::uint32_t triangle, float u, float v) = nullptr;
    const void* context = nullptr;  ///< argument of isHole(); must outlive the RayScene
};

/// Triangle meshes in a common coordinate frame. Embree finds the hits of rays on them. After
/// commit(), several threads may call const functions at the same time.
class RayScene {
public:
    /// Throws std::runtime_error if Embree is unavailable. `buildThreads` must be at least 1.
    explicit RayScene(int buildThreads = 1);
    /// Creates an empty scene on the same Embree device as `other`, so that place() can put one of
    /// the two scenes into the other.
    [[nodiscard]] static RayScene beside(const RayScene& other) { return RayScene(other.device_); }

    /// Copies the mesh and returns its index. Coordinates must be finite and indices in range.
    std::uint32_t add(std::span<const Eigen::Vector3f> positions,
                      std::span<const std::array<std::uint32_t, 3>> triangles,
                      const HoleTest& holes = {});
    /// Adds all meshes of `part`, another scene, at a pose. Returns the index of the first of these
    /// meshes. `part` must be committed; its search structure is used as it is and not built again.
    /// `part` must not itself contain placed parts, and must have the same Embree device, see
    /// beside(). After place(), add() must not be called any more.
    std::uint32_t place(const RayScene& part, const RigidTransform& T_scene_part);
    void commit();

    [[nodiscard]] bool empty() const { return meshes_ == 0; }
    [[nodiscard]] const Eigen::AlignedBox3f& box() const { return box_; }

    [[nodiscard]] RayHit first(const Ray& ray) const;
    [[nodiscard]] bool blocked(const Ray& ray) const;
    /// Returns the same hits as first() for each ray, bit for bit. If the rays are similar, it is
    /// faster than first(). `hits` must be as long as `rays`.
    void firstOfEach(std::span<const Ray> rays, std::span<RayHit> hits) const;

private:
    struct Release {
        void operator()(RTCSceneTy* scene) const;
    };

    explicit RayScene(std::shared_ptr<RTCDeviceTy> device);
    void attach(RTCGeometryTy* geometry, std::uint32_t firstMesh);
    /// `instance` is Embree's number of the placed part, or RTC_INVALID_GEOMETRY_ID for a mesh that
    /// add() added.
    [[nodiscard]] std::uint32_t meshOf(std::uint32_t instance, std::uint32_t geometry) const;
    template <std::size_t Width, typename Packet>
    void intersectInPackets(std::span<const Ray> rays, std::span<RayHit> hits) const;

    std::shared_ptr<RTCDeviceTy> device_;
    std::unique_ptr<RTCSceneTy, Release> scene_;
    std::vector<std::unique_ptr<HoleTest>> holes_;
    std::size_t packetWidth_ = 4;
    std::uint32_t meshes_ = 0;
    // Index of the first mesh of each geometry in scene_.
    std::vector<std::uint32_t> firstMeshes_;
    Eigen::AlignedBox3f box_;
};

}  // namespace mfar
