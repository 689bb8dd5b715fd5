#include "pipeline/warp/depth_splat.h"

#include "pipeline/warp/warp_params.h"

#include <bit>
#include <limits>
#include <span>

namespace mfar {
namespace {

constexpr int kSplatGroup = 8;  // each way, as in the shaders

std::size_t pixelsOf(Size size) {
    return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
}

bool isSameCamera(const CameraModel& a, const CameraModel& b) {
    return a.size == b.size && a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy &&
           a.distortion == b.distortion;
}

gpu::Groups groupsOver(const PixelRect& r) {
    return {gpu::groupsFor(r.x1 - r.x0, kSplatGroup), gpu::groupsFor(r.y1 - r.y0, kSplatGroup), 1};
}

}  // namespace

DepthSplat::DepthSplat(const LensProjection& layer)
    : layer_(layer), objects_(layer.camera.size, gpu::TexelFormat::R32F),
      catcher_(layer.camera.size, gpu::TexelFormat::R32F),
      nearest_(2 * sizeof(std::uint32_t) * pixelsOf(layer.camera.size)),
      nothing_(pixelsOf(layer.camera.size),
               std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity())),
      splat_("warp_splat.comp"), resolve_("warp_splat_resolve.comp") {}

void DepthSplat::clear(const PixelRect& where) {
    const std::size_t width = layer_.camera.size.width;
    const auto rows = std::span<const std::uint32_t>(nothing_).first((where.y1 - where.y0) * width);
    for (const std::size_t plane : {std::size_t{0}, nothing_.size()})
        nearest_.write(rows, sizeof(std::uint32_t) * (plane + where.y0 * width));
}

void DepthSplat::run(const WarpReference& reference, const ReferenceTextures& textures,
                     const RigidTransform& T_world_camera, const PixelRect& where) {
    if (where.empty()) return;
    if (!raysOf_ || !isSameCamera(*raysOf_, reference.camera)) {
        raysOf_ = reference.camera;
        rays_ = rayTexture(reference.camera);
    }
    clear(where);
    const Size size = layer_.camera.size;
    if (!reference.bounds.empty()) {
        splat_.run({.fromView = transformOf(T_world_camera.inverse() * reference.T_world_camera),
                    .layer = projectionOf(layer_),
                    .from = boundsOf(reference.bounds),
                    .width = size.width,
                    .height = size.height},
                   {gpu::sampler(0, textures.surface()), gpu::sampler(1, rays_),
                    gpu::storage(0, nearest_)},
                   groupsOver(reference.bounds));
    }
    resolve_.run(
        {.bounds = boundsOf(where), .width = size.width, .height = size.height},
        {gpu::storage(0, nearest_), gpu::imageWrite(0, objects_), gpu::imageWrite(1, catcher_)},
        groupsOver(where));
}

}  // namespace mfar
