#include "pipeline/warp/silhouette_models.h"

#include "base/se3.h"
#include "pipeline/scene/scene_parts.h"
#include "pipeline/warp/warp_params.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace mfar {
namespace {

// If the lens distorts the picture, triangle edges are cut into pieces. The longest allowed piece
// is the diagonal of the model's largest mesh divided by kModelPieces, or the diagonal of the
// shadow catcher divided by kCatcherPieces. At a width of 640 px, straight pieces then differ from
// the distorted curves by less than a third of a pixel.
constexpr float kModelPieces = 16, kCatcherPieces = 32;
// A software renderer needs 0.2 us per triangle. If a scene has n > kMostTriangles triangles, each
// mesh keeps at most (its triangles) * kMostTriangles / n + kLeastTriangles of them.
constexpr double kMostTriangles = 20000;
constexpr std::size_t kLeastTriangles = 2000;
constexpr int kEdgePoints = 8;
constexpr int kBoundsMargin = 2;
constexpr double kFlat = 1e-4;  // largest distance of a planar catcher's corners from its plane [m]

bool isDistorted(const CameraModel& camera) {
    return std::ranges::any_of(camera.distortion, [](double k) { return k != 0; });
}

Eigen::AlignedBox3d boxOf(const SurfaceMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t corner : t) {
            const float* p = mesh.vertices[corner].position;
            box.extend(Eigen::Vector3d(p[0], p[1], p[2]));
        }
    return box;
}

float diagonalOf(std::span<const Eigen::Vector3f> positions) {
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& p : positions)
        if (p.allFinite()) box.extend(p);
    return box.isEmpty() ? 0 : box.diagonal().norm();
}

/// Returns (n, w) of the plane n . point = w through all corners. Zero if the catcher is empty or
/// not planar.
Eigen::Vector4d planeOf(const ShadowCatcher& catcher) {
    Eigen::Vector4d plane = Eigen::Vector4d::Zero();
    std::vector<Eigen::Vector3d> corners;
    double area = 0;
    for (const auto& t : catcher.triangles) {
        std::array<Eigen::Vector3d, 3> p;
        for (std::size_t i = 0; i < 3; ++i) {
            if (t[i] >= catcher.positions.size()) return Eigen::Vector4d::Zero();
            p[i] = catcher.positions[t[i]].cast<double>();
            corners.push_back(p[i]);
        }
        const Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
        if (!(normal.norm() > area)) continue;
        area = normal.norm();
        plane.head<3>() = normal / area;
        plane.w() = plane.head<3>().dot(p[0]);
    }
    const auto off = [&](const Eigen::Vector3d& p) {
        return std::abs(plane.head<3>().dot(p) - plane.w());
    };
    const bool flat = std::ranges::all_of(corners, [&](const auto& p) { return off(p) < kFlat; });
    return flat ? plane : Eigen::Vector4d::Zero();
}

double trianglesOf(const Scene& scene) {
    double sum = 1;
    for (const SceneObject& o : scene.objects)
        for (const Mesh& mesh : meshesOf(o))
            sum += static_cast<double>(mesh.triangles.size());
    return sum;
}

}  // namespace

SilhouetteModels::SilhouetteModels(const CameraModel& layer) : lens_(layer) {}

void SilhouetteModels::setScene(const Scene& scene) {
    const double share = std::min(1.0, kMostTriangles / trianglesOf(scene));
    using Key = std::pair<const Model*, int>;
    std::map<Key, std::shared_ptr<const Shape>> before, known;
    if (std::exchange(share_, share) == share)
        for (const Object& object : objects_)
            before.emplace(Key(object.shape->model.get(), object.shape->part), object.shape);
    objects_.clear();
    triangles_ = 0;
    for (const SceneObject& o : scene.objects) {
        const Key key(o.model.get(), o.part);
        std::shared_ptr<const Shape>& shape = known[key];
        if (!shape) {
            const auto kept = before.find(key);
            shape = kept != before.end() ? kept->second : shapeOf(o);
            for (const Part& part : shape->parts)
                triangles_ += part.mesh.triangles.size();
        }
        objects_.push_back({shape, o.T_world_object, o.scale});
    }
    setCatcher(scene.catcher);
}

void SilhouetteModels::setPoses(std::span<const RigidTransform> T_world_objects) {
    for (std::size_t i = 0; i < objects_.size(); ++i)
        objects_[i].T_world_object = T_world_objects[i];
}

std::shared_ptr<const SilhouetteModels::Shape>
SilhouetteModels::shapeOf(const SceneObject& object) const {
    const std::shared_ptr<const Model>& model = object.model;
    auto shape = std::make_shared<Shape>();
    shape->model = model;
    shape->part = object.part;
    const bool bent = isDistorted(lens_.camera);
    float diagonal = 0;
    for (const Mesh& mesh : meshesOf(object))
        diagonal = std::max(diagonal, diagonalOf(mesh.positions));
    for (const Mesh& mesh : meshesOf(object)) {
        const Material& material = model->materials.at(static_cast<std::size_t>(mesh.material));
        const float cutoff = material.alphaCutoff / std::max(material.baseColour.w(), 1e-6F);
        const auto texture = [&](int index) {
            return index < 0 || mesh.uvs.empty()
                       ? nullptr
                       : &model->textures.at(static_cast<std::size_t>(index));
        };
        const SurfaceTexture* baseColour = texture(material.baseColourTexture);
        const bool masked = material.alphaCutoff > 0 && baseColour != nullptr;
        if (!masked && cutoff > 1) continue;
        SurfaceMesh surface = surfaceMesh(mesh.positions, mesh.uvs, mesh.triangles,
                                          bent ? diagonal / kModelPieces : 0);
        if (share_ < 1)
            surface = simplified(
                std::move(surface),
                static_cast<std::size_t>(share_ * static_cast<double>(mesh.triangles.size())) +
                    kLeastTriangles);
        if (surface.triangles.empty()) continue;
        shape->box.extend(boxOf(surface));
        // Simplified models are drawn two-sided, because a simplified triangle can face away from
        // the viewer although the surface does not.
        shape->parts.push_back({std::move(surface), masked ? baseColour : nullptr, cutoff,
                                material.doubleSided || share_ < 1, &material, baseColour,
                                texture(material.metallicRoughnessTexture)});
    }
    return shape;
}

void SilhouetteModels::setCatcher(const ShadowCatcher& catcher) {
    catcher_.reset();
    plane_ = planeOf(catcher);
    if (plane_ != Eigen::Vector4d::Zero()) return;
    const bool bent = isDistorted(lens_.camera);
    SurfaceMesh surface = surfaceMesh(catcher.positions, {}, catcher.triangles,
                                      bent ? diagonalOf(catcher.positions) / kCatcherPieces : 0);
    if (surface.triangles.empty()) return;
    triangles_ += surface.triangles.size();
    auto shape = std::make_shared<Shape>();
    shape->box = boxOf(surface);
    shape->parts.push_back({.mesh = std::move(surface)});
    catcher_ = Object{std::move(shape), {}, 1};
}

PixelRect SilhouetteModels::boundsOf(const Object& object,
                                     const RigidTransform& T_camera_world) const {
    const Shape& shape = *object.shape;
    if (shape.box.isEmpty()) return {};
    const RigidTransform T_camera_object = T_camera_world * object.T_world_object;
    const Size size = lens_.camera.size;
    const PixelRect all{0, 0, size.width, size.height};
    Eigen::AlignedBox2d pixels;
    bool behind = false;
    for (int corner = 0; corner < 8; ++corner)
        for (int axis = 0; axis < 3; ++axis) {
            if ((corner >> axis & 1) != 0) continue;
            for (int i = 0; i <= kEdgePoints; ++i) {
                Eigen::Array3d share(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
                share[axis] = static_cast<double>(i) / kEdgePoints;
                const Eigen::Vector3d p =
                    shape.box.min().array() + share * shape.box.sizes().array();
                const Eigen::Vector3d h = lens_(T_camera_object * (object.scale * p));
                if (h.z() >= LensProjection::kNear)
                    pixels.extend(Eigen::Vector2d(h.hnormalized()));
                else
                    behind = true;
            }
        }
    if (pixels.isEmpty()) return {};
    return behind ? all : pixelsAround(pixels, kBoundsMargin, size);
}

PixelRect SilhouetteModels::bounds(const RigidTransform& T_world_camera) const {
    PixelRect out;
    if (!isFinite(T_world_camera)) return out;
    const RigidTransform T_camera_world = T_world_camera.inverse();
    for (const Object& object : objects_)
        out = around(out, boundsOf(object, T_camera_world));
    return out;
}

}  // namespace mfar
