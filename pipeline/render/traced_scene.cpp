#include "pipeline/render/traced_scene.h"

#include "pipeline/render/texture_lookup.h"
#include "pipeline/scene/scene_parts.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

// Distance of a ray's start from its surface, so that the ray does not hit the same surface.
// kStartOffset is relative to the largest coordinate: 32 to 64 units in its last place.
// kLeastOffset [m] is the lower limit.
constexpr float kStartOffset = 0x1p-18F;
constexpr float kLeastOffset = 1e-7F;
// After a hit on an invisible back face, the search continues behind the hit, at the hit's distance
// times (1 + kStepOver).
constexpr float kStepOver = 1e-6F;
constexpr int kMostBackFaces = 64;
// Lower limit of the cosine between shading normal and viewing direction. Normals that point away
// from the viewer are turned up to this limit.
constexpr float kLeastShown = 1e-3F;

template <typename T>
T interpolated(const std::vector<T>& values, const std::array<std::uint32_t, 3>& corners,
               const RayHit& hit) {
    return values[corners[0]] * (1 - hit.u - hit.v) + values[corners[1]] * hit.u +
           values[corners[2]] * hit.v;
}

/// Returns a vector along the triangle's normal. Its length is twice the triangle's area.
Eigen::Vector3f crossed(const std::vector<Eigen::Vector3f>& positions,
                        const std::array<std::uint32_t, 3>& corners) {
    const Eigen::Vector3f& a = positions[corners[0]];
    return (positions[corners[1]] - a).cross(positions[corners[2]] - a);
}

Eigen::Vector3f unitOr(const Eigen::Vector3f& v, const Eigen::Vector3f& otherwise) {
    float n = v.norm();
    if (!(n > 1e-15F && n < 1e15F)) n = v.stableNorm();
    return n > 0 && std::isfinite(n) ? Eigen::Vector3f(v / n) : otherwise;
}

Eigen::Vector3f shownTowards(const Eigen::Vector3f& normal, const Eigen::Vector3f& wo) {
    const float cosine = normal.dot(wo);
    if (cosine >= kLeastShown) return normal;
    return unitOr(normal + (kLeastShown - cosine) * wo, wo);
}

}  // namespace

Paint SurfacePoint::paint(const Eigen::Vector3f& direction) const {
    const float cosine = std::clamp(-shading.dot(direction.normalized()), 0.0F, 1.0F);
    return paintOf(look.baseColour, look.metallic, specularAlbedo(look.roughness, cosine), emits);
}

Ray SurfacePoint::leaving(const Eigen::Vector3f& direction) const {
    const float offset = std::max(kStartOffset * position.cwiseAbs().maxCoeff(), kLeastOffset);
    return {position + geometric * (geometric.dot(direction) < 0 ? -offset : offset), direction};
}

TracedScene::TracedScene(std::shared_ptr<const Scene> scene, int buildThreads)
    : scene_(std::move(scene)), objects_(buildThreads) {
    if (moves(*scene_))
        addParts();
    else
        for (std::size_t i = 0; i < scene_->objects.size(); ++i)
            add(scene_->objects[i], scene_->objects[i].T_world_object,
                static_cast<std::uint8_t>(i + 1), objects_, meshes_);
    objects_.commit();
    auto catcher = std::make_shared<RayScene>(buildThreads);
    if (!scene_->catcher.triangles.empty())
        catcher->add(scene_->catcher.positions, scene_->catcher.triangles);
    catcher->commit();
    catcher_ = std::move(catcher);
}

TracedScene::TracedScene(const TracedScene& other, std::shared_ptr<const Scene> posed)
    : scene_(std::move(posed)), parts_(other.parts_), objects_(RayScene::beside(other.objects_)),
      catcher_(other.catcher_) {
    for (const std::shared_ptr<const Part>& part : parts_)
        place(*part);
    objects_.commit();
}

std::shared_ptr<const TracedScene::TracedMesh> TracedScene::meshOf(const SceneObject& object,
                                                                   const Mesh& mesh,
                                                                   const RigidTransform& T,
                                                                   std::uint8_t id) {
    auto traced = std::make_shared<TracedMesh>();
    traced->mesh = &mesh;
    traced->model = object.model.get();
    traced->id = id;
    traced->R_world_object = T.rotation.toRotationMatrix().cast<float>();
    traced->positions.reserve(mesh.positions.size());
    for (const Eigen::Vector3f& p : mesh.positions)
        traced->positions.push_back((T * (object.scale * p.cast<double>())).cast<float>());
    return traced;
}

void TracedScene::add(const SceneObject& object, const RigidTransform& T, std::uint8_t id,
                      RayScene& rays, MeshList& meshes) {
    for (const Mesh& mesh : meshesOf(object)) {
        if (mesh.triangles.empty()) continue;
        std::shared_ptr<const TracedMesh> traced = meshOf(object, mesh, T, id);
        HoleTest holes;
        if (traced->material().alphaCutoff > 0) holes = {isHole, traced.get()};
        rays.add(traced->positions, mesh.triangles, holes);
        meshes.push_back(std::move(traced));
    }
}

void TracedScene::addParts() {
    const auto newPart = [&] {
        return std::make_shared<Part>(Part{{}, RayScene::beside(objects_), {}});
    };
    const std::shared_ptr<Part> still = newPart();
    parts_.push_back(still);
    for (std::size_t i = 0; i < scene_->objects.size(); ++i) {
        const SceneObject& object = scene_->objects[i];
        const auto id = static_cast<std::uint8_t>(i + 1);
        if (!object.path) {
            add(object, object.T_world_object, id, still->rays, still->meshes);
            continue;
        }
        const std::shared_ptr<Part> part = newPart();
        part->object = i;
        add(object, {}, id, part->rays, part->meshes);
        part->rays.commit();
        parts_.push_back(part);
    }
    still->rays.commit();
    for (const std::shared_ptr<const Part>& part : parts_)
        place(*part);
}

void TracedScene::place(const Part& part) {
    if (part.meshes.empty()) return;
    if (!part.object) {
        objects_.place(part.rays, {});
        meshes_ = part.meshes;
        return;
    }
    const SceneObject& object = scene_->objects[*part.object];
    objects_.place(part.rays, object.T_world_object);
    for (const std::shared_ptr<const TracedMesh>& mesh : part.meshes)
        meshes_.push_back(meshOf(object, *mesh->mesh, object.T_world_object, mesh->id));
}

Eigen::Vector2f TracedScene::textureAt(const TracedMesh& mesh, const RayHit& hit) {
    if (mesh.mesh->uvs.empty()) return {0, 0};
    return interpolated(mesh.mesh->uvs, mesh.mesh->triangles[hit.triangle], hit);
}

bool TracedScene::isHole(const void* mesh, std::uint32_t triangle, float u, float v) {
    const auto& traced = *static_cast<const TracedMesh*>(mesh);
    const Material& material = traced.material();
    float alpha = material.baseColour.w();
    if (const SurfaceTexture* texture = traced.texture(material.baseColourTexture))
        alpha *= lookUp(*texture, textureAt(traced, {0, 0, triangle, u, v})).w();
    return alpha < material.alphaCutoff;
}

bool TracedScene::isOnBack(const TracedMesh& mesh, const RayHit& hit,
                           const Eigen::Vector3f& direction) {
    return !mesh.material().doubleSided &&
           crossed(mesh.positions, mesh.mesh->triangles[hit.triangle]).dot(direction) > 0;
}

RayHit TracedScene::shown(const Ray& ray, RayHit hit) const {
    Ray rest = ray;
    for (int i = 0; hit.found(); ++i) {
        if (!isOnBack(*meshes_[hit.mesh], hit, ray.direction)) return hit;
        if (i == kMostBackFaces) return {};
        rest.least = hit.t * (1 + kStepOver);
        hit = objects_.first(rest);
    }
    return hit;
}

std::array<Eigen::Vector3f, 3> TracedScene::corners(std::uint32_t mesh,
                                                    std::uint32_t triangle) const {
    const TracedMesh& m = *meshes_[mesh];
    const auto& corners = m.mesh->triangles[triangle];
    return {m.positions[corners[0]], m.positions[corners[1]], m.positions[corners[2]]};
}

float TracedScene::emissionTexels(std::uint32_t mesh, std::uint32_t triangle) const {
    const TracedMesh& m = *meshes_[mesh];
    const SurfaceTexture* texture = m.texture(m.material().emissionTexture);
    if (texture == nullptr) return 0;
    const auto& corners = m.mesh->triangles[triangle];
    const Eigen::Vector2f a = m.mesh->uvs[corners[0]];
    const Eigen::Vector2f b = m.mesh->uvs[corners[1]] - a, c = m.mesh->uvs[corners[2]] - a;
    return 0.5F * std::abs(b.x() * c.y() - b.y() * c.x()) *
           static_cast<float>(texture->size.width) * static_cast<float>(texture->size.height);
}

Eigen::Vector3f TracedScene::emissionAt(const TracedMesh& mesh, const RayHit& hit) {
    const Material& m = mesh.material();
    const SurfaceTexture* texture = mesh.texture(m.emissionTexture);
    if (texture == nullptr) return m.emission;
    return m.emission.cwiseProduct(lookUp(*texture, textureAt(mesh, hit)).head<3>());
}

void TracedScene::setLook(const TracedMesh& mesh, const RayHit& hit, SurfacePoint& point) {
    const Material& m = mesh.material();
    const Eigen::Vector2f uv = textureAt(mesh, hit);
    point.look = {m.baseColour.head<3>(), m.metallic, m.roughness};
    point.emission = emissionAt(mesh, hit);
    point.emits = m.emits();
    if (const SurfaceTexture* t = mesh.texture(m.baseColourTexture))
        point.look.baseColour = point.look.baseColour.cwiseProduct(lookUp(*t, uv).head<3>());
    if (const SurfaceTexture* t = mesh.texture(m.metallicRoughnessTexture)) {
        const Eigen::Vector4f data = lookUp(*t, uv);
        point.look.roughness *= data.y();
        point.look.metallic *= data.z();
    }
    point.look.baseColour = point.look.baseColour.cwiseMin(1.0F);
}

Eigen::Vector3f TracedScene::mapped(const TracedMesh& mesh, const RayHit& hit,
                                    const Eigen::Vector3f& normal) {
    const Material& m = mesh.material();
    const SurfaceTexture* map = mesh.texture(m.normalTexture);
    if (map == nullptr) return normal;
    const auto& corners = mesh.mesh->triangles[hit.triangle];
    Eigen::Vector3f tangent;
    float sign = 1;
    if (!mesh.mesh->tangents.empty()) {
        const Eigen::Vector4f t = interpolated(mesh.mesh->tangents, corners, hit);
        tangent = mesh.R_world_object * t.head<3>();
        sign = t.w() < 0 ? -1.0F : 1.0F;
    } else {
        const Eigen::Vector2f a = mesh.mesh->uvs[corners[0]];
        const Eigen::Vector2f b = mesh.mesh->uvs[corners[1]] - a,
                              c = mesh.mesh->uvs[corners[2]] - a;
        const Eigen::Vector3f& p = mesh.positions[corners[0]];
        const float area = b.x() * c.y() - b.y() * c.x();
        tangent =
            (mesh.positions[corners[1]] - p) * c.y() - (mesh.positions[corners[2]] - p) * b.y();
        if (area < 0) tangent = -tangent;
        // Green points up in a normal map, but the texture coordinate v points down.
        sign = area < 0 ? 1.0F : -1.0F;
    }
    tangent = unitOr(tangent - normal * normal.dot(tangent), Eigen::Vector3f::Zero());
    if (tangent.isZero()) return normal;
    const Eigen::Vector3f bitangent = sign * normal.cross(tangent);
    const Eigen::Vector4f texel = lookUp(*map, textureAt(mesh, hit));
    const float x = (2 * texel.x() - 1) * m.normalScale, y = (2 * texel.y() - 1) * m.normalScale;
    return unitOr(tangent * x + bitangent * y + normal * (2 * texel.z() - 1), normal);
}

Eigen::Vector3f TracedScene::shadingNormal(const TracedMesh& mesh, const RayHit& hit,
                                           const Eigen::Vector3f& ofTriangle) {
    Eigen::Vector3f normal = ofTriangle;
    if (!mesh.mesh->normals.empty()) {
        const auto& corners = mesh.mesh->triangles[hit.triangle];
        normal = unitOr(mesh.R_world_object * interpolated(mesh.mesh->normals, corners, hit),
                        ofTriangle);
    }
    return mapped(mesh, hit, normal);
}

bool TracedScene::isEven(const RayHit& hit, float width) const {
    constexpr float kTurn = 0.1F;
    const TracedMesh& mesh = *meshes_[hit.mesh];
    if (mesh.texture(mesh.material().normalTexture) != nullptr) return false;
    if (mesh.mesh->normals.empty()) return true;
    const auto& corners = mesh.mesh->triangles[hit.triangle];
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = corners[i], b = corners[(i + 1) % 3];
        const float turn = (mesh.mesh->normals[a] - mesh.mesh->normals[b]).norm();
        if (turn * width > kTurn * (mesh.positions[a] - mesh.positions[b]).norm()) return false;
    }
    return true;
}

SurfacePoint TracedScene::objectPoint(const RayHit& hit, const Eigen::Vector3f& direction) const {
    const TracedMesh& mesh = *meshes_[hit.mesh];
    const auto& corners = mesh.mesh->triangles[hit.triangle];
    const Eigen::Vector3f wo = -direction.normalized();
    const Eigen::Vector3f front = unitOr(crossed(mesh.positions, corners), wo);
    const float side = front.dot(wo) < 0 ? -1.0F : 1.0F;
    SurfacePoint out;
    out.position = interpolated(mesh.positions, corners, hit);
    out.geometric = side * front;
    out.shading = shownTowards(side * shadingNormal(mesh, hit, front), wo);
    setLook(mesh, hit, out);
    if (isOnBack(mesh, hit, direction)) out.emission.setZero();
    return out;
}

SurfacePoint TracedScene::catcherPoint(const RayHit& hit, const Eigen::Vector3f& direction) const {
    const ShadowCatcher& catcher = scene_->catcher;
    const auto& corners = catcher.triangles[hit.triangle];
    const Eigen::Vector3f wo = -direction.normalized();
    const Eigen::Vector3f front = unitOr(crossed(catcher.positions, corners), wo);
    SurfacePoint out;
    out.position = interpolated(catcher.positions, corners, hit);
    out.geometric = front.dot(wo) < 0 ? Eigen::Vector3f(-front) : front;
    out.shading = out.geometric;
    out.look.baseColour = catcher.albedo;
    out.look.matt = true;
    return out;
}

}  // namespace mfar
