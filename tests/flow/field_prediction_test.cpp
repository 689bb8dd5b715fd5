#include "pipeline/epipolar/field_prediction.h"
#include "tests/flow/flow_scene.h"

#include <gtest/gtest.h>

namespace mfar {
namespace {

using test::motion;
using test::Scene;

CameraModel barrelCamera() {
    return {{322, 241}, 250, 252, 163, 119, {-0.2, 0.05, 0.001, -0.001, 0}};
}

Scene slantedStep() {
    const Eigen::Vector3d normal = Eigen::Vector3d(0.5, 0.2, 1).normalized();
    return {{{normal, 3}, {{0, 0, 1}, 2, {-0.35, -0.4}, {0.45, 0.3}}}, 28, 100};
}

/// True s of the cells of a frame at `T_frame_world`. The still's camera is at the world's origin,
/// so the scene is given in its coordinates.
std::vector<float> truth(const EpipolarLens& cells, const RigidTransform& T_frame_world,
                         const Scene& scene) {
    const RigidTransform T_still_frame = T_frame_world.inverse();
    const double z = (T_still_frame.rotation.conjugate() * T_still_frame.translation).z();
    std::vector<float> out;
    for (std::size_t i = 0; i < static_cast<std::size_t>(cells.size().width) * cells.size().height;
         ++i)
        out.push_back(static_cast<float>(
            1 / (scene.depth(T_frame_world, {cells.rayX(i), cells.rayY(i)}) + z)));
    return out;
}

RigidTransform scaled(RigidTransform T, double factor) {
    T.translation *= factor;
    return T;
}

/// Share of the cells whose predicted s has an error above 0.7 %, the change between neighbouring
/// cells on the wall. Three cells at each border are left out, because new parts of the scene
/// appear there.
double missed(std::span<const float> predicted, const std::vector<float>& expected, Size cells,
              double unit = 1) {
    int missed = 0, all = 0;
    for (int y = 3; y < cells.height - 3; ++y)
        for (int x = 3; x < cells.width - 3; ++x, ++all) {
            const std::size_t i = static_cast<std::size_t>(y) * cells.width + x;
            missed += std::abs(predicted[i] / unit - expected[i]) > 0.007 * expected[i] ? 1 : 0;
        }
    return missed / static_cast<double>(all);
}

TEST(FieldPrediction, InverseDepthsMoveToTheNextFrameAccordingToThePoses) {
    const EpipolarLens cells(barrelCamera(), 2);
    const RigidTransform before = motion({1, -2, 3}, {-0.2, 0.05, 0.1});
    const RigidTransform after = motion({1.5, -2.6, 1.5}, {-0.26, 0.07, 0.16});
    FieldPrediction prediction(barrelCamera());
    prediction.keep(truth(cells, before, slantedStep()), before.inverse(), 1);
    const auto predicted = prediction.in(after.inverse(), 1);
    const auto expected = truth(cells, after, slantedStep());
    ASSERT_EQ(predicted.size(), expected.size());
    // The prediction may be wrong only at the panel's edges.
    EXPECT_LT(missed(predicted, expected, cells.size()), 0.03);
    EXPECT_GT(missed(truth(cells, before, slantedStep()), expected, cells.size()), 0.2)
        << "the test needs a motion that changes the field";
}

TEST(FieldPrediction, UnitsOfLengthCanDifferBetweenFrames) {
    const EpipolarLens cells(barrelCamera(), 2);
    const RigidTransform before = motion({1, -2, 3}, {-0.2, 0.05, 0.1});
    const RigidTransform after = motion({1.5, -2.6, 1.5}, {-0.26, 0.07, 0.16});
    std::vector<float> kept = truth(cells, before, slantedStep());
    for (float& s : kept)
        s *= 0.2F;
    FieldPrediction prediction(barrelCamera());
    prediction.keep(kept, scaled(before.inverse(), 1 / 0.2), 0.2);
    const auto predicted = prediction.in(scaled(after.inverse(), 1 / 700.0), 700);
    ASSERT_FALSE(predicted.empty());
    EXPECT_LT(missed(predicted, truth(cells, after, slantedStep()), cells.size(), 700), 0.03);
}

TEST(FieldPrediction, TheNearestSurfaceOccludesOthers) {
    // All cells but one are at infinity. The near cell lands on a far cell and replaces it.
    const EpipolarLens cells(barrelCamera(), 2);
    const int width = cells.size().width, middle = 30 * width + 40;
    std::vector<float> kept(static_cast<std::size_t>(width) * cells.size().height, 0.0F);
    kept[middle] = 0.5F;
    FieldPrediction prediction(barrelCamera());
    prediction.keep(kept, {}, 1);
    // The motion moves the near cell two cells to the right: f = 62 cells, depth two units.
    const auto predicted = prediction.in(motion({0, 0, 0}, {-2 * 2 / 62.0, 0, 0}), 1);
    ASSERT_FALSE(predicted.empty());
    EXPECT_FLOAT_EQ(predicted[middle + 2], 0.5F);
    EXPECT_EQ(predicted[middle], 0) << "the uncovered cell must show the background";
}

TEST(FieldPrediction, FramesOfPlacesThatWereNotSeenHaveNoPrediction) {
    const EpipolarLens cells(barrelCamera(), 2);
    FieldPrediction prediction(barrelCamera());
    EXPECT_TRUE(prediction.in({}, 1).empty());
    prediction.keep(truth(cells, {}, slantedStep()), {}, 1);
    EXPECT_FALSE(prediction.in({}, 1).empty());
    EXPECT_FALSE(prediction.in(motion({0, 2, 0}, {0, 0, 0}), 1).empty());
    EXPECT_TRUE(prediction.in(motion({0, 8, 0}, {0, 0, 0}), 1).empty());
    EXPECT_TRUE(prediction.in(motion({0, 180, 0}, {0, 0, 0}), 1).empty());
    EXPECT_TRUE(prediction.in(motion({0, 0, 0}, {0, 0, 1e9}), 1).empty());
    prediction.forget();
    EXPECT_TRUE(prediction.in({}, 1).empty());
}

}  // namespace
}  // namespace mfar
