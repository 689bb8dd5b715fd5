#include "pipeline/simd/view_look_up.h"

#include "pipeline/engine/steps.h"
#include "pipeline/simd/rest_pixels.h"
#include "pipeline/simd/surface_raster.h"
#include "pipeline/warp/object_views.h"
#include "pipeline/warp/pass_params.h"

#include <algorithm>
#include <utility>

namespace mfar::simd {
namespace {

constexpr int kRowsAtATime = 4;

static_assert(kCatcherNumber == kCatcherId);

CatcherPlane planeIn(const Eigen::Vector4d& world, const RigidTransform& T_world_camera) {
    const Eigen::Vector3d normal = T_world_camera.rotation.conjugate() * world.head<3>();
    const Eigen::Vector4f plane =
        Eigen::Vector4d(normal.x(), normal.y(), normal.z(),
                        world.w() - world.head<3>().dot(T_world_camera.translation))
            .cast<float>();
    return {plane.x(), plane.y(), plane.z(), plane.w()};
}

}  // namespace

std::vector<PointTransform> transformsByNumber(std::span<const RigidTransform> views) {
    if (views.empty()) return {};
    std::vector<PointTransform> out(params::kSurfaceNumbers, pointTransformOf(views.front()));
    for (std::size_t i = 1; i < views.size(); ++i)
        out[i] = pointTransformOf(views[i]);
    return out;
}

void RerenderedStore::store(const RerenderedPictures::StoredRows& rows) {
    Picture& picture = pictures_[static_cast<std::size_t>(rows.slot)];
    const std::size_t pixels = static_cast<std::size_t>(layer_.width) * layer_.height;
    picture.colours.resize(pixels);
    picture.surfaces.resize(pixels);
    const std::size_t first = static_cast<std::size_t>(rows.firstRow) * layer_.width;
    std::ranges::copy(rows.colours, picture.colours.begin() + static_cast<std::ptrdiff_t>(first));
    if (!rows.lights.empty()) {
        picture.lights.resize(pixels);
        std::ranges::copy(rows.lights, picture.lights.begin() + static_cast<std::ptrdiff_t>(first));
    }
    std::ranges::copy(rows.surfaces, picture.surfaces.begin() + static_cast<std::ptrdiff_t>(first));
}

ViewLookUp::ViewLookUp(const LensProjection& layer, std::shared_ptr<Workers> workers)
    : layer_(layer), workers_(std::move(workers)), rayX_(layer.camera.size),
      rayY_(layer.camera.size), depth_(layer.camera.size),
      mirrors_(layer.camera, rayX_.rows(), rayY_.rows(), workers_), colour_(layer.camera.size),
      state_(layer.camera.size),
      scratch_(workers_ ? workers_->count() : 1,
               [&] {
                   const auto words = static_cast<std::size_t>(layer.camera.size.width) + 16;
                   return Scratch{std::vector<std::uint32_t>(words),
                                  std::vector<PaintWords>(words)};
               }),
      rowHoles_(static_cast<std::size_t>(layer.camera.size.height)) {
    const Size size = layer.camera.size;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const Eigen::Vector2f ray = layer.camera.unproject(Eigen::Vector2d(x, y)).cast<float>();
            rayX_[y][x] = ray.x();
            rayY_[y][x] = ray.y();
        }
}

void ViewLookUp::setTracedPicture(const TracedPicture& traced) {
    traced_ = &traced;
    mirrors_.setTracedPicture(traced);
    tracedLens_ = pointLensOf(LensProjection(traced.camera));
}

void ViewLookUp::clear(const PixelRect& where) {
    for (int y = where.y0; y < where.y1; ++y) {
        std::fill(colour_[y] + where.x0, colour_[y] + where.x1, 0U);
        std::fill(depth_[y] + where.x0, depth_[y] + where.x1, 0.0F);
        std::fill(state_[y] + where.x0, state_[y] + where.x1, 0U);
    }
}

void ViewLookUp::run(const Input& input, const RigidTransform& T_world_camera,
                     const PixelRect& where) {
    const std::span<const LightWords> lights = mirrors_.lightFor(T_world_camera.translation);
    const std::vector<PointTransform> moved = transformsByNumber(viewsOfObjects(
        traced_->T_world_camera, traced_->poses, input.raster.models().objects(), T_world_camera));
    const ViewLookUpInput plain{
        pointTransformOf(traced_->T_world_camera.inverse() * T_world_camera),
        tracedLens_,
        traced_->camera.size,
        traced_->packed.data(),
        reinterpret_cast<const std::uint32_t*>(traced_->colour.data()),
        lights.empty() ? nullptr : &lights.front().diffuse,
        planeIn(input.plane, T_world_camera),
        1 - kShadowLift,
        moved.empty() ? nullptr : moved.data()};
    const RestPixels rest(input, *traced_, lights, plain, layer_, T_world_camera);
    const auto rows = [&](int y, int end) {
        scratch_.with([&](Scratch& scratch) {
            for (; y < end; ++y)
                runRow(input, plain, rest, where, where.y0 + y, scratch);
        });
    };
    forRange(workers_.get(), where.y1 - where.y0, kRowsAtATime, rows);
    holes_.clear();
    for (int y = where.y0; y < where.y1; ++y)
        holes_.insert(holes_.end(), rowHoles_[y].begin(), rowHoles_[y].end());
}

void ViewLookUp::runRow(const Input& input, const ViewLookUpInput& plain, const RestPixels& rest,
                        const PixelRect& where, int y, Scratch& scratch) {
    const Rows<const std::uint32_t> surface = input.raster.surface();
    const std::uint32_t *upper = surface[2 * y], *lower = surface[2 * y + 1];
    const int x0 = where.x0, count = where.x1 - where.x0;
    std::uint32_t* left = scratch.left.data();
    PaintWords* paint = scratch.paint.data();
    if (plain.lights != nullptr || rest.needsPaint()) input.raster.paintRow(y, x0, where.x1, paint);
    const int leftCount =
        lookUpRow({count, upper + 2L * x0, lower + 2L * x0, paint, rayX_[y] + x0, rayY_[y] + x0,
                   colour_[y] + x0, depth_[y] + x0, state_[y] + x0, left},
                  plain);
    std::vector<Hole>& holes = rowHoles_[static_cast<std::size_t>(y)];
    holes.clear();
    for (int i = 0; i < leftCount; ++i) {
        const int x = x0 + static_cast<int>(left[i]);
        const RestPixel pixel =
            rest.at({upper + 2L * x, lower + 2L * x, rayX_[y][x], rayY_[y][x], paint[left[i]]});
        colour_[y][x] = pixel.colour;
        depth_[y][x] = pixel.depth;
        state_[y][x] = pixel.state;
        if (!pixel.hole) continue;
        holes.push_back(*pixel.hole);
        holes.back().pixel = static_cast<std::uint32_t>(y) * layer_.camera.size.width + x;
    }
}

}  // namespace mfar::simd
