#include "pipeline/composite/preview_renderer.h"
#include "pipeline/composite/silhouette.h"
#include "pipeline/gles/layer_composite.h"
#include "pipeline/results.h"
#include "tests/oracle/ray_cast.h"
#include "tests/oracle/visibility.h"
#include "tests/stability/cases.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mfar::stress {
namespace {

using gpu::TexelFormat;

double hostileOr(Context& c, double share, double value) {
    return c.hostile.chance(share) ? c.hostile.bad() : value;
}

CompositeOptions compositeOptions(Context& c) {
    return {.bias = c.hostile.pick({0.0, 0.5, 3.0}),
            .softness = c.hostile.pick({0.01, 1.0, 30.0}),
            .virtualSigma = c.hostile.pick({0.0, 0.003, 1.0}),
            .likeness = c.hostile.pick({0.1, 12.0, 1000.0})};
}

struct Layer {
    std::vector<float> z;
    std::vector<std::uint8_t> colour;
};

Layer layerOf(Context& c, Size output, double unit) {
    Layer out;
    const double near = c.hostile.logarithmic(0.3, 3) * unit;
    for (long i = 0; i < pixelsOf(output); ++i) {
        const bool there = c.hostile.chance(0.8);
        out.z.push_back(
            static_cast<float>(there ? hostileOr(c, 0.02, near * c.hostile.real(0.7, 1.4)) : 0.0));
        const auto alpha =
            static_cast<std::uint8_t>(there ? c.hostile.pick({255, 255, 100, 0}) : 0);
        for (int k = 0; k < 4; ++k)
            out.colour.push_back(alpha);
    }
    return out;
}

std::vector<twin::RealSample> realOf(Context& c, Size video, double unit) {
    std::vector<twin::RealSample> out;
    for (long i = 0; i < pixelsOf(video); ++i)
        out.push_back(
            {static_cast<float>(hostileOr(c, 0.05, c.hostile.real(0.3, 3) / unit)),
             static_cast<float>(hostileOr(c, 0.05, c.hostile.logarithmic(1e-3, 0.3) / unit))});
    return out;
}

void compositing(Context& c) {
    const Size video = c.size(1, 60);
    const Size output{video.width * c.hostile.integer(1, 3) + c.hostile.integer(0, 2),
                      video.height * c.hostile.integer(1, 3) + c.hostile.integer(0, 2)};
    const double unit = c.hostile.pick({1e-3, 1.0, 1.0, 1e3});
    const CompositeOptions options = compositeOptions(c);
    twin::Scene scene{c.hostile.picture(video), c.hostile.picture(output), realOf(c, video, unit)};
    const Layer layer = layerOf(c, output, unit);
    gpu::Texture colour(output, TexelFormat::Rgba8), depth(output, TexelFormat::R32F);
    gpu::Texture real(video, TexelFormat::Rg32F);
    std::vector<float> samples;
    for (const twin::RealSample& s : scene.real)
        samples.insert(samples.end(),
                       {static_cast<float>(s.inverseDepth), static_cast<float>(s.sigma)});
    colour.upload(PlaneView{layer.colour.data(), 4UL * output.width});
    depth.upload(layer.z);
    real.upload(samples);
    const gpu::Texture frame = uploaded(scene.video), picture = uploaded(scene.picture);
    const gpu::Texture target = uploaded(scene.picture);
    LayerComposite composite(video, output, options);
    composite.run({&colour, &depth, {0, 0, output.width, output.height}}, real, frame, picture,
                  gpu::Framebuffer(target));
    const auto seen = composite.visibility().readRgba8();
    const auto shown = target.readRgba8();
    c.gl.frame(c.checks, pixelsOf(output));
    for (int y = 0; y < output.height; ++y)
        for (int x = 0; x < output.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * output.width + x;
            const double wanted = scene.visibility(x, y, layer.z[i], options);
            // With a softness below 1, visibility changes so steeply with depth that rounding to
            // single precision may give any value. So only NaN is a fault.
            const double slack = options.softness >= 1 ? 0.012 : 1;
            c.checks.within(seen[4 * i] / 255.0 - wanted, -slack, slack, "error of visibility");
            const double over = layer.colour[4 * i + 3] / 255.0 * seen[4 * i];
            const double below = 1 - over / 255.0;
            c.checks.within(shown[4 * i] - (over + below * scene.picture.at(x, y)[0]), -1.6, 1.6,
                            "error of a blended pixel");
        }
}

VirtualObject objectOf(Context& c) {
    VirtualObject o;
    o.shape = c.hostile.pick({VirtualShape::Box, VirtualShape::Sphere, VirtualShape::Quad});
    const bool wild = c.hostile.chance(0.5);
    const double most = wild ? 1e3 : 1;
    o.size = {c.hostile.logarithmic(0.05, most), c.hostile.logarithmic(0.05, most),
              c.hostile.logarithmic(0.05, most)};
    o.T_world_object = {
        c.hostile.turn(),
        {c.hostile.real(-1, 1), c.hostile.real(-1, 1),
         wild ? c.hostile.pick({0.0, 1e-6, -1e-6, 0.0101, -2.0, 500.0}) : c.hostile.real(1.2, 3)}};
    if (c.hostile.chance(0.1)) o.T_world_object = c.hostile.spoilt(o.T_world_object);
    if (c.hostile.chance(0.1)) o.size[c.hostile.integer(0, 2)] = c.hostile.bad();
    return o;
}

/// True if the object has a valid pose and size and is entirely in front of the camera. Only then
/// are its pixels compared with rays.
bool isCast(const VirtualObject& o) {
    const bool sound = isFinite(o.T_world_object) && o.size.allFinite() &&
                       std::abs(o.T_world_object.rotation.norm() - 1) < 1e-9;
    return sound && o.size.minCoeff() > 0.01 &&
           o.T_world_object.translation.z() - 0.5 * o.size.norm() > 0.05;
}

void preview(Context& c) {
    const CameraModel camera = c.hostile.camera(c.size(1, 120));
    const Size size = camera.size;
    PreviewRenderer renderer(camera, size);
    std::vector<VirtualObject> objects;
    for (int i = c.hostile.integer(1, 3); i > 0; --i)
        objects.push_back(objectOf(c));
    const VirtualLayer& layer = renderer.render(objects, {});
    const auto depth = layer.depth->readRgba32F();
    const auto colour = layer.colour->readRgba8();
    c.gl.frame(c.checks, pixelsOf(size));
    const bool casts = std::ranges::all_of(objects, isCast);
    const auto rays = casts ? twin::rayCast(objects, {}, camera, 0.01) : twin::DepthPicture{};
    long off = 0;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * size.width + x;
            const float z = depth[4 * i];
            c.checks.within(z, 0, 4e5, "depth of an object");
            c.checks.require((z > 0) == (colour[4 * i + 3] != 0),
                             "a pixel has depth but no coverage, or the reverse");
            const bool inside = x >= layer.bounds.x0 && x < layer.bounds.x1 &&
                                y >= layer.bounds.y0 && y < layer.bounds.y1;
            c.checks.require(inside || z == 0, "an object is drawn outside of its bounds");
            if (!casts) continue;
            const auto [low, high] = rays.around(x, y);
            if (!(z >= low * 0.97 - 1e-6 && z <= high * 1.03 + 1e-6)) ++off;
        }
    c.checks.within(static_cast<double>(off), 0, 0.02 * static_cast<double>(pixelsOf(size)) + 8,
                    "number of pixels whose depth is not on the object's surface");
}

constexpr double kInterpolation = 0x1p-20;  // a few roundings, relative to the largest value

// Every pixel of an object must lie in a tile whose depth range contains the pixel's depth.
void silhouettes(Context& c) {
    const CameraModel camera = c.hostile.camera(c.size(1, 120));
    Silhouette silhouette(camera, 0);
    PreviewRenderer renderer(camera, camera.size);
    const std::vector<VirtualObject> objects{objectOf(c), objectOf(c)};
    const auto& tiles = silhouette.run(objects, {});
    const auto depth = renderer.render(objects, {}).depth->readRgba32F();
    c.checks.through("Silhouette", pixelsOf(camera.size));
    c.gl.frame(c.checks, pixelsOf(camera.size));
    const int columns = silhouette.tileCount().width;
    for (const SurfaceRange& tile : tiles)
        c.checks.within(tile.farthest, 0, 4e5, "farthest depth of a tile");
    for (int y = 0; y < camera.size.height; ++y)
        for (int x = 0; x < camera.size.width; ++x) {
            const float z = depth[4 * (static_cast<std::size_t>(y) * camera.size.width + x)];
            const SurfaceRange& tile =
                tiles[static_cast<std::size_t>(y / kTileSize) * columns + x / kTileSize];
            if (!(z > 0)) continue;
            // Tolerance: the renderer interpolates 1 / z in single precision.
            const double rounding = kInterpolation / tile.nearest;
            c.checks.within(1 / z, 0.999 / tile.farthest - rounding,
                            1.001 / tile.nearest + rounding,
                            "inverse depth of a pixel, compared with its tile's range");
        }
}

}  // namespace

std::vector<Case> virtualCases() {
    return {{"composite", compositing, true},
            {"preview", preview, true},
            {"silhouette", silhouettes, true}};
}

}  // namespace mfar::stress
