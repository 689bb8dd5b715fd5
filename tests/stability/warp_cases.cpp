#include "pipeline/gles/edge_refiner.h"
#include "tests/stability/cases.h"
#include "tests/warp/warp_support.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

namespace mfar::stress {
namespace {

constexpr double kDistance = 0.6;

test::CastScene ballsOf(Context& c) {
    test::CastScene out;
    out.shadows = c.hostile.chance(0.7);
    for (int i = c.hostile.integer(1, 3); i > 0; --i)
        out.balls.push_back(
            {{c.hostile.real(-0.15, 0.15), c.hostile.real(-0.15, 0.15), c.hostile.real(0.02, 0.15)},
             c.hostile.logarithmic(1e-3, 0.1)});
    return out;
}

RigidTransform around(Context& c) {
    return test::orbit(c.hostile.real(0, 360),
                       kDistance * c.hostile.pick({1.0, 1.0, 0.1, 0.25, 30.0}),
                       c.hostile.real(5, 85));
}

/// Replaces some depths, object numbers and colours by values that no renderer produces.
void spoilPicture(Context& c, std::vector<float>& depth, std::vector<std::uint8_t>& id,
                  std::vector<std::array<std::uint8_t, 4>>& colour, double share) {
    for (std::size_t i = 0; i < depth.size(); ++i) {
        if (c.hostile.chance(share)) depth[i] = static_cast<float>(c.hostile.bad());
        if (c.hostile.chance(share)) id[i] = static_cast<std::uint8_t>(c.hostile.integer(0, 255));
        if (c.hostile.chance(share))
            colour[i][c.hostile.integer(0, 3)] =
                static_cast<std::uint8_t>(c.hostile.integer(0, 255));
    }
}

std::uint32_t anyWord(Context& c) {
    return static_cast<std::uint32_t>(c.hostile.integer(0, 0xFFFF)) << 16 |
           static_cast<std::uint32_t>(c.hostile.integer(0, 0xFFFF));
}

std::vector<LightWords> anyLight(Context& c, std::size_t pixels) {
    std::vector<LightWords> out(pixels);
    for (LightWords& words : out)
        words = {anyWord(c), anyWord(c)};
    return out;
}

std::shared_ptr<const MirrorLight> anyMirrors(Context& c) {
    auto out = std::make_shared<MirrorLight>();
    const int tables = c.hostile.integer(1, 4);
    for (int i = 0; i < tables; ++i) {
        const int edge = c.hostile.integer(2, 17);
        const float roughness = static_cast<float>(i) / 4;
        out->tables.push_back({roughness, edge, static_cast<std::uint32_t>(out->texels.size())});
        for (int texel = 0; texel < edge * edge; ++texel)
            out->texels.push_back(anyWord(c));
    }
    const Eigen::Vector3d sun = c.hostile.direction().normalized();
    for (std::size_t i = 0; i < 3; ++i) {
        out->towardsSun[i] = static_cast<float>(sun[static_cast<Eigen::Index>(i)]);
        out->sunIrradiance[i] = static_cast<float>(c.hostile.pick({0.0, 1.0, 1e4}));
    }
    out->leastSunAlpha = static_cast<float>(c.hostile.pick({0.0, 0.005, 1.0}));
    out->least = static_cast<float>(c.hostile.pick({0.0, 0.01}));
    return out;
}

/// Adds light whose words have any bits, and often the distant light that surfaces mirror.
void addLight(Context& c, RenderedPicture& picture) {
    picture.light = anyLight(c, picture.id.size());
    if (c.hostile.chance(0.3)) return;
    for (std::size_t i = 0; i < picture.id.size(); ++i)
        picture.gloss.push_back({anyWord(c), anyWord(c)});
    picture.mirrors = anyMirrors(c);
    picture.exposure = static_cast<float>(c.hostile.logarithmic(1e-3, 1e3));
}

WarpOptions warpOptions(Context& c) {
    WarpOptions out;
    out.filling = c.hostile.pick({HoleFilling::None, HoleFilling::PushPull, HoleFilling::Rerender,
                                  HoleFilling::Both, HoleFilling::Both});
    out.mostRequested = c.hostile.pick({1, 100, 15360});
    out.sharpenShare = c.hostile.pick({0.0, 0.15, 1.0});
    out.fadeFrames = c.hostile.integer(0, 5);
    out.leastMotion = c.hostile.pick({0.0, 0.1});
    return out;
}

std::unique_ptr<Engine> engineOf(Context& c) {
    return test::warpEngine(c.hostile.pick({EngineKind::Gles, EngineKind::Simd}));
}

void checkLayer(Context& c, const LayerPicture& layer) {
    if (layer.bounds.empty()) return;
    const Size size = layer.depth.size();
    const auto depth = test::valuesOf(layer.depth);
    const auto colour = test::bytesOf(layer.colour);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const std::size_t i = 4 * (static_cast<std::size_t>(y) * size.width + x);
            c.checks.within(depth[i / 4], 0, kFarthestSurface, "depth of a warped layer");
            const bool inside = x >= layer.bounds.x0 && x < layer.bounds.x1 &&
                                y >= layer.bounds.y0 && y < layer.bounds.y1;
            c.checks.require(inside || colour[i + 3] == 0,
                             "the warped layer is drawn outside of its bounds");
        }
}

void showFrame(Context& c, Warp& warp, const test::CastScene& balls, const RigidTransform& pose,
               double spoilt) {
    checkLayer(c, warp.run(pose));
    c.gl.frame(c.checks, pixelsOf(warp.camera().size));
    const auto request = warp.takeRequest();
    if (!request) return;
    c.checks.require(isFinite(request->view.T_world_camera),
                     "a request for pixels has a view that is not finite");
    HoleAnswer answer = test::answered(balls, *request, 1);
    spoilPicture(c, answer.depth, answer.id, answer.colour, spoilt);
    if (c.hostile.chance(0.5)) answer.light = anyLight(c, answer.pixels.size());
    warp.answer(answer);
}

void hostileWarp(Context& c) {
    const test::CastScene balls = ballsOf(c);
    const Size size = c.size(1, 90), output = c.hostile.chance(0.5) ? size : c.size(1, 90);
    const CameraModel camera = c.hostile.camera(size);
    const double spoilt = c.hostile.pick({0.0, 0.02, 0.5});
    const auto engine = engineOf(c);
    Warp warp(camera, output, *engine, warpOptions(c));
    warp.setScene(balls.scene(c.hostile.pick({3, 12, 48})));
    const RigidTransform from = around(c);
    const auto shoot = [&] {
        RenderedPicture picture = balls.cast({camera, from});
        spoilPicture(c, picture.depth, picture.id, picture.colour, spoilt);
        if (c.hostile.chance(0.7)) addLight(c, picture);
        return tracedPicture(picture);
    };
    warp.setTracedPicture(shoot());
    for (int frame = 0; frame < 5; ++frame) {
        RigidTransform pose = c.hostile.chance(0.6) ? from * c.hostile.gentle(0.3) : around(c);
        if (c.hostile.chance(0.1)) pose = from * c.hostile.motion();
        if (c.hostile.chance(0.1)) pose = c.hostile.spoilt(pose);
        showFrame(c, warp, balls, pose, spoilt);
        if (c.hostile.chance(0.1)) warp.setTracedPicture(shoot());
        if (c.hostile.chance(0.1)) warp.dropTracedPicture();
    }
    if (c.hostile.chance(0.5)) return;
    // Edges are sharpened only if the camera rests.
    const RigidTransform rest = from * c.hostile.gentle(0.3);
    for (int frame = 0; frame < 12; ++frame)
        showFrame(c, warp, balls, rest, spoilt);
}

// An older picture, warped to a new pose, must show points of the scene at their new positions.
void knownWarp(Context& c) {
    test::CastScene balls = test::twoBalls();
    balls.contrast = 0.5;
    const CameraModel camera = test::bentCamera(c.size(160, 220));
    WarpOptions options = warpOptions(c);
    options.filling = c.hostile.pick({HoleFilling::PushPull, HoleFilling::Both});
    const auto engine = engineOf(c);
    Warp warp(camera, camera.size, *engine, options);
    warp.setScene(balls.scene());
    const double from = c.hostile.real(0, 360), by = c.hostile.real(-3, 3);
    warp.setTracedPicture(tracedPicture(balls.cast({camera, test::orbit(from)}, 3)));
    const RigidTransform now = test::orbit(from + by);
    const LayerPicture& layer = warp.run(now);
    const RenderedPicture truth = balls.cast({camera, now}, 3);
    c.checks.within(test::psnrInside(test::bytesOf(layer.colour), truth), 33.5, 200,
                    "PSNR of a warped picture [dB]");
    checkLayer(c, layer);
    c.gl.frame(c.checks, pixelsOf(camera.size));
}

struct WarpedColours {
    std::vector<std::uint8_t> rgba;
    int openHoles;
};

WarpedColours warpedBy(EngineKind kind, const CameraModel& camera, const WarpOptions& options,
                       const test::CastScene& balls, double degrees) {
    const auto engine = test::warpEngine(kind);
    Warp warp(camera, camera.size, *engine, options);
    warp.setScene(balls.scene());
    warp.setTracedPicture(tracedPicture(balls.cast({camera, test::orbit(0)}, 2)));
    const LayerPicture& layer = warp.run(test::orbit(degrees));
    WarpedColours out{test::bytesOf(layer.colour), 0};
    engine->finish();
    (void)warp.takeRequest();
    out.openHoles = warp.counters().openHoles;
    return out;
}

// Both engines must fill the holes with the same colours, also after a large turn.
void engineWarps(Context& c) {
    const test::CastScene balls = ballsOf(c);
    const CameraModel camera = test::bentCamera(c.size(160, 220));
    const WarpOptions options{.filling =
                                  c.hostile.pick({HoleFilling::None, HoleFilling::PushPull})};
    const double degrees = c.hostile.pick({-1, 1}) * c.hostile.real(10, 60);
    const WarpedColours gles = warpedBy(EngineKind::Gles, camera, options, balls, degrees);
    const WarpedColours simd = warpedBy(EngineKind::Simd, camera, options, balls, degrees);
    int apart = 0;
    for (std::size_t i = 0; i < gles.rgba.size(); ++i)
        apart += std::abs(gles.rgba[i] - simd.rgba[i]) > 8 ? 1 : 0;
    // A few pixels at silhouettes may differ, because rounding decides which surface they show.
    c.checks.within(apart, 0, 30, "number of colour channels in which the engines differ");
    c.checks.within(gles.openHoles - simd.openHoles, -3, 3, "difference of the numbers of holes");
    c.gl.frame(c.checks, pixelsOf(camera.size));
}

using Pixels = std::vector<std::array<std::uint8_t, 4>>;

Pixels unpacked(const TestPicture& picture) {
    Pixels out;
    for (std::size_t i = 0; i < picture.bytes.size(); i += 4)
        out.push_back(
            {picture.bytes[i], picture.bytes[i + 1], picture.bytes[i + 2], picture.bytes[i + 3]});
    return out;
}

gpu::Texture textureOf(Size size, const Pixels& pixels) {
    gpu::Texture out(size, gpu::TexelFormat::Rgba8);
    out.uploadRows(pixels);
    return out;
}

/// Oracle of warp_edges.comp: the largest difference of a colour channel in 3x3 pixels, as one of
/// kLevels equal steps.
int contrastAt(const Pixels& pixels, Size size, const PixelRect& where, int x, int y) {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        int low = 255, high = 0;
        for (int v = std::max(y - 1, where.y0); v <= std::min(y + 1, where.y1 - 1); ++v)
            for (int u = std::max(x - 1, where.x0); u <= std::min(x + 1, where.x1 - 1); ++u) {
                const int value = pixels[static_cast<std::size_t>(v) * size.width + u][c];
                low = std::min(low, value);
                high = std::max(high, value);
            }
        most = std::max(most, high - low);
    }
    return std::min(most * EdgeRefiner::kLevels / 255, EdgeRefiner::kLevels - 1);
}

/// Returns the pixels of the highest contrast level, and those of the next lower levels down to
/// level 3, as long as their total number is at most `share` times the number of the objects'
/// pixels.
std::vector<std::uint32_t> edgesOf(const Pixels& colour, const Pixels& state, Size size,
                                   const PixelRect& where, double share) {
    std::array<std::vector<std::uint32_t>, EdgeRefiner::kLevels> byLevel;
    int objects = 0;
    for (int y = where.y0; y < where.y1; ++y)
        for (int x = where.x0; x < where.x1; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * size.width + x;
            byLevel[contrastAt(colour, size, where, x, y)].push_back(static_cast<unsigned>(i));
            objects += state[i][3] > 0 && state[i][3] < 255 ? 1 : 0;
        }
    const auto most =
        static_cast<std::size_t>(static_cast<float>(share) * static_cast<float>(objects));
    std::vector<std::uint32_t> out = byLevel.back();
    for (int l = EdgeRefiner::kLevels - 2; l >= 3; --l) {
        if (out.size() + byLevel[l].size() > most) break;
        out.insert(out.end(), byLevel[l].begin(), byLevel[l].end());
    }
    std::ranges::sort(out);
    return out;
}

PixelRect partOf(Context& c, Size size) {
    if (c.hostile.chance(0.5)) return {0, 0, size.width, size.height};
    const int x = c.hostile.integer(0, size.width - 1), y = c.hostile.integer(0, size.height - 1);
    return {x, y, c.hostile.integer(x + 1, size.width), c.hostile.integer(y + 1, size.height)};
}

HoleAnswer answerOf(Context& c, const std::vector<std::uint32_t>& listed, Size size) {
    HoleAnswer out;
    for (const std::uint32_t pixel : listed)
        if (c.hostile.chance(0.9)) out.pixels.push_back(pixel);
    const long count = static_cast<long>(size.width) * size.height;
    for (int i = c.hostile.integer(0, 5); i > 0; --i)
        out.pixels.push_back(static_cast<std::uint32_t>(c.hostile.integer(0, int(count) - 1)));
    std::ranges::sort(out.pixels);
    out.pixels.erase(std::ranges::unique(out.pixels).begin(), out.pixels.end());
    for (std::size_t i = 0; i < out.pixels.size(); ++i) {
        const auto byte = [&] { return static_cast<std::uint8_t>(c.hostile.integer(0, 255)); };
        out.colour.push_back({byte(), byte(), byte(), byte()});
    }
    return out;
}

// Edges must be found in random pictures, not only in pictures of surfaces.
void edges(Context& c) {
    const Size size = c.size(1, 90);
    const double share = c.hostile.pick({0.01, 0.15, 1.0});
    const int fade = c.hostile.integer(0, 3);
    EdgeRefiner refiner(size, share, size.width * size.height, fade);
    for (int round = 0; round < 4; ++round) {
        const Pixels before = unpacked(c.hostile.picture(size));
        const Pixels numbers = unpacked(c.hostile.picture(size));
        const gpu::Texture colour = textureOf(size, before), state = textureOf(size, numbers);
        const PixelRect where = partOf(c, size);
        refiner.list(colour, state, where);
        glFinish();
        const auto listed = refiner.poll();
        const auto wanted = edgesOf(before, numbers, size, where, share);
        c.checks.require(listed && *listed == wanted,
                         "the list of pixels at edges differs from the oracle's");
        const HoleAnswer answer = answerOf(c, wanted, size);
        refiner.answer(answer);
        for (int frame = 0; frame <= fade; ++frame)
            refiner.show(colour);
        Pixels after = before;
        for (std::size_t i = 0; i < answer.pixels.size(); ++i)
            if (std::ranges::binary_search(wanted, answer.pixels[i]))
                after[answer.pixels[i]] = answer.colour[i];
        const auto shown = colour.readRgba8();
        for (std::size_t i = 0; i < shown.size(); ++i)
            c.checks.within(shown[i] - after[i / 4][i % 4], -1, 1, "error of a sharpened edge");
        c.gl.frame(c.checks, pixelsOf(where));
    }
}

}  // namespace

std::vector<Case> warpCases() {
    return {{"warp", hostileWarp, true},
            {"warp-truth", knownWarp},
            {"warp-engines", engineWarps},
            {"warp-edges", edges, true}};
}

}  // namespace mfar::stress
