#include "pipeline/gles/model_silhouette.h"

#include "base/gl/scoped_state.h"
#include "base/se3.h"
#include "pipeline/render/rendered_picture.h"
#include "pipeline/warp/warp_params.h"

#include <algorithm>
#include <array>
#include <utility>

namespace mfar {
namespace {

/// Returns the alpha of each texel, or of fewer texels if the GPU's textures are smaller.
gpu::Texture alphaOf(const SurfaceTexture& texture) {
    const int most = gpu::largestTexture();
    const Size from = texture.size, to{std::min(from.width, most), std::min(from.height, most)};
    std::vector<std::uint8_t> alpha;
    alpha.reserve(static_cast<std::size_t>(to.width) * to.height);
    // `from` has at most 2^13 texels per side, so the products fit.
    for (int y = 0; y < to.height; ++y)
        for (int x = 0; x < to.width; ++x) {
            const int column = (2 * x + 1) * from.width / (2 * to.width);
            const int row = (2 * y + 1) * from.height / (2 * to.height);
            alpha.push_back(texture.texels[static_cast<std::size_t>(row) * from.width + column][3]);
        }
    gpu::Texture out(to, gpu::TexelFormat::R8, gpu::Filter::Linear);
    out.upload({alpha.data(), static_cast<std::size_t>(to.width)});
    out.repeat();
    return out;
}

PixelRect doubled(const PixelRect& r) {
    return {2 * r.x0, 2 * r.y0, 2 * r.x1, 2 * r.y1};
}

/// Culls back faces during its lifetime. Front faces are clockwise for GL, because a picture's
/// first row is GL's lowest row.
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

/// Sets GL's depth range during its lifetime. The objects get a nearer range than the shadow
/// catcher, so that all objects are drawn in front of it.
class DepthRange {
public:
    DepthRange(float nearest, float farthest) { glDepthRangef(nearest, farthest); }
    DepthRange(const DepthRange&) = delete;
    DepthRange& operator=(const DepthRange&) = delete;
    ~DepthRange() { glDepthRangef(0, 1); }
};

}  // namespace

ModelSilhouette::ModelSilhouette(const CameraModel& layer)
    : lens_(layer), models_(layer),
      surface_({2 * layer.size.width, 2 * layer.size.height}, gpu::TexelFormat::R32Ui),
      diffuse_(surface_.size(), gpu::TexelFormat::Srgb8Alpha8, gpu::Filter::Linear),
      facing_(surface_.size(), gpu::TexelFormat::Srgb8Alpha8, gpu::Filter::Linear),
      window_(surface_.size(), gpu::TexelFormat::Depth24),
      target_(std::array<const gpu::Texture*, 3>{&surface_, &diffuse_, &facing_}, &window_),
      pass_("warp_silhouette.vert", "warp_silhouette.frag", ""),
      maskedPass_("warp_silhouette.vert", "warp_silhouette.frag", "#define ALPHA_MASK\n") {
    target_.bind();
    clear({0, 0, layer.size.width, layer.size.height});
}

void ModelSilhouette::setScene(const Scene& scene) {
    models_.setScene(scene);
    const auto before = std::exchange(parts_, {});
    for (const Models::Object& object : models_.objects())
        addParts(object.shape, before);
    if (models_.catcher()) addParts(models_.catcher()->shape, before);
}

void ModelSilhouette::addParts(const ShapePointer& shape, const PartsOfShapes& before) {
    PartsOfShapes::mapped_type& parts = parts_[shape];
    if (parts) return;
    if (const auto kept = before.find(shape); kept != before.end()) {
        parts = kept->second;
        return;
    }
    parts = std::make_shared<std::vector<Part>>();
    for (const Models::Part& part : shape->parts)
        parts->push_back(partOf(part));
}

ModelSilhouette::Part ModelSilhouette::partOf(const Models::Part& part) {
    const SurfaceMesh& mesh = part.mesh;
    std::vector<gpu::MeshVertex> vertices(mesh.vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        std::copy_n(mesh.vertices[i].position, 3, vertices[i].position);
        std::copy_n(mesh.vertices[i].uv, 2, vertices[i].uv);
    }
    Part out{gpu::Buffer(vertices.size() * sizeof(vertices[0])),
             gpu::Buffer(mesh.triangles.size() * sizeof(mesh.triangles[0])),
             static_cast<int>(3 * mesh.triangles.size()),
             paints_.of(part.material != nullptr ? paintSourceOf(part) : PaintSource{}),
             {},
             part.cutoff,
             part.bothSides};
    out.vertices.write(std::span<const gpu::MeshVertex>(vertices));
    out.indices.write(std::span(mesh.triangles));
    if (part.alpha != nullptr) out.alpha = alphaOf(*part.alpha);
    return out;
}

void ModelSilhouette::drawObject(const Models::Object& object, std::size_t number,
                                 const RigidTransform& T_camera_world) {
    params::SilhouetteMesh p{.object =
                                 transformOf(T_camera_world * object.T_world_object, object.scale),
                             .layer = projectionOf(lens_),
                             .width = static_cast<float>(lens_.camera.size.width),
                             .height = static_cast<float>(lens_.camera.size.height),
                             .number = static_cast<float>(number),
                             .cutoff = 0};
    for (const Part& part : *parts_.at(object.shape)) {
        p.cutoff = part.cutoff;
        std::optional<FrontFaces> front;
        if (!part.bothSides) front.emplace();
        const gpu::Mesh mesh{part.vertices, part.indices, part.indexCount};
        const gpu::Binding diffuse = gpu::sampler(0, part.paint->diffuse),
                           facing = gpu::sampler(1, part.paint->facing);
        if (part.alpha)
            maskedPass_.runMesh(p, {diffuse, facing, gpu::sampler(2, *part.alpha)}, target_, mesh);
        else
            pass_.runMesh(p, {diffuse, facing}, target_, mesh);
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
    // Paint is read only where this call draws a surface. Without the following line, tile-based
    // GPUs would load the last frame's paint.
    constexpr std::array<GLenum, 2> kPaint{GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
    glInvalidateFramebuffer(GL_FRAMEBUFFER, static_cast<GLsizei>(kPaint.size()), kPaint.data());
    if (!drawn_.empty()) clear(drawn_);
    drawn_ = models_.catcher() ? where : common(where, models_.bounds(T_world_camera));
    if (drawn_.empty() || !isFinite(T_world_camera)) return;
    const RigidTransform T_camera_world = T_world_camera.inverse();
    const gpu::Scissor scissor(doubled(drawn_));
    const gpu::DepthTest depthTest;
    {
        const DepthRange before(0, 0.5F);
        std::size_t number = 0;
        for (const Models::Object& object : models_.objects()) {
            ++number;
            if (!common(models_.boundsOf(object, T_camera_world), where).empty())
                drawObject(object, number, T_camera_world);
        }
    }
    const DepthRange behind(0.5F, 1);
    if (models_.catcher()) drawObject(*models_.catcher(), kCatcherId, T_camera_world);
}

}  // namespace mfar
