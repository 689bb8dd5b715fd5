#include "pipeline/slices/view_predictor.h"
#include "tests/render/still_life.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace mfar {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kFar = 1e6;
const PredictionLimits kNoLimits{10, 1000};

double angle(const RigidTransform& a, const RigidTransform& b) {
    return a.rotation.angularDistance(b.rotation);
}

RigidTransform onCircle(double seconds, double speed) {
    return render_scenes::viewFrom({64, 48}, speed * seconds).T_world_camera;
}

void expectNear(const RigidTransform& a, const RigidTransform& b, double metres, double radians) {
    EXPECT_LT((a.translation - b.translation).norm(), metres);
    EXPECT_LT(angle(a, b), radians);
}

TEST(ViewPredictor, ConstantVelocityInTheCameraFrameIsPredictedExactly) {
    ViewPredictor predictor(kNoLimits);
    for (int i = 0; i <= 30; ++i)
        predictor.add(onCircle(i / 30.0, 20), Timestamp::fromSeconds(i / 30.0));
    for (const double ahead : {0.0, 0.1, 0.5, 2.0})
        expectNear(predictor.predict(ahead, kFar), onCircle(1 + ahead, 20), 1e-6, 1e-6);
}

TEST(ViewPredictor, UsesTheMotionOfTheLastTenthOfASecond) {
    ViewPredictor predictor(kNoLimits);
    for (int i = 0; i <= 15; ++i)
        predictor.add(onCircle(i / 30.0, 20), Timestamp::fromSeconds(i / 30.0));
    for (int i = 16; i <= 20; ++i)
        predictor.add(onCircle(0.5, 20), Timestamp::fromSeconds(i / 30.0));
    expectNear(predictor.predict(1, kFar), onCircle(0.5, 20), 1e-9, 1e-9);
}

TEST(ViewPredictor, PredictionStaysWithinItsLimits) {
    ViewPredictor predictor({0.25, 5});
    for (int i = 0; i <= 30; ++i)
        predictor.add(onCircle(i / 30.0, 10), Timestamp::fromSeconds(i / 30.0));
    expectNear(predictor.predict(7, kFar), onCircle(1.25, 10), 1e-6, 1e-6);
    for (int i = 0; i <= 30; ++i)
        predictor.add(onCircle(i / 30.0, 80), Timestamp::fromSeconds(2 + i / 30.0));
    EXPECT_NEAR(angle(predictor.predict(1, kFar), onCircle(1, 80)), 5 * kDegree, 1e-6);
    const double way = (predictor.predict(1, 0.1).translation - onCircle(1, 80).translation).norm();
    EXPECT_LE(way, 0.1 * 5 * kDegree + 1e-9) << "five degrees around a near object are a short way";
    EXPECT_GT(way, 0.09 * 5 * kDegree);
}

TEST(ViewPredictor, CameraWithFewerThanTwoPosesIsPredictedToStay) {
    ViewPredictor predictor;
    expectNear(predictor.predict(1, 1), {}, 1e-12, 1e-12);
    predictor.add(onCircle(1, 20), Timestamp::fromSeconds(1));
    expectNear(predictor.predict(1, 1), onCircle(1, 20), 1e-9, 1e-9);
}

TEST(ViewPredictor, GapOrStepBackInTimeRestartsThePrediction) {
    for (const double jump : {1.0, -1.0, 0.0}) {
        ViewPredictor predictor;
        predictor.add(onCircle(0, 20), Timestamp::fromSeconds(5));
        predictor.add(onCircle(0.1, 20), Timestamp::fromSeconds(5.1));
        predictor.add(onCircle(3, 20), Timestamp::fromSeconds(5.1 + jump));
        expectNear(predictor.predict(0.3, 1), onCircle(3, 20), 1e-9, 1e-9);
    }
}

TEST(ViewPredictor, InvalidLimitsAreRefused) {
    for (const double odd : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        EXPECT_THROW(ViewPredictor({odd, 1}), std::invalid_argument);
        EXPECT_THROW(ViewPredictor({1, odd}), std::invalid_argument);
    }
}

}  // namespace
}  // namespace mfar
