#include "hal/virtual/synthetic_renderer.h"

#include "base/camera_lens.h"
#include "hal/virtual/synthetic_hash.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace mfar::synthetic {
namespace {

constexpr int kTile = params::kSyntheticTile;
constexpr int kStepPixels = 640 * 480;  // pixels per step; a video frame is rendered in one step

using Four = std::array<float, 4>;

Four four(const Eigen::Vector3d& v, double w) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()),
            static_cast<float>(w)};
}

// SolidEntry and SurfaceEntry have the memory layout of Solid and Surface in synthetic_tables.glsl.
struct SolidEntry {
    std::array<Four, 3> rows;
};
struct SurfaceEntry {
    Four size, face, light;
    std::array<std::int32_t, 4> materials;
};

gpu::Binding uniform(GLuint index, const gpu::Buffer& b) {
    return {gpu::Binding::Kind::Uniform, index, b.id()};
}

/// Returns the bounds of a solid's bounding box in the picture, in normalised ray coordinates
/// (x/z, y/z). The part of the box with z < kNear in the camera's frame is ignored. If that is the
/// whole box, the bounds are empty (left > right).
template <class Rect>
Rect boundsOf(const RigidTransform& T_camera_prim, const Eigen::Vector3d& half) {
    constexpr double kNear = 0.01;
    constexpr double kFar = std::numeric_limits<double>::infinity();
    std::array<Eigen::Vector3d, 8> corners;
    for (int i = 0; i < 8; ++i)
        corners[i] =
            T_camera_prim *
            half.cwiseProduct(Eigen::Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    Rect r{kFar, kFar, -kFar, -kFar};
    const auto include = [&](const Eigen::Vector3d& p) {
        const double x = p.x() / p.z(), y = p.y() / p.z();
        r = {std::min(r.left, x), std::min(r.top, y), std::max(r.right, x), std::max(r.bottom, y)};
    };
    for (int i = 0; i < 8; ++i) {
        const Eigen::Vector3d& a = corners[i];
        if (a.z() >= kNear) include(a);
        for (const int bit : {1, 2, 4}) {
            const Eigen::Vector3d& b = corners[i ^ bit];
            if ((a.z() < kNear) == (b.z() < kNear)) continue;
            include(a + (kNear - a.z()) / (b.z() - a.z()) * (b - a));
        }
    }
    return r;
}

}  // namespace

SensorView::SensorView(WorldGl& world, const CameraModel& camera, const SensorLook& look)
    : world_(world), camera_(camera), look_(look), tilesX_((camera.size.width + kTile - 1) / kTile),
      tilesY_((camera.size.height + kTile - 1) / kTile),
      solids_(kMaxPrimitives * sizeof(SolidEntry)),
      surfaces_(kMaxPrimitives * sizeof(SurfaceEntry)),
      tiles_(sizeof(std::uint32_t) * 4 * tilesX_ * tilesY_),
      radiance_(camera.size, gpu::TexelFormat::Rgba16F),
      picture_(camera.size, gpu::TexelFormat::Rgba8), radianceTarget_(radiance_),
      pictureTarget_(picture_) {
    findTiles();
}

void SensorView::findTiles() {
    // Margin around a tile [px]. A pixel's rays lie a quarter of a pixel from its centre along each
    // axis, and lens distortion bends the tile's edges between the sampled points.
    constexpr double kMargin = 2;
    constexpr int kSamples = 4;
    for (int ty = 0; ty < tilesY_; ++ty) {
        for (int tx = 0; tx < tilesX_; ++tx) {
            Rect r{1e9, 1e9, -1e9, -1e9};
            for (int i = 0; i <= kSamples; ++i) {
                for (int j = 0; j <= kSamples; ++j) {
                    const double step = (kTile + 2 * kMargin) / kSamples;
                    const Eigen::Vector2d ray = camera_.unproject(
                        {tx * kTile - kMargin + i * step, ty * kTile - kMargin + j * step});
                    r = {std::min(r.left, ray.x()), std::min(r.top, ray.y()),
                         std::max(r.right, ray.x()), std::max(r.bottom, ray.y())};
                }
            }
            tileRays_.push_back(r);
        }
    }
}

void SensorView::begin(const RigidTransform& T_world_camera, double t, std::uint64_t noiseSeed) {
    row_ = 0;
    noiseSeed_ = noiseSeed;
    const World& world = world_.world_;
    const RigidTransform T_camera_world = T_world_camera.inverse();
    const Eigen::Vector3f light = (T_camera_world.rotation * world.light.towards).cast<float>();
    const Eigen::Vector3f mover =
        (T_camera_world * (world.moverPose(t) * world.moverPivot)).cast<float>();
    const Four background = four(world.light.background, 0);
    const int clouds = world_.slots_[static_cast<int>(Layer::Clouds)];
    params_ = {.lens = lensOf(camera_),
               .boxes = {},
               .lightX = light.x(),
               .lightY = light.y(),
               .lightZ = light.z(),
               .moverX = mover.x(),
               .moverY = mover.y(),
               .moverZ = mover.z(),
               .moverRadius = static_cast<float>(world.moverRadius),
               .red = background[0],
               .green = background[1],
               .blue = background[2],
               .tileColumns = static_cast<std::uint32_t>(tilesX_),
               .variationLayer = static_cast<std::uint32_t>(clouds)};
    uploadSolids(T_camera_world, t);
}

void SensorView::uploadSolids(const RigidTransform& T_camera_world, double t) {
    const World& world = world_.world_;
    const int count = static_cast<int>(world.primitives.size());
    std::vector<SolidEntry> solids(count);
    std::vector<SurfaceEntry> surfaces(count);
    std::vector<Rect> bounds(count);
    std::array<std::uint32_t, 4> boxes{};
    for (int i = 0; i < count; ++i) {
        const Primitive& p = world.primitives[i];
        const RigidTransform T_world_prim = world.primitivePose(i, t);
        const RigidTransform T_camera_prim = T_camera_world * T_world_prim;
        const RigidTransform T_prim_camera = T_camera_prim.inverse();
        const Eigen::Matrix3d turn = T_prim_camera.rotation.toRotationMatrix();
        for (int k = 0; k < 3; ++k)
            solids[i].rows[k] =
                four(turn.row(k).transpose() / p.half[k], T_prim_camera.translation[k] / p.half[k]);
        const Eigen::Vector4f& face = world_.light_.faces[i];
        surfaces[i].size = four(p.half, static_cast<double>(p.shape));
        surfaces[i].face = {face[0], face[1], face[2], face[3]};
        surfaces[i].light = four(T_world_prim.rotation.conjugate() * world.light.towards,
                                 LightMap::inset(p.lightTexels));
        surfaces[i].materials = {p.materials[0], p.materials[1], p.materials[2], p.moves ? 1 : 0};
        bounds[i] = boundsOf<Rect>(T_camera_prim, p.half);
        if (p.shape == Shape::Box) boxes[i / 32] |= 1U << (i % 32);
    }
    params_.boxes = {boxes[0], boxes[1], boxes[2], boxes[3]};
    solids_.write(std::span<const SolidEntry>(solids));
    surfaces_.write(std::span<const SurfaceEntry>(surfaces));
    uploadTiles(bounds);
}

void SensorView::uploadTiles(const std::vector<Rect>& bounds) {
    std::vector<std::array<std::uint32_t, 4>> masks(tileRays_.size());
    for (std::size_t k = 0; k < masks.size(); ++k) {
        const Rect& r = tileRays_[k];
        for (std::size_t i = 0; i < bounds.size(); ++i) {
            const Rect& b = bounds[i];
            if (b.left < r.right && b.right > r.left && b.top < r.bottom && b.bottom > r.top)
                masks[k][i / 32] |= 1U << (i % 32);
        }
    }
    tiles_.write(std::span<const std::array<std::uint32_t, 4>>(masks));
}

bool SensorView::step() {
    const int rows = std::max(kTile, kStepPixels / camera_.size.width / kTile * kTile);
    const int until = std::min(camera_.size.height, row_ + rows);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D_ARRAY, world_.layers_);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, row_, camera_.size.width, until - row_);
    world_.worldPass_.run(params_,
                          {gpu::sampler(1, world_.lightMap_), uniform(1, solids_),
                           uniform(2, surfaces_), uniform(3, world_.materials_),
                           gpu::storage(0, tiles_)},
                          radianceTarget_);
    glDisable(GL_SCISSOR_TEST);
    // Limits the work that is queued for the GPU, so that stopping the board waits for one step at
    // most.
    glFinish();
    row_ = until;
    return complete();
}

void SensorView::read(std::uint8_t* out) {
    params::SyntheticSensor p{};
    p.redGain = look_.gain.x();
    p.greenGain = look_.gain.y();
    p.blueGain = look_.gain.z();
    p.inverseGamma = 1 / look_.gamma;
    if (look_.blurSigma > 0) {
        const float side = std::exp(-0.5F / (look_.blurSigma * look_.blurSigma));
        const float total = (1 + 2 * side) * (1 + 2 * side);
        p.blurs = 1;
        p.centreWeight = 1 / total;
        p.sideWeight = side / total;
        p.cornerWeight = side * side / total;
    }
    p.noisy = noiseSeed_ != 0 ? 1 : 0;
    p.noisePerSignal = look_.shotNoise;
    p.noiseConstant = look_.readNoise;
    const std::uint64_t h = mix(noiseSeed_);
    p.seed = static_cast<std::uint32_t>(h);
    p.channelSeed = static_cast<std::uint32_t>(h >> 32) | 1U;
    world_.sensorPass_.run(p, {gpu::sampler(0, radiance_)}, pictureTarget_);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, camera_.size.width, camera_.size.height, GL_RGBA, GL_UNSIGNED_BYTE, out);
    gpu::checkErrors("SensorView::read");
}

}  // namespace mfar::synthetic
