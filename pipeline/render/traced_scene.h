#pragma once

#include "pipeline/render/paint.h"
#include "pipeline/render/ray_scene.h"
#include "pipeline/render/surface_scatter.h"
#include "pipeline/scene/scene.h"

#include <memory>
#include <optional>
#include <vector>

namespace mfar {

/// A point of a surface, seen from one side. Normals have unit length and point to the viewer.
struct SurfacePoint {
    Eigen::Vector3f position{0, 0, 0};
    Eigen::Vector3f geometric{0, 0, 1};
    Eigen::Vector3f shading{0, 0, 1};
    SurfaceLook look;
    Eigen::Vector3f emission{0, 0, 0};
    bool emits = false;  ///< true if the material emits light, at this point or elsewhere

    /// `direction` is the viewing direction; it may have any length.
    [[nodiscard]] Paint paint(const Eigen::Vector3f& direction) const;
    /// Returns a ray from the point in `direction`. It starts at a small distance from the surface,
    /// so that rounding errors cannot make it hit this surface.
    [[nodiscard]] Ray leaving(const Eigen::Vector3f& direction) const;
};

/// A scene in world coordinates, with a search structure for ray hits. The scene must be valid (see
/// scene_check.h).
class TracedScene {
public:
    /// Throws std::runtime_error if the search structure cannot be built.
    TracedScene(std::shared_ptr<const Scene> scene, int buildThreads);
    /// Creates the scene of `other` with other poses of its moving objects. It takes little time.
    TracedScene(const TracedScene& other, std::shared_ptr<const Scene> posed);
    TracedScene(const TracedScene&) = delete;
    TracedScene& operator=(const TracedScene&) = delete;

    [[nodiscard]] const Scene& scene() const { return *scene_; }
    [[nodiscard]] const RayScene& objects() const { return objects_; }
    [[nodiscard]] const RayScene& catcher() const { return *catcher_; }

    /// Returns the ray's first hit, leaving out hits on the backs of single-sided surfaces. `hit`
    /// must be the ray's first hit on any surface, backs included.
    [[nodiscard]] RayHit shown(const Ray& ray, RayHit hit) const;
    [[nodiscard]] std::uint8_t idOf(const RayHit& hit) const { return meshes_[hit.mesh]->id; }

    /// Numbers of meshes in objects(), and of triangles in a mesh. Indices are those of RayHit.
    [[nodiscard]] std::uint32_t meshes() const {
        return static_cast<std::uint32_t>(meshes_.size());
    }
    [[nodiscard]] std::uint32_t triangles(std::uint32_t mesh) const {
        return static_cast<std::uint32_t>(meshes_[mesh]->mesh->triangles.size());
    }
    [[nodiscard]] std::array<Eigen::Vector3f, 3> corners(std::uint32_t mesh,
                                                         std::uint32_t triangle) const;
    /// False if no point of the mesh emits light.
    [[nodiscard]] bool emits(std::uint32_t mesh) const { return meshes_[mesh]->material().emits(); }
    /// True if only the fronts of the mesh's triangles emit light.
    [[nodiscard]] bool isSingleSided(std::uint32_t mesh) const {
        return !meshes_[mesh]->material().doubleSided;
    }
    /// Radiance that the hit point emits from its front, and from its back unless the material is
    /// single-sided.
    [[nodiscard]] Eigen::Vector3f emission(const RayHit& hit) const {
        return emissionAt(*meshes_[hit.mesh], hit);
    }
    /// The triangle's area in texels of the emission texture, 0 without a texture.
    [[nodiscard]] float emissionTexels(std::uint32_t mesh, std::uint32_t triangle) const;

    /// True if the normal turns by at most 0.1 rad over a distance of `width` [m] on the triangle.
    /// False if the material has a normal map.
    [[nodiscard]] bool isEven(const RayHit& hit, float width) const;
    [[nodiscard]] SurfacePoint objectPoint(const RayHit& hit,
                                           const Eigen::Vector3f& direction) const;
    [[nodiscard]] SurfacePoint catcherPoint(const RayHit& hit,
                                            const Eigen::Vector3f& direction) const;

private:
    struct TracedMesh {
        const Mesh* mesh = nullptr;
        const Model* model = nullptr;
        std::uint8_t id = 0;
        std::vector<Eigen::Vector3f> positions;
        Eigen::Matrix3f R_world_object = Eigen::Matrix3f::Identity();

        [[nodiscard]] const Material& material() const {
            return model->materials[static_cast<std::size_t>(mesh->material)];
        }
        [[nodiscard]] const SurfaceTexture* texture(int index) const {
            return index < 0 || mesh->uvs.empty()
                       ? nullptr
                       : &model->textures[static_cast<std::size_t>(index)];
        }
    };

    using MeshList = std::vector<std::shared_ptr<const TracedMesh>>;
    /// Meshes that do not move relative to each other, with a search structure that need not be
    /// built again when objects move. If the meshes move, `object` is the index of their object in
    /// Scene::objects, and they are in this object's coordinates.
    struct Part {
        std::optional<std::size_t> object;
        RayScene rays;
        MeshList meshes;
    };
    static std::shared_ptr<const TracedMesh> meshOf(const SceneObject& object, const Mesh& mesh,
                                                    const RigidTransform& T, std::uint8_t id);
    static void add(const SceneObject& object, const RigidTransform& T, std::uint8_t id,
                    RayScene& rays, MeshList& meshes);
    void addParts();
    void place(const Part& part);
    static bool isHole(const void* mesh, std::uint32_t triangle, float u, float v);
    /// True if the ray hits the back of a single-sided surface.
    static bool isOnBack(const TracedMesh& mesh, const RayHit& hit,
                         const Eigen::Vector3f& direction);
    static Eigen::Vector2f textureAt(const TracedMesh& mesh, const RayHit& hit);
    static Eigen::Vector3f emissionAt(const TracedMesh& mesh, const RayHit& hit);
    static void setLook(const TracedMesh& mesh, const RayHit& hit, SurfacePoint& point);
    static Eigen::Vector3f shadingNormal(const TracedMesh& mesh, const RayHit& hit,
                                         const Eigen::Vector3f& ofTriangle);
    static Eigen::Vector3f mapped(const TracedMesh& mesh, const RayHit& hit,
                                  const Eigen::Vector3f& normal);

    std::shared_ptr<const Scene> scene_;
    // The meshes' addresses must not change, because HoleTest::context points to them.
    MeshList meshes_;
    std::vector<std::shared_ptr<const Part>> parts_;  // empty if nothing moves
    RayScene objects_;
    std::shared_ptr<const RayScene> catcher_;
};

}  // namespace mfar
