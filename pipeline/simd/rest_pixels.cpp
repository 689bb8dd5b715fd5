#include "pipeline/simd/rest_pixels.h"

#include "base/srgb.h"
#include "pipeline/render/rendered_picture.h"
#include "pipeline/simd/surface_raster.h"
#include "pipeline/warp/object_views.h"
#include "pipeline/warp/pass_params.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace mfar::simd {
namespace {

// Surfaces of a pixel's quarters: upper left, upper right, lower left, lower right.
using Quarters = std::array<std::uint32_t, 4>;

std::uint32_t numberOf(std::uint32_t surface) {
    return surface & 0xFFU;
}
float depthOf(std::uint32_t surface) {
    return std::bit_cast<float>(surface & 0xFFFFFF00U);
}

/// Returns the number of the object that covers the most quarters, or 0 if no object covers one. If
/// objects cover equally many quarters, the object of the first quarter wins, in the order lower
/// left, lower right, upper right, upper left.
std::uint32_t mostOf(const Quarters& s) {
    std::uint32_t out = 0;
    int most = 0;
    for (const int i : {2, 3, 1, 0}) {
        const std::uint32_t own = numberOf(s[i]);
        if (own == 0 || own == kCatcherNumber) continue;
        int count = 0;
        for (const std::uint32_t other : s)
            count += numberOf(other) == own ? 1 : 0;
        if (count <= most) continue;
        most = count;
        out = own;
    }
    return out;
}

/// Returns the mean position of the quarters that show the surface `number`: x and y relative to
/// the pixel's centre [px], and z [m]. All three are 0 if no quarter shows the surface.
Point3 middleOf(const Quarters& s, std::uint32_t number) {
    constexpr std::array<float, 4> kX{-0.25F, 0.25F, -0.25F, 0.25F};
    constexpr std::array<float, 4> kY{-0.25F, -0.25F, 0.25F, 0.25F};
    Point3 sum;
    float count = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        if (number == 0 || numberOf(s[i]) != number) continue;
        sum.x += kX[i];
        sum.y += kY[i];
        sum.z += depthOf(s[i]);
        ++count;
    }
    return count > 0 ? Point3{sum.x / count, sum.y / count, sum.z / count} : Point3{};
}

Point3 scaled(float by, const Point3& p) {
    return {by * p.x, by * p.y, by * p.z};
}

/// Returns one colour channel, [0, 255], of a surface with the given paint and light. Channel 3
/// (alpha) is 255. `light`: weighted sum of light. `weights`: sum of the weights.
float lit(const PaintWords& paint, std::size_t channel, const UnpackedLight& light, float weights) {
    if (channel == 3) return 255;
    const auto linear = [channel](std::uint32_t word) {
        return srgbDecoded(static_cast<float>(word >> 8 * channel & 0xFFU) / 255);
    };
    const float facing = linear(paint.facing), veil = light.veil / weights;
    const float sent = linear(paint.diffuse) * light.diffuse[channel] +
                       (facing + veil * (1 - facing)) * light.specular[channel];
    return 255 * srgbEncoded(sent / weights);
}

std::uint32_t byteOf(float value) {
    const float above = std::clamp(value, 0.0F, 255.0F) + 0.5F;
    return static_cast<std::uint32_t>(above);
}

float coveredOf(const Quarters& quarters) {
    float out = 0;
    for (const std::uint32_t quarter : quarters)
        out += numberOf(quarter) != 0 && numberOf(quarter) != kCatcherNumber ? 0.25F : 0;
    return out;
}

}  // namespace

RestPixels::RestPixels(const ViewLookUp::Input& input, const TracedPicture& traced,
                       std::span<const LightWords> lights, const ViewLookUpInput& plain,
                       const LensProjection& layer, const RigidTransform& T_world_camera)
    : plain_(plain), layerLens_(pointLensOf(layer)), traced_{traced.surface, traced.colour,
                                                             lights,         traced.camera.size,
                                                             plain.toTraced, {},
                                                             &plain_.lens,   1} {
    if (plain.ofNumbers != nullptr) traced_.ofNumbers = {plain.ofNumbers, params::kSurfaceNumbers};
    // Sorts the re-rendered pictures by Picture::slot. The order must be fixed, because known()
    // uses the first of several pictures with equal shares.
    std::array<const RerenderedPictures::Picture*, RerenderedPictures::kPictures> bySlot{};
    for (const RerenderedPictures::Picture& rerendered : input.rerendered.pictures())
        bySlot[static_cast<std::size_t>(rerendered.slot)] = &rerendered;
    for (const RerenderedPictures::Picture* rerendered : bySlot) {
        if (rerendered == nullptr || !(rerendered->share > 0)) continue;
        const RerenderedStore::Picture& picture = input.store[rerendered->slot];
        if (picture.surfaces.empty()) continue;
        const auto place = static_cast<std::size_t>(rerenderedCount_++);
        ofNumbers_[place] =
            transformsByNumber(viewsOfObjects(rerendered->T_world_camera, rerendered->poses,
                                              input.raster.models().objects(), T_world_camera));
        rerendered_[place] = {
            picture.surfaces,
            picture.colours,
            picture.lights,
            layer.camera.size,
            pointTransformOf(rerendered->T_world_camera.inverse() * T_world_camera),
            ofNumbers_[place],
            &layerLens_,
            static_cast<float>(rerendered->share)};
    }
}

/// Projects `wanted.point`, which is in coordinates of the layer's camera, into a view. `at`
/// becomes the pixel and z [m] there. Returns false if the view does not show the point.
bool RestPixels::inView(const View& view, const Wanted& wanted, Point3& at) {
    const Point3& point = wanted.point;
    const PointTransform& T = view.ofNumbers.empty()
                                  ? view.fromCamera
                                  : view.ofNumbers[static_cast<std::size_t>(wanted.id)];
    const Point3 there = transformed(T, point);
    if (!(there.z > view.lens->nearest && there.z < 1e6F && point.z > 0)) return false;
    const Point3 h = projected(*view.lens, there);
    at = {h.x / h.z, h.y / h.z, there.z};
    return at.x > -1 && at.y > -1 && at.x < static_cast<float>(view.size.width) &&
           at.y < static_cast<float>(view.size.height);
}

/// Interpolates a surface's colour bilinearly between the texels around `at` that show the surface.
/// Returns false if the sum of their weights is at most kLeastLookUpWeight. For the shadow catcher,
/// texels without any surface count as shadow catcher without shadow.
bool RestPixels::lookUp(const View& view, const Point3& at, const Wanted& wanted, Colour& found) {
    const float lowX = std::floor(at.x), lowY = std::floor(at.y);
    const float fx = at.x - lowX, fy = at.y - lowY;
    const int x0 = static_cast<int>(lowX), y0 = static_cast<int>(lowY);
    const bool isLit = !view.lights.empty() && wanted.id != kCatcherId;
    Colour sum;
    UnpackedLight light;
    float weights = 0;
    for (int i = 0; i < 4; ++i) {
        const int right = i & 1, down = i >> 1, x = x0 + right, y = y0 + down;
        if (x < 0 || y < 0 || x >= view.size.width || y >= view.size.height) continue;
        const std::size_t t = static_cast<std::size_t>(y) * view.size.width + x;
        const WarpSurface& s = view.surfaces[t];
        const bool same = s.id == wanted.id ? std::abs(s.z - at.z) < s.tolerance
                                            : s.id == 0 && wanted.id == kCatcherId;
        if (!same || !(s.known > 0.5F)) continue;
        const float w = (right != 0 ? fx : 1 - fx) * (down != 0 ? fy : 1 - fy);
        weights += w;
        if (isLit) {
            addShare(light, w, unpackedWords(view.lights[t]));
        } else {
            for (std::size_t c = 0; c < 4; ++c)
                sum.rgba[c] += w * static_cast<float>(view.colours[t][c]);
        }
    }
    if (!(weights > params::kLeastLookUpWeight)) return false;
    for (std::size_t c = 0; c < 4; ++c)
        found.rgba[c] = isLit ? lit(wanted.paint, c, light, weights) : sum.rgba[c] / weights;
    return true;
}

/// Looks up a surface's colour in the traced picture. An object that the traced picture does not
/// show is looked up in the re-rendered pictures. Returns the share of the colour that is known,
/// [0, 1].
float RestPixels::known(const Wanted& wanted, Colour& found) const {
    Point3 at;
    const bool inTraced = inView(traced_, wanted, at);
    if (inTraced && lookUp(traced_, at, wanted, found)) return 1;
    found = {};
    // Outside the traced picture, the shadow catcher's colour is unknown. It nevertheless counts as
    // known and without shadow, so that it is not filled.
    if (wanted.id == kCatcherId) return inTraced ? 0.0F : 1.0F;
    float share = 0;
    for (int i = 0; i < rerenderedCount_; ++i) {
        const View& rerendered = rerendered_[static_cast<std::size_t>(i)];
        Colour own;
        if (rerendered.share <= share || !inView(rerendered, wanted, at) ||
            !lookUp(rerendered, at, wanted, own))
            continue;
        share = rerendered.share;
        found = own;
    }
    return share;
}

bool RestPixels::needsPaint() const {
    const std::span rerendered(rerendered_.data(), static_cast<std::size_t>(rerenderedCount_));
    return !traced_.lights.empty() ||
           std::ranges::any_of(rerendered, [](const View& v) { return !v.lights.empty(); });
}

RestPixel RestPixels::at(const Asked& asked) const {
    const float rayX = asked.rayX, rayY = asked.rayY;
    const Quarters s{asked.upper[0], asked.upper[1], asked.lower[0], asked.lower[1]};
    const std::uint32_t id = mostOf(s);
    const Point3 object = middleOf(s, id);
    Point3 catcher = middleOf(s, kCatcherNumber);
    const float covered = coveredOf(s);
    if (catcher.z == 0) catcher.z = plain_.plane.depthAlong(rayX, rayY, layerLens_.nearest);
    const float below = catcher.z > 0 ? 1 - covered : 0;
    const auto pointAt = [&](const Point3& middle) {
        return scaled(middle.z,
                      {rayX + middle.x / layerLens_.fx, rayY + middle.y / layerLens_.fy, 1});
    };
    const Point3 point = pointAt(object), under = pointAt(catcher);
    Colour ofObject, ofCatcher;
    const float objectKnown =
        covered > 0 ? known({point, static_cast<float>(id), asked.paint}, ofObject) : 1;
    const float catcherKnown = below > 0 ? known({under, kCatcherId, {}}, ofCatcher) : 1;
    RestPixel out{};
    for (std::size_t c = 0; c < 4; ++c) {
        const float shown =
            covered * objectKnown * ofObject.rgba[c] + below * catcherKnown * ofCatcher.rgba[c];
        out.colour |= byteOf(shown) << 8 * c;
    }
    const bool missed = objectKnown < 1, hole = missed || catcherKnown < 1;
    const bool isOpen = objectKnown == 0 && covered == 1;
    // An edge pixel without a known colour is not rendered individually: the result would be a
    // mixture of the surfaces at the edge. It is filled from its neighbours instead.
    const bool edge = (missed ? covered : below) < 1;
    if (covered > 0)
        out.depth = object.z;
    else if (hole || out.colour != 0)
        out.depth = plain_.shownDepth * catcher.z;
    const std::uint32_t plain = hole ? 0 : covered == 1 ? id : below == 1 ? kCatcherNumber : 0;
    const std::uint32_t missing = missed ? id : hole ? kCatcherNumber : 0;
    const float part = missed ? covered * (1 - objectKnown) : below * (1 - catcherKnown);
    out.state = missing | byteOf(255 * part) << 8 | (isOpen ? 255U : 0U) << 16 | plain << 24;
    if (hole) out.hole = Hole{0, out.colour, edge, isOpen};
    return out;
}

}  // namespace mfar::simd
