#include "pipeline/warp/model_silhouette.h"

#include "base/gl/scoped_state.h"
#include "base/se3.h"
#include "pipeline/render/rendered_picture.h"
#include "pipeline/warp/surface_mesh.h"
#include "pipeline/warp/warp_params.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace mfar {
namespace {

// Pieces along the diagonal of a model, and of the catcher, which may be far larger than what is
// seen of it: at 640 px their edges are within a third of a pixel of the lens's curves.
constexpr float kModelPieces = 16, kCatcherPieces = 32;
// A triangle costs a software renderer 0.2 us: what a scene has beyond is simplified, each mesh in
// proportion, but for so many.
constexpr double kMostTriangles = 20000;
constexpr std::size_t kLeastTriangles = 2000;
constexpr int kEdgePoints = 8;    // of a box, along each edge
constexpr int kBoundsMargin = 2;  // [px]
constexpr double kFlat =
    1e-4;  // [m]: corners of a catcher that are that close to a plane are in it

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

gpu::Texture alphaOf(const SurfaceTexture& texture) {
    std::vector<std::uint8_t> alpha;
    alpha.reserve(texture.texels.size());
    for (const auto& texel : texture.texels)
        alpha.push_back(texel[3]);
    gpu::Texture out(texture.size, gpu::TexelFormat::R8);
    out.upload({alpha.data(), static_cast<std::size_t>(texture.size.width)});
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTexParameteri(GL_TEXTURE_2D, axis, GL_REPEAT);
    return out;
}

/// n . point = w for all triangles' corners; zero if they are in no plane, or there are none.
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
        for (const Mesh& mesh : o.model->meshes)
            sum += static_cast<double>(mesh.triangles.size());
    return sum;
}

/// In pixels of the target.
PixelRect doubled(const PixelRect& r) {
    return {2 * r.x0, 2 * r.y0, 2 * r.x1, 2 * r.y1};
}

/// Leaves out what faces away: clockwise in a picture whose first row is the lowest to GL.
class FrontFaces {
public:
    FrontFaces() {
        glEnable(GL_CULL_FACE);
        glFrontFace(GL_CW);
    }
    FrontFaces(const FrontFaces&) = delete;
    FrontFaces& operator=(const FrontFaces&) = delete;
    ~FrontFaces() {
        glDisable(GL_CULL_FACE);
        glFrontFace(GL_CCW);
    }
};

/// Objects before, the catcher behind all of them.
class DepthRange {
public:
    DepthRange(float nearest, float farthest) { glDepthRangef(nearest, farthest); }
    DepthRange(const DepthRange&) = delete;
    DepthRange& operator=(const DepthRange&) = delete;
    ~DepthRange() { glDepthRangef(0, 1); }
};

}  // namespace

ModelSilhouette::ModelSilhouette(const CameraModel& layer)
    : lens_(layer),
      surface_({2 * layer.size.width, 2 * layer.size.height}, gpu::TexelFormat::R32Ui),
      window_(surface_.size(), gpu::TexelFormat::Depth24),
      target_(std::array<const gpu::Texture*, 1>{&surface_}, &window_),
      pass_("warp_silhouette.vert", "warp_silhouette.frag", ""),
      maskedPass_("warp_silhouette.vert", "warp_silhouette.frag", "#define ALPHA_MASK\n") {
    target_.bind();
    clear({0, 0, layer.size.width, layer.size.height});
}

void ModelSilhouette::setScene(const Scene& scene) {
    const double share = std::min(1.0, kMostTriangles / trianglesOf(scene));
    std::deque<Shape> before = std::exchange(shapes_, {});
    if (std::exchange(share_, share) != share) before.clear();
    objects_.clear();
    catcher_.reset();
    triangles_ = 0;
    std::map<const Model*, std::size_t> known;
    for (const SceneObject& o : scene.objects) {
        const auto [at, isNew] = known.try_emplace(o.model.get(), shapes_.size());
        objects_.push_back({at->second, o.T_world_object, o.scale});
        if (!isNew) continue;
        const auto kept = std::ranges::find(before, o.model, &Shape::model);
        shapes_.push_back(kept != before.end() ? std::move(*kept) : shapeOf(o.model));
        for (const Part& part : shapes_.back().parts)
            triangles_ += static_cast<std::size_t>(part.indexCount) / 3;
    }
    addCatcher(scene.catcher);
}

ModelSilhouette::Part ModelSilhouette::partOf(const SurfaceMesh& mesh) {
    Part part{gpu::Buffer(mesh.vertices.size() * sizeof(mesh.vertices[0])),
              gpu::Buffer(mesh.triangles.size() * sizeof(mesh.triangles[0])),
              static_cast<int>(3 * mesh.triangles.size()),
              {},
              0};
    part.vertices.write(std::span<const gpu::MeshVertex>(mesh.vertices));
    part.indices.write(std::span(mesh.triangles));
    return part;
}

ModelSilhouette::Shape ModelSilhouette::shapeOf(const std::shared_ptr<const Model>& model) const {
    Shape shape{{}, {}, model};
    const bool bent = isDistorted(lens_.camera);
    float diagonal = 0;
    for (const Mesh& mesh : model->meshes)
        diagonal = std::max(diagonal, diagonalOf(mesh.positions));
    for (const Mesh& mesh : model->meshes) {
        const Material& material = model->materials.at(static_cast<std::size_t>(mesh.material));
        const float cutoff = material.alphaCutoff / std::max(material.baseColour.w(), 1e-6F);
        const bool masked =
            material.alphaCutoff > 0 && material.baseColourTexture >= 0 && !mesh.uvs.empty();
        if (!masked && cutoff > 1) continue;  // the factor alone makes a hole of it
        SurfaceMesh surface = surfaceMesh(mesh.positions, mesh.uvs, mesh.triangles,
                                          bent ? diagonal / kModelPieces : 0);
        if (share_ < 1)
            surface = simplified(
                std::move(surface),
                static_cast<std::size_t>(share_ * static_cast<double>(mesh.triangles.size())) +
                    kLeastTriangles);
        if (surface.triangles.empty()) continue;
        Part part = partOf(surface);
        part.cutoff = cutoff;
        // Simplified, a triangle may face another way than the surface does.
        part.bothSides = material.doubleSided || share_ < 1;
        if (masked)
            part.alpha =
                alphaOf(model->textures.at(static_cast<std::size_t>(material.baseColourTexture)));
        shape.box.extend(boxOf(surface));
        shape.parts.push_back(std::move(part));
    }
    return shape;
}

void ModelSilhouette::addCatcher(const ShadowCatcher& catcher) {
    plane_ = planeOf(catcher);
    if (plane_ != Eigen::Vector4d::Zero()) return;
    const bool bent = isDistorted(lens_.camera);
    const SurfaceMesh surface =
        surfaceMesh(catcher.positions, {}, catcher.triangles,
                    bent ? diagonalOf(catcher.positions) / kCatcherPieces : 0);
    if (surface.triangles.empty()) return;
    triangles_ += surface.triangles.size();
    Shape shape{{}, boxOf(surface), {}};
    shape.parts.push_back(partOf(surface));
    catcher_ = Object{shapes_.size(), {}, 1};
    shapes_.push_back(std::move(shape));
}

PixelRect ModelSilhouette::boundsOf(const Object& object,
                                    const RigidTransform& T_camera_world) const {
    const Shape& shape = shapes_[object.shape];
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

PixelRect ModelSilhouette::bounds(const RigidTransform& T_world_camera) const {
    PixelRect out;
    if (!isFinite(T_world_camera)) return out;
    const RigidTransform T_camera_world = T_world_camera.inverse();
    for (const Object& object : objects_)
        out = around(out, boundsOf(object, T_camera_world));
    return out;
}

void ModelSilhouette::drawObject(const Object& object, std::size_t number,
                                 const RigidTransform& T_camera_world) {
    params::SilhouetteMesh p{.object =
                                 transformOf(T_camera_world * object.T_world_object, object.scale),
                             .layer = projectionOf(lens_),
                             .width = static_cast<float>(lens_.camera.size.width),
                             .height = static_cast<float>(lens_.camera.size.height),
                             .number = static_cast<float>(number),
                             .cutoff = 0};
    for (const Part& part : shapes_[object.shape].parts) {
        p.cutoff = part.cutoff;
        std::optional<FrontFaces> front;
        if (!part.bothSides) front.emplace();
        const gpu::Mesh mesh{part.vertices, part.indices, part.indexCount};
        if (part.alpha)
            maskedPass_.runMesh(p, {gpu::sampler(0, *part.alpha)}, target_, mesh);
        else
            pass_.runMesh(p, {}, target_, mesh);
    }
}

void ModelSilhouette::clear(const PixelRect& where) const {
    constexpr std::array<GLuint, 4> kNothing{};
    constexpr float kFarthest = 1;
    const gpu::Scissor scissor(doubled(where));
    glClearBufferuiv(GL_COLOR, 0, kNothing.data());
    glClearBufferfv(GL_DEPTH, 0, &kFarthest);
}

void ModelSilhouette::draw(const RigidTransform& T_world_camera, const PixelRect& where) {
    target_.bind();
    if (!drawn_.empty()) clear(drawn_);
    drawn_ = catcher_ ? where : common(where, bounds(T_world_camera));
    if (drawn_.empty() || !isFinite(T_world_camera)) return;
    const RigidTransform T_camera_world = T_world_camera.inverse();
    const gpu::Scissor scissor(doubled(drawn_));
    const gpu::DepthTest depthTest;
    {
        const DepthRange before(0, 0.5F);
        for (std::size_t i = 0; i < objects_.size(); ++i)
            if (!common(boundsOf(objects_[i], T_camera_world), where).empty())
                drawObject(objects_[i], i + 1, T_camera_world);
    }
    const DepthRange behind(0.5F, 1);
    if (catcher_) drawObject(*catcher_, kCatcherId, T_camera_world);
}

}  // namespace mfar
