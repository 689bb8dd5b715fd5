#include "base/luminance.h"
#include "pipeline/render/film.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr float kDisplayGamma = 2.2F;

std::uint8_t quantised(float value) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0F, 1.0F)));
}

}  // namespace

GlossWords Film::gloss(std::size_t pixel) const {
    const SeenSurface& seen = at(pixel).seen;
    if (seen.hit.id == 0 || seen.hit.id == kCatcherId) return {};
    return packedGloss({seen.normal.x(), seen.normal.y(), seen.normal.z()}, seen.roughness,
                       luminanceOf<float>(seen.paint.facing), seen.paint.albedo.full());
}

Film::Shown Film::shown(const Means& m, const Exposure& exposure) {
    Shown out{m.objectShare * displayed(m.object, exposure), m.objectShare};
    if (m.with == m.without) return out;
    Eigen::Vector3f ratio{1, 1, 1};
    for (int c = 0; c < 3; ++c)
        if (m.without[c] > 0) ratio[c] = std::pow(m.with[c] / m.without[c], 1 / kDisplayGamma);
    const float kept = std::min(1.0F, ratio.minCoeff());
    for (int c = 0; c < 3; ++c) {
        if (m.without[c] > 0 && !(ratio[c] > kept)) continue;
        const float unlit = srgbEncoded(m.without[c] * exposure.scale);
        const float added =
            unlit > 0 ? unlit * (ratio[c] - kept) : srgbEncoded(m.with[c] * exposure.scale);
        out.colour[c] += m.catcherShare * std::min(added, 1.0F);
    }
    out.coverage += m.catcherShare * (1 - kept);
    return out;
}

FirstHit Film::firstHit(const Pixel& p, bool changed) {
    if (!changed) return {};
    const bool objects = p.objectHits > 0;
    if (p.seen.hit.id != 0 && p.seen.hit.id != kCatcherId) return p.seen.hit;
    const bool catches = p.catcher.first.squares > 0 || p.carried.firstSquare > 0;
    if (p.seen.hit.id == kCatcherId && (catches || !objects)) return p.seen.hit;
    if (catches && !objects) return p.nearestCatcher;
    return objects ? p.nearest : FirstHit{};
}

Film::Shown Film::shown(const Pixel& p, const Exposure& exposure) {
    if (p.objectHits == 0 && p.catcher.first.light.isZero(0)) return {};
    return shown(meansOf(p), exposure);
}

Film::Resolved Film::resolved(std::size_t pixel, const Exposure& exposure) const {
    const Pixel& p = at(pixel);
    Resolved out = resolved(p, shown(p, exposure));
    if (out.hit.id != 0 && out.hit.id != kCatcherId) {
        const SurfaceLight light =
            p.object.hits > 0 ? SurfaceLight{p.object.first.relative(), p.object.second.relative()}
                              : relativeOf(p.carried);
        out.light = packed(product(light, farOf(p)), paintOf(p), exposure.scale);
    }
    return out;
}

// Unknown light is shown as if no object shaded the surface.
SurfaceLight Film::relativeOf(const KnownLight& light) {
    return {light.firstCount > 0 ? light.first : Eigen::Vector3f(1, 1, 1),
            light.secondCount > 0 ? light.second : Eigen::Vector3f(1, 1, 1)};
}

Film::Resolved Film::resolvedFrom(const LightPixel& light, std::size_t pixel,
                                  const Exposure& exposure, bool layered) const {
    const Pixel& p = at(pixel);
    if (light.id == 0) return resolved(pixel, exposure);
    Means m;
    LightWords words;
    if (light.id == kCatcherId) {
        if (light.first.isZero(0) && (layered || isWhole(p))) return {};
        m.without = light.second.matrix();
        // Both parts were filtered separately, so their sum may be negative in a deep shadow.
        m.with = (light.first + light.second).max(0.0F).matrix();
        m.catcherShare = 1;
    } else {
        const SurfaceLight onObject =
            product(relativeOf({light.first.matrix(), light.second.matrix(), 0, 0, light.firstCount,
                                light.secondCount}),
                    farOf(p));
        const Paint paint = paintOf(p);
        m.object = onObject.on(paint);
        words = packed(onObject, paint, exposure.scale);
        m.objectShare = 1;
    }
    const bool mixed = !layered && !isWhole(p);
    Resolved out = resolved(p, mixed ? shown(p, exposure) : shown(m, exposure));
    out.light = words;
    // In a layered picture (see RenderedPicture), a pixel shows only the surface at its centre. If
    // this is the shadow catcher, the filter may have taken the shadow from neighbouring pixels
    // only: all samples of the pixel itself hit an object. Then resolved() has returned this
    // object's hit.
    const bool onCatcher = light.id == kCatcherId && p.seen.hit.id == kCatcherId;
    if (layered && onCatcher && out.hit.id != 0) out.hit = p.seen.hit;
    return out;
}

Film::Resolved Film::resolved(const Pixel& p, const Shown& s) {
    Resolved out;
    out.colour = {quantised(s.colour.x()), quantised(s.colour.y()), quantised(s.colour.z()),
                  quantised(s.coverage)};
    out.hit = firstHit(p, out.colour != std::array<std::uint8_t, 4>{});
    return out;
}

}  // namespace mfar
