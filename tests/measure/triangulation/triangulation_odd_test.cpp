#include "tests/measure/triangulation/triangulation_case.h"

#include <cmath>
#include <limits>
#include <random>

namespace mfar {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr auto kBothMethods = {TriangulationMethod::Flow, TriangulationMethod::Midpoint};

/// Expects all numbers to be in their ranges. Returns the number of known depths.
int checked(const std::vector<TriangulatedPoint>& points) {
    int known = 0;
    for (const TriangulatedPoint& p : points) {
        EXPECT_TRUE(p.inverseDepth >= 0 && p.inverseDepth <= 1e6F) << p.inverseDepth;
        EXPECT_TRUE(p.sigma >= 0 && p.sigma <= kUnknownSigma) << p.sigma;
        EXPECT_TRUE(std::isfinite(p.residual) && std::isfinite(p.rayDistance));
        EXPECT_GE(p.rayDistance, 0);
        if (p.inverseDepth > 0)
            ++known;
        else
            EXPECT_EQ(p.sigma, kUnknownSigma);
        if (testing::Test::HasFailure()) break;
    }
    return known;
}

TEST(TriangulationOdd, InvalidFlowAndFlowOutOfViewGiveUnknownDepth) {
    const twin::TwoViews views = plainViews(moved(1, {1, 2, 3}, {-0.2, 0, 0}));
    const float values[] = {kNan, kInf, -kInf, 3e38F, -3e38F, 1e9F, -1e9F, 100, -100};
    for (const TriangulationMethod method : kBothMethods)
        for (const float value : values)
            for (const int channel : {0, 1}) {
                std::vector<float> flow(2UL * 64 * 48, 0.0F);
                for (std::size_t i = 0; i < 64UL * 48; ++i)
                    flow[2 * i + channel] = value;
                EXPECT_EQ(checked(triangulated(views, flow, {.method = method})), 0) << value;
            }
}

TEST(TriangulationOdd, WithoutParallaxTheInverseDepthIsZero) {
    const std::vector<float> still(2UL * 64 * 48, 0.0F);
    for (const TriangulationMethod method : kBothMethods)
        for (const Vector3d& step :
             {Vector3d(0, 0, 0), Vector3d(-0.2, 0, 0), Vector3d(0, 0, 0.1), Vector3d(1e-30, 0, 0)})
            EXPECT_EQ(checked(triangulated(plainViews(moved(0, Vector3d::UnitX(), step)), still,
                                           {.method = method})),
                      0);
}

TEST(TriangulationOdd, WithoutABaselineAllFlowIsResidual) {
    std::vector<float> flow(2UL * 64 * 48, 0.0F);
    for (std::size_t i = 0; i < flow.size(); i += 2)
        flow[i] = -3;
    const auto points = triangulated(plainViews({}), flow);
    EXPECT_EQ(checked(points), 0);
    EXPECT_NEAR(points[64 * 20 + 30].residual, 3, 1e-4);
}

TEST(TriangulationOdd, InvalidPositionsGiveUnknownDepthAndInvalidRotationsFiniteResults) {
    const std::vector<float> flow(2UL * 64 * 48, -1.0F);
    for (const TriangulationMethod method : kBothMethods)
        for (const double value : {double(kNan), double(kInf), 1e300}) {
            RigidTransform far, turned;
            far.translation.x() = value;
            turned.rotation.w() = value;
            turned.translation.x() = -0.1;
            EXPECT_EQ(checked(triangulated(plainViews(far), flow, {.method = method})), 0);
            checked(triangulated(plainViews(turned), flow, {.method = method}));
        }
}

TEST(TriangulationOdd, AnyFlowAndAnyPoseGiveFiniteResults) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> any(-1, 1);
    int known = 0;
    for (int run = 0; run < 40; ++run) {
        const double reach = std::pow(10.0, -4 + 0.15 * run);
        const Vector3d axis(any(random), any(random), any(random));
        twin::TwoViews views =
            bentViews(moved(180 * std::pow(any(random), 3), axis,
                            reach * Vector3d(any(random), any(random), any(random))));
        views.a = views.a.scaledTo({160, 120});
        views.b = views.b.scaledTo({160, 120});
        const auto flow = fieldOf(views.a.size, [&](const Vector2d&) {
            return Vector2d(100 * std::pow(any(random), 5), 100 * std::pow(any(random), 5));
        });
        for (const TriangulationMethod method : kBothMethods)
            known += checked(triangulated(views, flow, {.method = method}));
    }
    EXPECT_GT(known, 10000);
}

// The camera moves along its optical axis, so the epipole is the principal point, here a pixel's
// centre. There, the epipolar line has no length.
TEST(TriangulationOdd, DepthAtTheEpipoleIsUnknown) {
    twin::TwoViews views = plainViews(moved(0, Vector3d::UnitX(), {0, 0, -0.1}));
    views.a.cx = views.b.cx = 30;
    views.a.cy = views.b.cy = 20;
    const auto flow = fieldOf({64, 48}, [&](const Vector2d& p) { return views.flow(p, 1); });
    for (const TriangulationMethod method : kBothMethods) {
        const auto points = triangulated(views, flow, {.method = method});
        EXPECT_GT(checked(points), 2000);
        EXPECT_EQ(points[64 * 20 + 30].inverseDepth, 0);
        EXPECT_NEAR(points[64 * 20 + 31].inverseDepth, 1, 1e-4);
    }
}

TEST(TriangulationOdd, AFlowOfAnotherSizeIsRefused) {
    const twin::TwoViews views = plainViews({});
    Triangulation stage(views.a, views.b);
    EXPECT_THROW(stage.run(std::vector<float>(64UL * 48), {}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace mfar
