#include "tests/measure/triangulation/triangulation.h"
#include "tests/oracle/triangulation.h"
#include "tests/stability/cases.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mfar::stress {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Points = std::vector<TriangulatedPoint>;

constexpr auto kMethods = {TriangulationMethod::Flow, TriangulationMethod::Midpoint};

Points triangulate(Context& c, const twin::TwoViews& views, const std::vector<float>& flow,
                   const TriangulationOptions& options) {
    Triangulation stage(views.a, views.b);
    Points points = stage.run(flow, views.T_b_a, options);
    c.checks.tried("Triangulation", static_cast<long>(points.size()));
    for (const TriangulatedPoint& p : points) {
        c.checks.within(p.inverseDepth, 0, 1e6, "inverse depth of a point");
        c.checks.within(p.sigma, 0, kUnknownSigma, "sigma of a point's inverse depth");
        c.checks.within(p.residual, -1e9, 1e9, "residual of a point");
        c.checks.within(p.rayDistance, 0, 1e35, "distance between the two rays of a point");
        c.checks.require(p.inverseDepth > 0 || p.sigma == kUnknownSigma,
                         "sigma of unknown depth is not kUnknownSigma");
    }
    return points;
}

void hostileTriangulation(Context& c) {
    const double unit = c.hostile.logarithmic(1e-6, 1e3);
    twin::TwoViews views{c.hostile.camera(c.size(1, 97)), c.hostile.camera(c.hostile.size(1, 97)),
                         c.hostile.motion(unit)};
    if (c.hostile.chance(0.3)) views.T_b_a = c.hostile.spoilt(views.T_b_a);
    std::vector<float> flow(2UL * pixelsOf(views.a.size));
    const int kind = c.hostile.integer(0, 3);
    const double reach = c.hostile.logarithmic(1e-3, 100);
    for (float& v : flow) {
        const double drawn = kind == 0 ? 0 : reach * std::pow(c.hostile.real(-1, 1), 5);
        v = static_cast<float>(kind == 3 || c.hostile.chance(0.02) ? c.hostile.bad() : drawn);
    }
    TriangulationOptions options;
    options.method = c.hostile.pick(kMethods);
    options.maxRayDistance = c.hostile.pick({std::numeric_limits<double>::infinity(), 0.0, 0.1});
    triangulate(c, views, flow, options);
}

struct SurfaceScene {
    twin::TwoViews views;
    std::vector<float> flow;
};

double inverseDepthAt(const Vector2d& pixel, double unit) {
    return (0.4 + 0.3 * std::sin(0.11 * pixel.x()) + 0.2 * std::cos(0.07 * pixel.y())) / unit;
}

std::vector<float> flowOf(const twin::TwoViews& views, double unit) {
    std::vector<float> flow;
    for (int y = 0; y < views.a.size.height; ++y)
        for (int x = 0; x < views.a.size.width; ++x) {
            const Vector2d f = views.flow(Vector2d(x, y), inverseDepthAt(Vector2d(x, y), unit));
            flow.push_back(static_cast<float>(f.x()));
            flow.push_back(static_cast<float>(f.y()));
        }
    return flow;
}

CameraModel usualLens(Hostile& hostile, Size size) {
    CameraModel camera = hostile.camera(size);
    for (double& d : camera.distortion)
        d *= 0.4;
    camera.fx = camera.fy = std::max(size.width, size.height) * hostile.real(0.8, 1.5);
    return camera;
}

SurfaceScene usualScene(Context& c, double unit) {
    const Size size = c.size(8, 90);
    SurfaceScene out{
        {usualLens(c.hostile, size), usualLens(c.hostile, size), c.hostile.gentle(unit)}, {}};
    out.flow = flowOf(out.views, unit);
    return out;
}

/// Limit of the error of inverse depth: the error that an error of 2e-6 in normalised rays would
/// cause, plus 2e-6 of the inverse depth.
double bound(const twin::TwoViews& views, const twin::FlowDepth& truth, double flowSigma) {
    const double focal = std::sqrt(views.b.fx * views.b.fy);
    return truth.sigma * 2e-6 * focal / flowSigma + 2e-6 * std::abs(truth.inverseDepth);
}

/// True if the flow ends in view b, and if the point is in front of both cameras and not near the
/// epipole. Other points are not compared with the oracle.
bool isComparable(const twin::TwoViews& views, const Vector2d& pixel, const Vector2d& flow,
                  const twin::FlowDepth& truth) {
    const Vector2d q = pixel + flow, end(views.b.size.width - 1, views.b.size.height - 1);
    const Vector2d e = views.line(pixel);
    const double z = (views.T_b_a.rotation * views.rayA(pixel).homogeneous() +
                      truth.inverseDepth * views.T_b_a.translation)
                         .z();
    return q.minCoeff() >= 0 && (end - q).minCoeff() >= 0 && truth.inverseDepth > 0 && z > 0.2 &&
           e.norm() > 0.02 * views.T_b_a.translation.norm();
}

void checkAgainstTwin(Context& c, const SurfaceScene& s, const Points& points, double flowSigma) {
    for (int y = 0; y < s.views.a.size.height; ++y)
        for (int x = 0; x < s.views.a.size.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * s.views.a.size.width + x;
            const Vector2d pixel(x, y), flow(s.flow[2 * i], s.flow[2 * i + 1]);
            const auto truth = twin::depthFromFlow(s.views, pixel, flow, flowSigma);
            if (!isComparable(s.views, pixel, flow, truth)) continue;
            const double off = points[i].inverseDepth - truth.inverseDepth;
            c.checks.within(std::abs(off) / bound(s.views, truth, flowSigma), 0, 1,
                            "error of inverse depth, as a share of its bound");
            c.checks.within(points[i].sigma / truth.sigma, 0.999, 1.001,
                            "sigma divided by the true sigma");
            c.checks.within(points[i].residual - truth.residual, -5e-3, 5e-3,
                            "error of the flow beside the epipolar line");
        }
}

void usualTriangulation(Context& c) {
    const double unit = c.hostile.pick({1e-6, 1e-3, 1.0, 1e3});
    const SurfaceScene s = usualScene(c, unit);
    for (const TriangulationMethod method : kMethods) {
        TriangulationOptions options;
        options.method = method;
        checkAgainstTwin(c, s, triangulate(c, s.views, s.flow, options), options.flowSigma);
    }
}

void scaledTriangulation(Context& c) {
    const SurfaceScene s = usualScene(c, 1);
    const double scale = c.hostile.pick({1e-3, 0.125, 3.7, 1e3});
    SurfaceScene large = s;
    large.views.T_b_a.translation *= scale;
    TriangulationOptions options;
    options.method = c.hostile.pick(kMethods);
    const Points one = triangulate(c, s.views, s.flow, options);
    const Points other = triangulate(c, large.views, large.flow, options);
    for (std::size_t i = 0; i < one.size(); ++i) {
        const double inverseDepth = one[i].inverseDepth, sigma = one[i].sigma;
        c.checks.within(other[i].inverseDepth * scale, inverseDepth * (1 - 1e-4) - 1e-6,
                        inverseDepth * (1 + 1e-4) + 1e-6, "inverse depth in a scaled world");
        if (inverseDepth > 0 && sigma < 1e5)
            c.checks.within(other[i].sigma * scale / sigma, 0.999, 1.001,
                            "sigma in a scaled world");
        c.checks.within(other[i].residual - one[i].residual, -2e-3, 2e-3,
                        "flow beside the epipolar line in a scaled world");
    }
}

CameraModel mirrored(CameraModel camera) {
    camera.cx = camera.size.width - 1 - camera.cx;
    camera.distortion[3] = -camera.distortion[3];
    return camera;
}

RigidTransform mirrored(RigidTransform T) {
    T.translation.x() = -T.translation.x();
    T.rotation.y() = -T.rotation.y();
    T.rotation.z() = -T.rotation.z();
    return T;
}

void mirroredTriangulation(Context& c) {
    const SurfaceScene s = usualScene(c, 1);
    const Size size = s.views.a.size;
    SurfaceScene mirror{{mirrored(s.views.a), mirrored(s.views.b), mirrored(s.views.T_b_a)},
                        s.flow};
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const std::size_t row = static_cast<std::size_t>(y) * size.width;
            const std::size_t i = row + x, j = row + size.width - 1 - x;
            // The pictures are mirrored about their centres. They may differ in width.
            const double across = s.views.b.size.width - size.width;
            mirror.flow[2 * i] = static_cast<float>(across - s.flow[2 * j]);
            mirror.flow[2 * i + 1] = s.flow[2 * j + 1];
        }
    const Points one = triangulate(c, s.views, s.flow, {});
    const Points other = triangulate(c, mirror.views, mirror.flow, {});
    for (std::size_t i = 0; i < one.size(); ++i) {
        const std::size_t row = i / size.width * size.width;
        const auto& m = other[row + size.width - 1 - (i - row)];
        if (one[i].sigma > 1 || m.sigma > 1) continue;  // this pixel is near the epipole
        const double slack = 1e-4 * one[i].sigma + 4e-6;
        c.checks.within(m.inverseDepth - one[i].inverseDepth, -slack, slack,
                        "change of inverse depth by mirrored pictures");
        c.checks.within(m.residual + one[i].residual, -2e-3, 2e-3,
                        "flow beside the epipolar line of mirrored pictures");
    }
}

// A point must have the same position if the views a and b are exchanged.
void exchangedTriangulation(Context& c) {
    const SurfaceScene s = usualScene(c, 1);
    const twin::TwoViews back{s.views.b, s.views.a, s.views.T_b_a.inverse()};
    const std::vector<float> flow = flowOf(back, 1);
    const TriangulationOptions options;
    const Points points = triangulate(c, back, flow, options);
    for (int y = 0; y < back.a.size.height; ++y)
        for (int x = 0; x < back.a.size.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * back.a.size.width + x;
            const Vector2d q(x, y), f(flow[2 * i], flow[2 * i + 1]), p = q + f;
            const auto here = twin::depthFromFlow(back, q, f, options.flowSigma);
            if (!isComparable(back, q, f, here)) continue;
            const auto there = twin::depthFromFlow(s.views, p, -f, options.flowSigma);
            const double z = (s.views.T_b_a.rotation * s.views.rayA(p).homogeneous() +
                              there.inverseDepth * s.views.T_b_a.translation)
                                 .z();
            c.checks.within(std::abs(points[i].inverseDepth - there.inverseDepth / z) /
                                (4 * bound(back, here, options.flowSigma)),
                            0, 1, "difference between exchanged views, as a share of its bound");
        }
}

}  // namespace

std::vector<Case> triangulationCases() {
    return {{"triangulation", hostileTriangulation, true},
            {"triangulation-usual", usualTriangulation},
            {"triangulation-scaled", scaledTriangulation},
            {"triangulation-mirrored", mirroredTriangulation},
            {"triangulation-exchanged", exchangedTriangulation}};
}

}  // namespace mfar::stress
