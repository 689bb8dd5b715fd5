#include "tests/measure/triangulation/triangulation_case.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr int kComparedEvery = 37;

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr auto kMethods = {TriangulationMethod::Flow, TriangulationMethod::Midpoint};

/// Inverse depth of the point at which the rays of both views meet at the given angle.
double inverseDepthAt(const twin::TwoViews& views, const Vector2d& pixel, double angle) {
    const Vector3d ray = views.rayA(pixel).homogeneous().normalized();
    const Vector3d toB = views.T_b_a.inverse().translation;
    const double away = std::acos(ray.dot(toB.normalized()));
    // Law of sines in the triangle of the two camera centres and the point.
    const double range = toB.norm() * std::sin(std::numbers::pi - away - angle) / std::sin(angle);
    return 1 / (range * ray.z());
}

struct Errors {
    double worst = 0;
    int compared = 0;
};

/// Compares triangulated() with `oracle`, which computes in double precision from the same input.
/// Compares every kComparedEvery-th pixel whose flow ends in view b.
template <class Oracle>
Errors compare(const twin::TwoViews& views, const std::vector<float>& flow,
               TriangulationMethod method, Oracle oracle) {
    const auto points = triangulated(views, flow, {.method = method});
    Errors out;
    for (std::size_t i = 0; i < points.size(); i += kComparedEvery) {
        const auto x = static_cast<int>(i % 640), y = static_cast<int>(i / 640);
        const Vector2d pixel(x, y), end = pixel + vectorAt(flow, i);
        if (!(end.x() > 0 && end.y() > 0 && end.x() < 639 && end.y() < 479)) continue;
        const double wanted = oracle(views, pixel, vectorAt(flow, i));
        out.worst = std::max(out.worst, std::abs(points[i].inverseDepth / wanted - 1));
        ++out.compared;
    }
    return out;
}

double inverseDepthOfFlow(const twin::TwoViews& v, const Vector2d& p, const Vector2d& f) {
    return twin::depthFromFlow(v, p, f, 1).inverseDepth;
}
double inverseDepthOfMidpoint(const twin::TwoViews& v, const Vector2d& p, const Vector2d& f) {
    return twin::midpoint(v, p, f).inverseDepth;
}

TEST(Triangulation, ErrorIsBelowAMillionthFromAHundredthToTenDegreesOfParallax) {
    const RigidTransform motions[] = {moved(0, Vector3d::UnitX(), {-0.1, 0, 0}),
                                      moved(1, {1, 2, 3}, {0.02, 0.1, 0.03}),
                                      moved(10, {-1, 2, -2}, {-0.3, -0.05, 0.05})};
    for (const RigidTransform& motion : motions)
        for (const double degrees : {0.01, 0.03, 0.1, 1.0, 10.0}) {
            const twin::TwoViews views = bentViews(motion);
            int index = 0;
            const auto flow = fieldOf(views.a.size, [&](const Vector2d& p) -> Vector2d {
                if (index++ % kComparedEvery != 0) return {0, 0};
                return views.flow(p, inverseDepthAt(views, p, degrees * kDegree));
            });
            const Errors fast = compare(views, flow, TriangulationMethod::Flow, inverseDepthOfFlow);
            EXPECT_GT(fast.compared, 3000);
            EXPECT_LT(fast.worst, 1e-6) << degrees << ", " << motion.translation.transpose();
            const Errors middle =
                compare(views, flow, TriangulationMethod::Midpoint, inverseDepthOfMidpoint);
            EXPECT_LT(middle.worst, 1e-6) << degrees << ", " << motion.translation.transpose();
        }
}

// The camera moves forward into the scene. Depth is unknown at the epipole itself.
TEST(Triangulation, ErrorIsBelowATenThousandthAroundTheEpipole) {
    const twin::TwoViews views = bentViews(moved(3, {1, 1, 2}, {0.002, 0.003, -0.1}));
    const auto flow = fieldOf(views.a.size, [&](const Vector2d& p) { return views.flow(p, 0.5); });
    const Vector3d direction = views.T_b_a.inverse().translation;
    const Vector2d epipole = views.a.project(direction.hnormalized());
    int near = 0;
    for (const TriangulationMethod method : kMethods) {
        const auto points = triangulated(views, flow, {.method = method});
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Vector2d pixel(static_cast<int>(i % 640), static_cast<int>(i / 640));
            const double away = (pixel - epipole).norm();
            if (away < 1 || away > 20) continue;
            ++near;
            const double wanted = method == TriangulationMethod::Flow
                                      ? inverseDepthOfFlow(views, pixel, vectorAt(flow, i))
                                      : inverseDepthOfMidpoint(views, pixel, vectorAt(flow, i));
            ASSERT_NEAR(points[i].inverseDepth / wanted, 1, 1e-4) << pixel.transpose();
        }
    }
    EXPECT_GT(near, 2000);
}

TEST(Triangulation, FindsTheDepthFromWhichTheFlowWasComputed) {
    const twin::TwoViews views = bentViews(moved(4, {2, 1, 1}, {-0.2, 0.05, 0.02}));
    const auto inverseDepth = [](const Vector2d& p) { return 0.2 + 0.001 * p.x() + 0.002 * p.y(); };
    const auto flow =
        fieldOf(views.a.size, [&](const Vector2d& p) { return views.flow(p, inverseDepth(p)); });
    for (const TriangulationMethod method : kMethods) {
        const auto inverseDepthOf = [&](const twin::TwoViews&, const Vector2d& p, const Vector2d&) {
            return inverseDepth(p);
        };
        const Errors errors = compare(views, flow, method, inverseDepthOf);
        EXPECT_GT(errors.compared, 3000);
        EXPECT_LT(errors.worst, 1e-5);  // the flow itself is rounded to single precision
    }
}

/// Flow of a wall at 2 m, with an error of a few pixels in any direction.
struct OffLine {
    twin::TwoViews views = bentViews(moved(2, {1, -1, 2}, {0.1, 0.08, -0.05}));
    std::vector<float> flow = fieldOf(views.a.size, [this](const Vector2d& p) {
        return (views.flow(p, 0.5) +
                2 * Vector2d(std::sin(p.x() + 0.2 * p.y()), std::cos(1.3 * p.y())))
            .eval();
    });

    template <class Visit>
    void eachInside(const Visit& visit) const {
        for (std::size_t i = 0; i < flow.size() / 2; i += 37) {
            const Vector2d pixel(static_cast<int>(i % 640), static_cast<int>(i / 640));
            const Vector2d end = pixel + vectorAt(flow, i);
            if (end.x() > 0 && end.y() > 0 && end.x() < 639 && end.y() < 479)
                visit(i, pixel, vectorAt(flow, i));
        }
    }
};

TEST(Triangulation, SigmaResidualAndRayDistanceMatchDoublePrecision) {
    const OffLine wall;
    for (const TriangulationMethod method : kMethods) {
        const auto points = triangulated(wall.views, wall.flow, {.method = method, .flowSigma = 2});
        int known = 0;
        wall.eachInside([&](std::size_t i, const Vector2d& pixel, const Vector2d& flow) {
            const auto wanted = twin::depthFromFlow(wall.views, pixel, flow, 2);
            const auto middle = twin::midpoint(wall.views, pixel, flow);
            EXPECT_NEAR(points[i].residual, wanted.residual, 1e-4);
            EXPECT_NEAR(points[i].rayDistance, middle.rayDistance, 1e-5);
            if (!(points[i].inverseDepth > 0)) return;
            ++known;
            EXPECT_NEAR(points[i].sigma / wanted.sigma, 1, 1e-4);
        });
        EXPECT_GT(known, 3000);
    }
}

TEST(Triangulation, DepthOfPointsBehindACameraIsUnknown) {
    const OffLine wall;
    int behind = 0;
    const auto fast = triangulated(wall.views, wall.flow, {});
    const auto middle =
        triangulated(wall.views, wall.flow, {.method = TriangulationMethod::Midpoint});
    // With reversed parallax, the rays meet behind the cameras.
    const auto turned =
        fieldOf(wall.views.a.size, [&](const Vector2d& p) { return wall.views.flow(p, -0.5); });
    for (const TriangulationMethod method : kMethods)
        for (const TriangulatedPoint& p : triangulated(wall.views, turned, {.method = method})) {
            ASSERT_EQ(p.inverseDepth, 0);
            behind += p.sigma == kUnknownSigma;
        }
    EXPECT_EQ(behind, 2 * 640 * 480);
    wall.eachInside([&](std::size_t i, const Vector2d& pixel, const Vector2d& flow) {
        EXPECT_EQ(fast[i].inverseDepth > 0, inverseDepthOfFlow(wall.views, pixel, flow) > 0);
        const auto wanted = twin::midpoint(wall.views, pixel, flow);
        EXPECT_EQ(middle[i].inverseDepth > 0, wanted.ahead && wanted.inverseDepth > 0);
    });
}

TEST(Triangulation, DepthIsUnknownWhereTheRaysPassFarFromEachOther) {
    const OffLine wall;
    for (const TriangulationMethod method : kMethods) {
        const auto all = triangulated(wall.views, wall.flow, {.method = method});
        const auto near =
            triangulated(wall.views, wall.flow, {.method = method, .maxRayDistance = 0.003});
        int refused = 0, kept = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (!(all[i].inverseDepth > 0)) continue;
            const bool keep = all[i].rayDistance <= 0.003F;
            ASSERT_EQ(near[i].inverseDepth, keep ? all[i].inverseDepth : 0);
            ASSERT_EQ(near[i].sigma, keep ? all[i].sigma : kUnknownSigma);
            ASSERT_EQ(near[i].rayDistance, all[i].rayDistance);
            ++(keep ? kept : refused);
        }
        EXPECT_GT(refused, 1000);
        EXPECT_GT(kept, 1000);
    }
}

TEST(Triangulation, SigmaMatchesTheEffectOfFlowErrors) {
    const twin::TwoViews views = plainViews(moved(0, Vector3d::UnitX(), {-0.2, 0.1, 0.05}));
    const double step = 0.1;  // [px]
    const auto shifted = [&](double by) {
        return triangulated(
            views, fieldOf(views.a.size, [&](const Vector2d& p) {
                return (views.flow(p, 0.5) + by * views.line(p).normalized()).eval();
            }));
    };
    const auto less = shifted(-step), more = shifted(step);
    const auto at = triangulated(
        views, fieldOf(views.a.size, [&](const Vector2d& p) { return views.flow(p, 0.5); }),
        {.flowSigma = 0.5});
    for (std::size_t i = 64 * 20 + 25; i < 64 * 20 + 60; ++i)
        EXPECT_NEAR((more[i].inverseDepth - less[i].inverseDepth) / (2 * step), at[i].sigma / 0.5,
                    1e-3 * at[i].sigma);
}

TEST(Triangulation, SigmaIsInverselyProportionalToTheBaseline) {
    double before = 0;
    for (const double baseline : {1e-1, 1e-3, 1e-5, 1e-7}) {
        const twin::TwoViews views = plainViews(moved(0, Vector3d::UnitX(), {-baseline, 0, 0}));
        const auto points = triangulated(
            views, fieldOf(views.a.size, [&](const Vector2d&) { return Vector2d(-1e-4, 0); }));
        const double sigma = points[64 * 20 + 30].sigma;
        EXPECT_NEAR(sigma, 0.25 / 100 / baseline, 1e-4 * sigma);
        EXPECT_GT(sigma, 50 * before);
        before = sigma;
    }
}

TEST(Triangulation, ResidualIsTheSignedFlowNormalToTheEpipolarLine) {
    const twin::TwoViews views = plainViews(moved(0, Vector3d::UnitX(), {-0.2, 0, 0}));
    // Nearer points move to the left. A quarter turn clockwise from left is up.
    for (const double off : {-3.0, 0.5}) {
        const auto points = triangulated(
            views, fieldOf({64, 48}, [&](const Vector2d&) { return Vector2d(-4, off); }));
        EXPECT_NEAR(points[64 * 20 + 30].residual, -off, 1e-4);
    }
}

}  // namespace
}  // namespace mfar
