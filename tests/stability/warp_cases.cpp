// The warp of the virtual layer: pictures that are spoilt, poses they were not made for.
#include "tests/stability/cases.h"
#include "tests/warp/warp_support.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mfar::stress {
namespace {

constexpr double kDistance = 0.6;  // of the camera from the scene [m]

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

/// Depths, numbers and colours that no renderer gives.
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

WarpOptions warpOptions(Context& c) {
    WarpOptions out;
    out.depth = c.hostile.pick({WarpDepth::Model, WarpDepth::Splatted});
    out.filling = c.hostile.pick({HoleFilling::None, HoleFilling::PushPull, HoleFilling::Rerender,
                                  HoleFilling::Both, HoleFilling::Both});
    out.mostRequested = c.hostile.pick({1, 100, 15360});
    out.sharpenShare = c.hostile.pick({0.0, 0.15, 1.0});
    out.fadeFrames = c.hostile.integer(0, 5);
    out.leastMotion = c.hostile.pick({0.0, 0.1});
    return out;
}

void checkLayer(Context& c, const VirtualLayer& layer) {
    if (layer.depth == nullptr || layer.bounds.empty()) return;
    const Size size = layer.depth->size();
    const auto depth = layer.depth->readRgba32F();
    const auto colour = layer.colour->readRgba8();
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const std::size_t i = 4 * (static_cast<std::size_t>(y) * size.width + x);
            c.checks.within(depth[i], 0, kFarthestSurface, "depth of a warped layer");
            const bool inside = x >= layer.bounds.x0 && x < layer.bounds.x1 &&
                                y >= layer.bounds.y0 && y < layer.bounds.y1;
            c.checks.require(inside || colour[i + 3] == 0, "warped outside of its bounds");
        }
}

/// One frame, in which what is asked for is answered.
void showFrame(Context& c, Warp& warp, const test::CastScene& balls, const RigidTransform& pose,
               double spoilt) {
    checkLayer(c, warp.run(pose));
    c.gl.frame(c.checks, pixelsOf(warp.camera().size));
    const auto request = warp.takeRequest();
    if (!request) return;
    c.checks.require(isFinite(request->view.T_world_camera), "a view that is not finite");
    HoleAnswer answer = test::answered(balls, *request, 1);
    spoilPicture(c, answer.depth, answer.id, answer.colour, spoilt);
    warp.answer(answer);
}

void hostileWarp(Context& c) {
    const test::CastScene balls = ballsOf(c);
    const Size size = c.size(1, 90), output = c.hostile.chance(0.5) ? size : c.size(1, 90);
    const CameraModel camera = c.hostile.camera(size);
    const double spoilt = c.hostile.pick({0.0, 0.02, 0.5});
    Warp warp(camera, output, warpOptions(c));
    warp.setScene(balls.scene(c.hostile.pick({3, 12, 48})));
    const RigidTransform from = around(c);
    const auto shoot = [&] {
        RenderedPicture picture = balls.cast({camera, from});
        spoilPicture(c, picture.depth, picture.id, picture.colour, spoilt);
        return warpReference(picture);
    };
    warp.setReference(shoot());
    for (int frame = 0; frame < 5; ++frame) {
        RigidTransform pose = c.hostile.chance(0.6) ? from * c.hostile.gentle(0.3) : around(c);
        if (c.hostile.chance(0.1)) pose = from * c.hostile.motion();
        if (c.hostile.chance(0.1)) pose = c.hostile.spoilt(pose);
        showFrame(c, warp, balls, pose, spoilt);
        if (c.hostile.chance(0.1)) warp.setReference(shoot());
        if (c.hostile.chance(0.1)) warp.dropReference();
    }
    if (c.hostile.chance(0.5)) return;
    const RigidTransform rest = from * c.hostile.gentle(0.3);  // edges are sharpened there
    for (int frame = 0; frame < 12; ++frame)
        showFrame(c, warp, balls, rest, spoilt);
}

// What an older picture shows of the scene is where the scene has it.
void knownWarp(Context& c) {
    test::CastScene balls = test::twoBalls();
    balls.contrast = 0.5;
    const CameraModel camera = test::bentCamera(c.size(160, 220));
    WarpOptions options = warpOptions(c);
    options.filling = c.hostile.pick({HoleFilling::PushPull, HoleFilling::Both});
    Warp warp(camera, camera.size, options);
    warp.setScene(balls.scene());
    const double from = c.hostile.real(0, 360), by = c.hostile.real(-3, 3);
    warp.setReference(warpReference(balls.cast({camera, test::orbit(from)}, 3)));
    const RigidTransform now = test::orbit(from + by);
    const VirtualLayer& layer = warp.run(now);
    const RenderedPicture truth = balls.cast({camera, now}, 3);
    c.checks.within(test::psnrInside(layer.colour->readRgba8(), truth), 33.5, 200,
                    "a warped picture against truth [dB]");
    checkLayer(c, layer);
    c.gl.frame(c.checks, pixelsOf(camera.size));
}

}  // namespace

std::vector<Case> warpCases() {
    return {{"warp", hostileWarp, true}, {"warp-truth", knownWarp}};
}

}  // namespace mfar::stress
