#include "pipeline/warp/traced_picture.h"

#include "base/se3.h"
#include "pipeline/engine/steps.h"
#include "pipeline/warp/warp_params.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace mfar {
namespace {

using Rgba = std::array<std::uint8_t, 4>;

constexpr int kMostSide = 16384;
constexpr int kTracedTile = 16;
// Object pixels with at least this alpha (of 255) count as fully covered. The missing samples are
// so few that they are invisible.
constexpr int kWhole = 250;
// WarpSurface::tolerance is kDepthShare * z + kSlopes * (differences of z to neighbouring pixels),
// but at most kMostShare * z. If no neighbour shows the surface, kUnknownSlope * z replaces the
// difference.
constexpr float kDepthShare = 0.002F, kSlopes = 1.5F, kUnknownSlope = 0.01F, kMostShare = 0.05F;

void requireFiniteCamera(const CameraModel& c, const RigidTransform& T) {
    const auto finite = [](double v) { return std::isfinite(v); };
    if (c.size.width < 1 || c.size.height < 1 || c.size.width > kMostSide ||
        c.size.height > kMostSide)
        throw std::invalid_argument(
            "the width and height of a rendered picture must be from 1 to 16384 pixels");
    if (!(c.fx > 0) || !(c.fy > 0) || !finite(c.fx) || !finite(c.fy) || !finite(c.cx) ||
        !finite(c.cy) || !std::ranges::all_of(c.distortion, finite) || !isFinite(T))
        throw std::invalid_argument(
            "a rendered picture has a camera parameter or a pose that is not "
            "finite, or a focal length that is not above 0");
}

class PictureGrid {
public:
    explicit PictureGrid(TracedPicture& traced) : r_(traced), size_(traced.camera.size) {}

    [[nodiscard]] Size size() const { return size_; }
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) +
               static_cast<std::size_t>(x);
    }
    [[nodiscard]] bool within(int x, int y) const {
        return x >= 0 && y >= 0 && x < size_.width && y < size_.height;
    }
    [[nodiscard]] int id(int x, int y) const {
        return within(x, y) ? static_cast<int>(r_.surface[index(x, y)].id) : 0;
    }
    [[nodiscard]] bool isObject(int x, int y) const {
        const int own = id(x, y);
        return own != 0 && own != kCatcherId;
    }
    /// True if the pixel's colour probably contains no other object's colour and no transparent
    /// background.
    [[nodiscard]] bool isPlain(int x, int y) const {
        const int own = id(x, y);
        if (own == 0) return true;
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
                const bool beside = i != 0 || j != 0;
                const bool aside = own == kCatcherId || i == 0 || j == 0;
                if (beside && aside && isObject(x + i, y + j) && id(x + i, y + j) != own)
                    return false;
            }
        return own == kCatcherId || r_.picture[index(x, y)][3] >= kWhole;
    }

private:
    const TracedPicture& r_;
    Size size_;
};

/// Replaces a pixel's colour and light by the mean of adjacent pixels that show the same surface
/// and have an unmixed colour (isPlain()). For the shadow catcher, pixels without a surface count,
/// too, because they have no shadow. Returns false if no adjacent pixel counts.
bool takeFromNeighbours(const PictureGrid& grid, std::span<const LightWords> light,
                        TracedPicture& r, int x, int y) {
    const int own = grid.id(x, y);
    std::array<int, 4> sum{};
    UnpackedLight sumOfLight;
    // Gloss is taken from one neighbour, because the mean of two octahedral codes is not the code
    // of the mean direction.
    GlossWords gloss;
    int count = 0;
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
            if ((i == 0 && j == 0) || !grid.within(x + i, y + j)) continue;
            const int id = grid.id(x + i, y + j);
            if ((id != own && !(id == 0 && own == kCatcherId)) || !grid.isPlain(x + i, y + j))
                continue;
            const std::size_t at = grid.index(x + i, y + j);
            for (std::size_t c = 0; c < 4; ++c)
                sum[c] += r.picture[at][c];
            if (!r.light.empty()) addShare(sumOfLight, 1, unpackedWords(light[at]));
            if (!r.gloss.empty()) gloss = r.gloss[at];
            ++count;
        }
    if (count == 0) return false;
    const std::size_t at = grid.index(x, y);
    for (std::size_t c = 0; c < 4; ++c)
        r.colour[at][c] = static_cast<std::uint8_t>((sum[c] + count / 2) / count);
    if (!r.light.empty()) {
        UnpackedLight mean;
        addShare(mean, 1 / static_cast<float>(count), sumOfLight);
        r.light[at] = packedWords(mean);
    }
    if (!r.gloss.empty()) r.gloss[at] = gloss;
    return true;
}

/// Returns the smaller of the two differences of z to the neighbours along one axis. Only
/// neighbours on the same surface count. If there is none, the result is kUnknownSlope * z.
float slopeAlong(std::span<const WarpSurface> surface, Size size, int x, int y, int dx, int dy) {
    const auto at = [&](int i, int j) -> const WarpSurface& {
        return surface[static_cast<std::size_t>(j) * static_cast<std::size_t>(size.width) +
                       static_cast<std::size_t>(i)];
    };
    const WarpSurface& own = at(x, y);
    float least = kUnknownSlope * own.z;
    bool any = false;
    for (const int side : {-1, 1}) {
        const int i = x + side * dx, j = y + side * dy;
        if (i < 0 || j < 0 || i >= size.width || j >= size.height || at(i, j).id != own.id)
            continue;
        const float step = std::abs(at(i, j).z - own.z);
        least = any ? std::min(least, step) : step;
        any = true;
    }
    return least;
}

void finishPixel(const PictureGrid& grid, std::span<const LightWords> light, TracedPicture& r,
                 int x, int y) {
    const std::size_t i = grid.index(x, y);
    WarpSurface& s = r.surface[i];
    s.known = 1;
    if (s.id == 0) return;
    s.tolerance = toleranceAt(r.surface, grid.size(), x, y);
    if (!r.layered && !grid.isPlain(x, y) && !takeFromNeighbours(grid, light, r, x, y)) {
        if (s.id == kCatcherId)
            s.known = 0;
        else
            r.colour[i] = filled(r.picture[i]);
    }
    if (s.id != kCatcherId) r.colour[i] = filled(r.colour[i]);
}

Eigen::Vector2d outerCorner(const PixelRect& r, std::size_t i) {
    return {((i & 1) != 0 ? r.x1 : r.x0) - 0.5, ((i & 2) != 0 ? r.y1 : r.y0) - 0.5};
}

void addTile(const PictureGrid& grid, TracedPicture& r, int x0, int y0) {
    TracedPicture::Tile tile{widened({x0, y0, x0 + kTracedTile, y0 + kTracedTile}, 0, grid.size()),
                             {},
                             std::numeric_limits<float>::max(),
                             0};
    for (int y = tile.pixels.y0; y < tile.pixels.y1; ++y)
        for (int x = tile.pixels.x0; x < tile.pixels.x1; ++x) {
            const float z = r.depth[grid.index(x, y)];
            if (!(z > 0)) continue;
            tile.nearest = std::min(tile.nearest, z);
            tile.farthest = std::max(tile.farthest, z);
        }
    if (!(tile.farthest > 0)) return;
    for (std::size_t i = 0; i < 4; ++i)
        tile.rays[i] = r.camera.unproject(outerCorner(tile.pixels, i));
    r.tiles.push_back(tile);
    r.bounds = around(r.bounds, tile.pixels);
}

void requireAllPixels(const RenderedPicture& picture, std::size_t count) {
    if (picture.colour.size() != count || picture.depth.size() != count ||
        picture.id.size() != count || (!picture.light.empty() && picture.light.size() != count) ||
        (!picture.gloss.empty() && picture.gloss.size() != count))
        throw std::invalid_argument("a rendered picture must have a colour, a depth and an id for "
                                    "each pixel of its camera; its light and its gloss must be "
                                    "empty or have a value for each pixel");
}

/// Marks the gloss of moving objects as unknown, so that their reflections are shown as traced. The
/// normals in the gloss are in the world frame, and the warp does not rotate them with the object.
void forgetGlossOfMoving(const RenderedPicture& picture, std::vector<GlossWords>& gloss) {
    if (gloss.empty() || picture.poses.empty() || !picture.scene) return;
    const std::vector<SceneObject>& objects = picture.scene->objects;
    for (std::size_t i = 0; i < gloss.size(); ++i) {
        const std::size_t id = picture.id[i];
        if (id > 0 && id <= objects.size() && objects[id - 1].path) gloss[i] = {};
    }
}

TracedPicture withSurfaces(const RenderedPicture& picture) {
    const std::size_t count = picture.id.size();
    TracedPicture r{picture.camera,
                    picture.T_world_camera,
                    picture.colour,
                    {},
                    picture.colour,
                    picture.light,
                    picture.gloss,
                    picture.mirrors,
                    picture.exposure,
                    picture.layered,
                    picture.poses,
                    {},
                    {},
                    {},
                    {}};
    forgetGlossOfMoving(picture, r.gloss);
    const auto isUnknown = [](const GlossWords& words) { return words == GlossWords{}; };
    if (std::ranges::all_of(r.gloss, isUnknown)) r.gloss.clear();
    r.depth.resize(count);
    r.surface.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const float z = picture.depth[i];
        const bool is = picture.id[i] != 0 && z > LensProjection::kNear && z < kFarthestSurface;
        r.depth[i] = is ? z : 0;
        if (!is) r.picture[i] = r.colour[i] = {};
        r.surface[i] = {r.depth[i], is ? static_cast<float>(picture.id[i]) : 0, 0, 0};
    }
    return r;
}

}  // namespace

// The format must be that of warp_surface.glsl.
std::uint32_t packedSurface(const WarpSurface& s) {
    if (!(s.known > 0)) return kUnknownId;
    if (s.id == 0) return 0;
    return ((std::bit_cast<std::uint32_t>(s.z) + 0x80U) & 0xFFFFFF00U) |
           static_cast<std::uint32_t>(s.id);
}

float toleranceAt(std::span<const WarpSurface> surface, Size size, int x, int y) {
    const float steps =
        slopeAlong(surface, size, x, y, 1, 0) + slopeAlong(surface, size, x, y, 0, 1);
    const float z = surface[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
                            static_cast<std::size_t>(x)]
                        .z;
    return std::min(kDepthShare * z + kSlopes * steps, kMostShare * z);
}

std::array<std::uint8_t, 4> filled(const std::array<std::uint8_t, 4>& premultiplied) {
    const int a = premultiplied[3];
    if (a == 0) return {0, 0, 0, 255};
    Rgba out{0, 0, 0, 255};
    for (std::size_t c = 0; c < 3; ++c)
        out[c] = static_cast<std::uint8_t>(std::min(255, (premultiplied[c] * 255 + a / 2) / a));
    return out;
}

TracedPicture tracedPicture(const RenderedPicture& picture) {
    requireFiniteCamera(picture.camera, picture.T_world_camera);
    const Size size = picture.camera.size;
    const std::size_t count = static_cast<std::size_t>(size.width) * size.height;
    requireAllPixels(picture, count);
    TracedPicture r = withSurfaces(picture);
    const PictureGrid grid(r);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            finishPixel(grid, picture.light, r, x, y);
    r.packed.reserve(count);
    for (const WarpSurface& s : r.surface)
        r.packed.push_back(packedSurface(s));
    for (int y = 0; y < size.height; y += kTracedTile)
        for (int x = 0; x < size.width; x += kTracedTile)
            addTile(grid, r, x, y);
    for (std::size_t i = 0; i < count; ++i)
        if (picture.id[i] == kCatcherId) r.depth[i] *= 1 - kShadowLift;
    return r;
}

WarpMotion motionOf(const TracedPicture& traced, const LensProjection& layer,
                    const RigidTransform& T_world_camera) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    const Size size = layer.camera.size;
    const RigidTransform T = T_world_camera.inverse() * traced.T_world_camera;
    const bool sameSize = traced.camera.size == size;
    Eigen::AlignedBox2d box;
    double greatest = traced.tiles.empty() || sameSize ? 0 : kInfinite;
    bool behind = false;
    for (const TracedPicture::Tile& tile : traced.tiles)
        for (std::size_t i = 0; i < 4; ++i) {
            const Eigen::Vector2d corner = outerCorner(tile.pixels, i);
            const Eigen::Vector3d ray = tile.rays[i].homogeneous();
            for (const float z : {tile.nearest, tile.farthest}) {
                const Eigen::Vector3d h = layer(T * (static_cast<double>(z) * ray));
                if (h.z() >= LensProjection::kNear) {
                    box.extend(Eigen::Vector2d(h.hnormalized()));
                    greatest = std::max(greatest, (h.hnormalized() - corner).norm());
                } else {
                    behind = true;
                }
            }
        }
    if (box.isEmpty()) return {behind ? kInfinite : greatest, {}};
    if (behind) return {kInfinite, {0, 0, size.width, size.height}};
    return {greatest, pixelsAround(box, 2, size)};
}

}  // namespace mfar
