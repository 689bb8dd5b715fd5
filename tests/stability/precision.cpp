#include "tests/stability/precision.h"

#include "pipeline/composite/preview_renderer.h"
#include "pipeline/depth/depth_filter.h"
#include "pipeline/engine/params/weigh.h"
#include "pipeline/flow/cell_field.h"
#include "tests/engine/gles/levels.h"
#include "tests/measure/triangulation/triangulation.h"
#include "tests/oracle/ray_cast.h"
#include "tests/oracle/triangulation.h"
#include "tests/stability/error_table.h"
#include "tests/stability/gl_watch.h"
#include "tests/stability/half_precision.h"
#include "tests/stability/hostile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mfar::stress {

void ErrorTable::add(double error, double got, double wanted) {
    errors_.push_back(error);
    const auto single = static_cast<float>(std::max(std::abs(wanted), least_));
    const double ulp = std::nextafter(single, std::numeric_limits<float>::infinity()) - single;
    ulps_ = std::max(ulps_, std::abs(got - wanted) / ulp);
}

double ErrorTable::worst() const {
    return errors_.empty() ? 0 : *std::ranges::max_element(errors_);
}

void ErrorTable::printHead() {
    fmt::print("{:<34} {:>8} {:>11} {:>11} {:<11} {:>10}\n", "pass: quantity", "count", "p99.9",
               "max", "unit", "max ulps");
}

void ErrorTable::print() {
    if (errors_.empty()) return;
    const auto at = static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(errors_.size() - 1));
    const double most = worst();
    std::ranges::nth_element(errors_, errors_.begin() + at);
    fmt::print("{:<34} {:>8} {:>11.3g} {:>11.3g} {:<11} {:>10}\n", what_, errors_.size(),
               errors_[static_cast<std::size_t>(at)], most, unit_,
               ulps_ < 0 ? "-" : fmt::format("{:.1f}", ulps_));
}

namespace {

using Eigen::Vector2d;

twin::TwoViews productViews() {
    const Eigen::AngleAxisd turn(0.05, Eigen::Vector3d(1, 2, 3).normalized());
    return {{{640, 480}, 600, 602, 318, 241, {-0.12, 0.03, 0.001, -0.002, 0.01}},
            {{640, 480}, 580, 578, 322, 238, {0.08, -0.02, -0.001, 0.001, 0}},
            {Eigen::Quaterniond(turn), {-0.12, 0.03, 0.02}}};
}

// Expresses an error of depth as the error of flow that would cause it.
void triangulation(TriangulationMethod method, const char* what) {
    const twin::TwoViews views = productViews();
    std::vector<float> flow;
    for (int y = 0; y < 480; ++y)
        for (int x = 0; x < 640; ++x) {
            const Vector2d f = views.flow(Vector2d(x, y), 0.2 + 1e-3 * x);
            flow.insert(flow.end(), {static_cast<float>(f.x()), static_cast<float>(f.y())});
        }
    TriangulationOptions options;
    options.method = method;
    Triangulation stage(views.a, views.b);
    const auto& points = stage.run(flow, views.T_b_a, options);
    ErrorTable table(what, "px");
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!(points[i].inverseDepth > 0)) continue;
        const std::size_t column = i % 640, row = i / 640;
        const Vector2d pixel(static_cast<double>(column), static_cast<double>(row));
        const auto truth = twin::depthFromFlow(views, pixel, Vector2d(flow[2 * i], flow[2 * i + 1]),
                                               options.flowSigma);
        const double off = std::abs(points[i].inverseDepth - truth.inverseDepth);
        table.add(off / truth.sigma * options.flowSigma, points[i].inverseDepth,
                  truth.inverseDepth);
    }
    table.print();
}

/// Runs superres_assess.comp with zero flow. Returns four numbers for each cell. The last two are
/// the position in the still that shows the cell's centre, minus the centre scaled to still pixels.
std::vector<float> assessedStillPixels(const StereoRig& rig) {
    const Size cells = cellsOf(rig.video.size);
    const TestPicture even(rig.video.size, PixelFormat::Rgba8, 128);
    const LevelPair pair(even, even);
    const gpu::Buffer flows(32UL * cells.width * cells.height);
    const gpu::Texture displacement(cells, gpu::TexelFormat::Rgba32F);
    const gpu::Texture statistics(cells, gpu::TexelFormat::Rgba32F);
    gpu::ComputePass<params::AssessCells> pass("superres_assess.comp");
    pass.run({.rig = rigParams(rig),
              .video = pair.pyramids.video()[0],
              .still = pair.pyramids.still()[0],
              .columns = cells.width,
              .rows = cells.height,
              .backwardColumns = cells.width,
              .backwardRows = cells.height,
              .forward = 0,
              .backward = cells.width * cells.height,
              .errorsGiven = 1,
              .backwardScale = 1,
              .stillWidth = 2304,
              .stillHeight = 1728,
              .scaleX = 3.6F,
              .scaleY = 3.6F},
             {gpu::storage(0, pair.pyramids.words()), gpu::storage(1, flows),
              gpu::storage(2, pair.tiles.buffer()), gpu::imageWrite(0, displacement),
              gpu::imageWrite(1, statistics)},
             {gpu::groupsFor(cells.width, 4), gpu::groupsFor(cells.height, 4), 1});
    return displacement.readRgba32F();
}

void stillPixels() {
    const StereoRig rig = bentRig({640, 480}, {2304, 1728});
    const Size cells = cellsOf(rig.video.size);
    const auto got = assessedStillPixels(rig);
    ErrorTable table("superres_assess: still pixel", "px", 1);
    for (int y = 0; y < cells.height; ++y)
        for (int x = 0; x < cells.width; ++x) {
            const Vector2d centre(4 * x + 1.5, 4 * y + 1.5);
            const Vector2d truth = twin::stillPixel(rig, centre);
            const Vector2d offset = truth - ((centre.array() + 0.5) * 3.6 - 0.5).matrix();
            const std::size_t i = 4 * (static_cast<std::size_t>(y) * cells.width + x);
            for (int k = 0; k < 2; ++k) {
                const double shift = (k == 0 ? truth.x() - offset.x() : truth.y() - offset.y());
                table.add(std::abs(got[i + 2 + k] - offset[k]), got[i + 2 + k] + shift, truth[k]);
            }
        }
    table.print();
}

void previewDepth() {
    CameraModel camera = plainRig({640, 480}, {640, 480}).video;
    VirtualObject quad;
    quad.shape = VirtualShape::Quad;
    quad.size = {3, 3, 0};
    quad.T_world_object = {Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.6, 0.8, 0))),
                           {0, 0, 2}};
    PreviewRenderer renderer(camera, camera.size);
    const std::vector<VirtualObject> objects{quad};
    const auto depth = renderer.render(objects, {}).depth->readRgba32F();
    const auto truth = twin::rayCast(objects, {}, camera, 0.01);
    ErrorTable table("preview: depth of a plane", "rel");
    for (std::size_t i = 0; i < truth.z.size(); ++i) {
        const double z = depth[4 * i];
        if (z > 0 && truth.z[i] > 0) table.add(std::abs(z / truth.z[i] - 1), z, truth.z[i]);
    }
    table.print();
}

void hostLens() {
    const CameraModel camera = productViews().a;
    const EpipolarLens lens(camera, 0);
    ErrorTable table("EpipolarLens: project", "px", 1);
    Hostile hostile(1);
    for (int i = 0; i < 100000; ++i) {
        const Vector2d ray(hostile.real(-0.5, 0.5), hostile.real(-0.37, 0.37));
        const auto got = lens.project(static_cast<float>(ray.x()), static_cast<float>(ray.y()));
        const Vector2d truth = camera.project(ray.cast<float>().cast<double>());
        table.add(std::abs(got.x - truth.x()), got.x, truth.x());
        table.add(std::abs(got.y - truth.y()), got.y, truth.y());
    }
    table.print();
}

void carriedDepth() {
    CameraModel camera = productViews().a;
    DepthFilter filter(camera, std::make_shared<Workers>(1));
    InverseDepthField plane(camera.size);
    std::ranges::fill(plane.inverseDepth, 0.5F);
    std::ranges::fill(plane.variance, 1e-4F);
    filter.predict({}, 0.03);
    filter.fuse(plane, {0, 0, camera.size.width, camera.size.height});
    filter.predict({Eigen::Quaterniond::Identity(), {0.05, 0.02, 0.3}}, 0.03);
    const double truth = 1 / (2 - 0.3);
    ErrorTable table("DepthFilter: carried depth", "rel");
    for (std::size_t i = 0; i < plane.inverseDepth.size(); ++i)
        if (filter.field().isKnown(i))
            table.add(std::abs(filter.field().inverseDepth[i] / truth - 1),
                      filter.field().inverseDepth[i], truth);
    table.print();
}

}  // namespace

void printPrecision() {
    const GlWatch gl;
    fmt::print("Single precision against double\n");
    ErrorTable::printHead();
    triangulation(TriangulationMethod::Flow, "triangulation: inverse depth");
    triangulation(TriangulationMethod::Midpoint, "midpoint: inverse depth");
    stillPixels();
    previewDepth();
    hostLens();
    carriedDepth();
    printHalfPrecision();
}

}  // namespace mfar::stress
