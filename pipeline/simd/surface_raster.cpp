#include "pipeline/simd/surface_raster.h"

#include "base/se3.h"
#include "pipeline/render/rendered_picture.h"
#include "pipeline/warp/warp_params.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace mfar::simd {
namespace {

constexpr std::size_t kBatch = 1024;
constexpr int kCornersAtATime = 2048;
constexpr int kLeastBand = 16;
constexpr int kBandsPerThread = 4;
// Upper limit of |x| and |y| of a corner [grid px]. Triangles with corners beyond it are clipped.
// Below it, single precision is exact to a hundredth of a pixel.
constexpr float kGuard = 65536;

}  // namespace

PointLens pointLensOf(const LensProjection& lens) {
    const CameraModel& c = lens.camera;
    const auto f = [](double v) { return static_cast<float>(v); };
    return {f(c.fx),
            f(c.fy),
            f(c.cx),
            f(c.cy),
            f(c.distortion[0]),
            f(c.distortion[1]),
            f(c.distortion[2]),
            f(c.distortion[3]),
            f(c.distortion[4]),
            f(lens.rim),
            f(lens.rimRadial),
            f(LensProjection::kNear)};
}

PointTransform pointTransformOf(const RigidTransform& T, double scale) {
    const params::Transform from = transformOf(T, scale);
    PointTransform out;
    for (int i = 0; i < 3; ++i) {
        const params::Row4& row = from.rows[i];
        const std::array<float, 4> values{row.x, row.y, row.z, row.w};
        std::ranges::copy(values, out.rows[i]);
    }
    return out;
}

SurfaceRaster::Part::Part(const SilhouetteModels::Part& from)
    : source(&from), corners({static_cast<int>(from.mesh.vertices.size()), 3}) {
    for (std::size_t i = 0; i < from.mesh.vertices.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            corners[axis][i] = from.mesh.vertices[i].position[axis];
}

SurfaceRaster::SurfaceRaster(const CameraModel& layer, std::shared_ptr<Workers> workers)
    : models_(layer), lens_(pointLensOf(models_.lens())), workers_(std::move(workers)),
      words_({2 * layer.size.width, 2 * layer.size.height}), indices_(words_.size()) {}

void SurfaceRaster::setScene(const Scene& scene) {
    models_.setScene(scene);
    const auto before = std::exchange(parts_, {});
    placed_.clear();
    chunks_.clear();
    batches_.clear();
    paint_.set(models_.objects());
    paintTriangles_.clear();
    const auto add = [&](const SilhouetteModels::Object& object, std::uint32_t word) {
        const auto [at, isNew] = parts_.try_emplace(object.shape);
        if (const auto kept = before.find(object.shape); isNew && kept != before.end())
            at->second = kept->second;
        else if (isNew)
            for (const SilhouetteModels::Part& part : object.shape->parts)
                at->second.push_back(std::make_shared<Part>(part));
        place(object, word, at->second);
    };
    std::uint32_t number = 0;
    for (const SilhouetteModels::Object& object : models_.objects())
        add(object, ++number);
    if (models_.catcher()) add(*models_.catcher(), kCatcherId | kBehindObjects);
}

void SurfaceRaster::paintRow(int y, int x0, int x1, PaintWords* out) const {
    PaintInput input = paint_.input();
    input.triangles = paintTriangles_.data();
    const std::ptrdiff_t first = 2L * x0;
    simd::paintRow({x0, y, x1 - x0, words_[2 * y] + first, words_[2 * y + 1] + first,
                    indices_[2 * y] + first, indices_[2 * y + 1] + first, out},
                   input);
}

void SurfaceRaster::place(const SilhouetteModels::Object& object, std::uint32_t word,
                          const Parts& parts) {
    for (const std::shared_ptr<const Part>& part : parts) {
        const Size corners = part->corners.size();
        const std::size_t triangles = part->source->mesh.triangles.size();
        placed_.push_back({&object,
                           word,
                           part,
                           AlignedRows<float>(corners),
                           {},
                           false,
                           static_cast<std::uint32_t>(paintTriangles_.size())});
        if (part->source->material != nullptr) {
            const PaintTextures::Material& m = paint_.of(*part->source);
            PaintTriangle paint{};
            paint.size = m.size;
            paint.levels = m.levels;
            paint.material = m.material;
            paintTriangles_.insert(paintTriangles_.end(), triangles, paint);
        }
        for (int i = 0; i < corners.width; i += kCornersAtATime)
            chunks_.push_back({&placed_.back(), i, std::min(kCornersAtATime, corners.width - i)});
        for (std::size_t i = 0; i < triangles; i += kBatch)
            batches_.push_back({&placed_.back(), i, std::min(i + kBatch, triangles), {}, {}});
    }
}

void SurfaceRaster::draw(const RigidTransform& T_world_camera, const PixelRect& where) {
    const RigidTransform T_camera_world = T_world_camera.inverse();
    grid_ = {2 * where.x0, 2 * where.y0, 2 * where.x1, 2 * where.y1};
    for (Placed& p : placed_) {
        p.isInView = !common(models_.boundsOf(*p.object, T_camera_world), where).empty();
        p.view = pointTransformOf(T_camera_world * p.object->T_world_object, p.object->scale);
    }
    forRows(workers_.get(), 0, static_cast<int>(chunks_.size()), 1, [&](int i) {
        const Chunk& c = chunks_[static_cast<std::size_t>(i)];
        if (!c.placed->isInView) return;
        const AlignedRows<float>& mesh = c.placed->part->corners;
        AlignedRows<float>& seen = c.placed->seen;
        projectCorners({mesh[0] + c.first, mesh[1] + c.first, mesh[2] + c.first}, c.count,
                       c.placed->view, lens_,
                       {seen[0] + c.first, seen[1] + c.first, seen[2] + c.first});
    });
    forRows(workers_.get(), 0, static_cast<int>(batches_.size()), 1,
            [&](int i) { makeReady(batches_[static_cast<std::size_t>(i)]); });
    const int rows = grid_.y1 - grid_.y0, threads = workers_ ? workers_->count() : 1;
    const int bands = std::clamp(rows / kLeastBand, 1, kBandsPerThread * threads);
    forRows(workers_.get(), 0, bands, 1, [&](int i) {
        drawBand(
            {words_.rows(),
             indices_.rows(),
             {grid_.x0, grid_.y0 + rows * i / bands, grid_.x1, grid_.y0 + rows * (i + 1) / bands}});
    });
}

void SurfaceRaster::drawBand(const RasterBand& band) const {
    clearBand(band);
    for (const Batch& batch : batches_) {
        drawTriangles(batch.triangles, band);
        drawMasked(batch.masked, band);
    }
    finishBand(band);
}

void SurfaceRaster::makeReady(Batch& batch) {
    batch.triangles.clear();
    batch.masked.clear();
    if (!batch.placed->isInView) return;
    for (std::size_t i = batch.first; i < batch.last; ++i)
        addSeen(batch, i);
}

void SurfaceRaster::addSeen(Batch& batch, std::size_t triangle) {
    const AlignedRows<float>& seen = batch.placed->seen;
    const SurfaceMesh& mesh = batch.placed->part->source->mesh;
    const auto& corners = mesh.triangles[triangle];
    RasterCorner c[3];
    int behind = 0, simple = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t at = corners[i];
        const float x = seen[0][at], y = seen[1][at], z = seen[2][at];
        behind += z >= lens_.nearest ? 0 : 1;
        simple += z >= lens_.nearest && std::abs(x) < kGuard && std::abs(y) < kGuard ? 1 : 0;
        const float* uv = mesh.vertices[at].uv;
        c[i] = {x, y, 1 / z, uv[0] / z, uv[1] / z};
    }
    if (behind == 3) return;
    if (simple < 3) {
        addClipped(batch, triangle);
        return;
    }
    const auto index = batch.placed->firstTriangle + static_cast<std::uint32_t>(triangle);
    if (addTriangle(batch, c, index)) setPaint(*batch.placed, c, index);
}

bool SurfaceRaster::addTriangle(Batch& batch, const RasterCorner (&c)[3],
                                std::uint32_t index) const {
    const auto [left, right] = std::minmax({c[0].x, c[1].x, c[2].x});
    const auto [top, bottom] = std::minmax({c[0].y, c[1].y, c[2].y});
    if (!(left < static_cast<float>(grid_.x1)) || !(right > static_cast<float>(grid_.x0)) ||
        !(top < static_cast<float>(grid_.y1)) || !(bottom > static_cast<float>(grid_.y0)))
        return false;
    const SilhouetteModels::Part& part = *batch.placed->part->source;
    // The triangle faces away if its corners are clockwise in the picture (row 0 is on top).
    if (!part.bothSides &&
        (c[1].x - c[0].x) * (c[2].y - c[0].y) >= (c[2].x - c[0].x) * (c[1].y - c[0].y))
        return false;
    const RasterName name{batch.placed->word, index};
    if (part.alpha == nullptr) {
        RasterTriangle triangle;
        if (!makeTriangle(c, name, triangle)) return false;
        batch.triangles.push_back(triangle);
        return true;
    }
    MaskedTriangle triangle;
    const SurfaceTexture& alpha = *part.alpha;
    if (!makeMasked(c, name, {alpha.texels.front().data(), alpha.size, part.cutoff}, triangle))
        return false;
    batch.masked.push_back(triangle);
    return true;
}

/// Stores 1 / z and the texture coordinates as linear functions on the grid. `c`: corners of the
/// triangle or, after clipping, of any piece of it. The functions are the same for all pieces.
void SurfaceRaster::setPaint(const Placed& placed, const RasterCorner (&c)[3],
                             std::uint32_t index) {
    if (placed.part->source->material == nullptr) return;  // the shadow catcher has no paint
    PaintTriangle& paint = paintTriangles_[index];
    const float area = doubleArea(c);
    paint.perZ = planeThrough(c, {c[0].perZ, c[1].perZ, c[2].perZ}, area);
    paint.u = planeThrough(c, {c[0].u, c[1].u, c[2].u}, area);
    paint.v = planeThrough(c, {c[0].v, c[1].v, c[2].v}, area);
}

namespace {

/// A corner in homogeneous grid coordinates (w x, w y, w). Its texture coordinates u, v are linear
/// functions of these.
struct ClipCorner {
    float x, y, w, u, v;
};

ClipCorner between(const ClipCorner& a, const ClipCorner& b, float share) {
    const auto mix = [share](float from, float to) { return from + share * (to - from); };
    return {mix(a.x, b.x), mix(a.y, b.y), mix(a.w, b.w), mix(a.u, b.u), mix(a.v, b.v)};
}

/// Keeps the part of a polygon where `inside` is 0 or more. Source: Sutherland and Hodgman 1974.
template <class Inside>
std::vector<ClipCorner> clipped(const std::vector<ClipCorner>& polygon, const Inside& inside) {
    std::vector<ClipCorner> out;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const ClipCorner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const float from = inside(a), to = inside(b);
        if (from >= 0) out.push_back(a);
        if ((from >= 0) == (to >= 0)) continue;
        // The ends of an edge are always used in the same order, from outside to inside, so that
        // both triangles at an edge get the same point.
        out.push_back(from >= 0 ? between(b, a, to / (to - from))
                                : between(a, b, from / (from - to)));
    }
    return out;
}

}  // namespace

void SurfaceRaster::addClipped(Batch& batch, std::size_t triangle) {
    const SurfaceMesh& mesh = batch.placed->part->source->mesh;
    const auto& corners = mesh.triangles[triangle];
    std::vector<ClipCorner> polygon;
    for (const std::uint32_t at : corners) {
        const SurfaceVertex& v = mesh.vertices[at];
        const Point3 p =
            transformed(batch.placed->view, {v.position[0], v.position[1], v.position[2]});
        const Point3 h = projected(lens_, p);
        polygon.push_back({2 * h.x + h.z, 2 * h.y + h.z, h.z, v.uv[0], v.uv[1]});
    }
    polygon = clipped(polygon, [&](const ClipCorner& c) { return c.w - lens_.nearest; });
    polygon = clipped(polygon, [](const ClipCorner& c) { return kGuard * c.w - c.x; });
    polygon = clipped(polygon, [](const ClipCorner& c) { return kGuard * c.w + c.x; });
    polygon = clipped(polygon, [](const ClipCorner& c) { return kGuard * c.w - c.y; });
    polygon = clipped(polygon, [](const ClipCorner& c) { return kGuard * c.w + c.y; });
    const auto corner = [](const ClipCorner& c) {
        return RasterCorner{c.x / c.w, c.y / c.w, 1 / c.w, c.u / c.w, c.v / c.w};
    };
    const auto index = batch.placed->firstTriangle + static_cast<std::uint32_t>(triangle);
    float largest = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const RasterCorner piece[3] = {corner(polygon[0]), corner(polygon[i - 1]),
                                       corner(polygon[i])};
        const float area = std::abs(doubleArea(piece));
        if (!addTriangle(batch, piece, index) || !(area > largest)) continue;
        largest = area;
        setPaint(*batch.placed, piece, index);
    }
}

}  // namespace mfar::simd
