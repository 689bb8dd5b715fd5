#include "pipeline/composite/preview_renderer.h"

#include "base/gl/scoped_state.h"
#include "pipeline/composite/pass_values.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mfar {
namespace {

using gpu::TexelFormat;

constexpr double kReach = 0.505;  // largest coordinate of a unit shape, plus a margin for rounding

static_assert(sizeof(ShapeMesh::Vertex) == sizeof(gpu::MeshVertex));

}  // namespace

PreviewRenderer::PreviewRenderer(const CameraModel& video, Size output, const PreviewLight& light)
    : projection_(video.scaledTo(output)), light_(light),
      shapes_{buffersOf(projection_.mesh(VirtualShape::Box)),
              buffersOf(projection_.mesh(VirtualShape::Sphere)),
              buffersOf(projection_.mesh(VirtualShape::Quad))},
      colour_(output, TexelFormat::Rgba8), depth_(output, TexelFormat::R32F),
      window_(output, TexelFormat::Depth24),
      target_(std::array<const gpu::Texture*, 2>{&colour_, &depth_}, &window_),
      pass_("preview.vert", "preview.frag", ""), layer_{&colour_, &depth_, {}} {
    clear({0, 0, output.width, output.height});
}

PreviewRenderer::ShapeBuffers PreviewRenderer::buffersOf(const ShapeMesh& mesh) {
    ShapeBuffers out{gpu::Buffer(mesh.vertices.size() * sizeof(ShapeMesh::Vertex)),
                     gpu::Buffer(mesh.triangles.size() * sizeof(mesh.triangles[0])),
                     static_cast<int>(3 * mesh.triangles.size())};
    std::vector<gpu::MeshVertex> vertices(mesh.vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const ShapeMesh::Vertex& v = mesh.vertices[i];
        std::copy_n(v.position.data(), 3, vertices[i].position);
        std::copy_n(v.normal.data(), 3, vertices[i].normal);
        std::copy_n(v.uv.data(), 2, vertices[i].uv);
    }
    out.vertices.write(std::span<const gpu::MeshVertex>(vertices));
    out.indices.write(std::span(mesh.triangles));
    return out;
}

params::PreviewObject PreviewRenderer::paramsOf(const VirtualObject& object,
                                                const RigidTransform& T_world_video) const {
    const auto single = [](double v) { return static_cast<float>(v); };
    const auto colourOf = [](const auto& c) { return params::Colour{c[0], c[1], c[2]}; };
    const Size target = projection_.lens().camera.size;
    const Eigen::Vector3f size = object.size.cast<float>();
    const Eigen::Vector3f light =
        (T_world_video.rotation.conjugate() * light_.towards.normalized()).cast<float>();
    const double radius = object.shape == VirtualShape::Sphere ? kReach : std::sqrt(3) * kReach;
    return {.object = transformOf(T_world_video.inverse() * object.T_world_object),
            .projection = projectionOf(projection_.lens()),
            .colours = {colourOf(object.colours[0]), colourOf(object.colours[1])},
            .width = size.x(),
            .height = size.y(),
            .depth = size.z(),
            .squares = single(std::max(object.squares, 1)),
            .lightX = light.x(),
            .lightY = light.y(),
            .lightZ = light.z(),
            .ambient = single(light_.ambient),
            .targetWidth = single(target.width),
            .targetHeight = single(target.height),
            .reach = single(kReach),
            .squaredRadius = single(radius * radius)};
}

PixelRect PreviewRenderer::boundsOf(const VirtualObject& object,
                                    const RigidTransform& T_world_video) {
    const Size size = projection_.lens().camera.size;
    // The margin of one pixel allows for the GPU's rounding errors in the positions of vertices.
    const Eigen::AlignedBox2d picture(Eigen::Vector2d(-1, -1),
                                      Eigen::Vector2d(size.width, size.height));
    Eigen::AlignedBox2d box;
    for (const SurfaceExtent& extent : projection_(object, T_world_video))
        box.extend(extent.pixels.intersection(picture));
    if (box.isEmpty()) return {};
    const Eigen::Array2i least = (box.min().array() - 1).floor().cast<int>().max(0);
    const Eigen::Array2i most = (box.max().array() + 2).ceil().cast<int>();
    return {least.x(), least.y(), std::min(most.x(), size.width), std::min(most.y(), size.height)};
}

void PreviewRenderer::clear(const PixelRect& pixels) const {
    constexpr std::array<float, 4> kNothing{0, 0, 0, 0};
    constexpr float kFarthest = 1;
    target_.bind();
    const gpu::Scissor scissor(pixels);
    glClearBufferfv(GL_COLOR, 0, kNothing.data());
    glClearBufferfv(GL_COLOR, 1, kNothing.data());
    glClearBufferfv(GL_DEPTH, 0, &kFarthest);
}

const VirtualLayer& PreviewRenderer::render(std::span<const VirtualObject> objects,
                                            const RigidTransform& T_world_video) {
    if (!layer_.bounds.empty()) clear(layer_.bounds);
    layer_.bounds = {};
    for (const VirtualObject& object : objects) {
        const PixelRect bounds = boundsOf(object, T_world_video);
        if (bounds.empty()) continue;
        layer_.bounds = around(layer_.bounds, bounds);
        const ShapeBuffers& shape = shapes_[static_cast<std::size_t>(object.shape)];
        const gpu::Scissor scissor(bounds);
        const gpu::DepthTest depthTest;
        std::optional<gpu::InsidesCulled> culled;  // culling the insides saves a third of the time
        if (object.shape != VirtualShape::Quad) culled.emplace();
        pass_.runMesh(paramsOf(object, T_world_video), {}, target_,
                      {shape.vertices, shape.indices, shape.indexCount});
    }
    return layer_;
}

}  // namespace mfar
