#include "pipeline/scene/scene_parts.h"
#include "tests/render/picture_driver.h"
#include "tests/render/render_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

namespace mfar {
namespace {

using namespace traced_pictures;
using render_scenes::viewFrom;

constexpr double kFrame = 1.0 / 30;
const Eigen::Quaterniond kUnturned = Eigen::Quaterniond::Identity();

/// The still life. Its red ball moves along this track of translations.
std::shared_ptr<const Scene> movingStillLife(MotionTrack track) {
    auto scene = std::make_shared<Scene>(*render_scenes::stillLife());
    RigidPath path;
    path.length = track.times.back();
    path.joints.resize(1);
    path.joints[0].translation = std::move(track);
    scene->objects[0].path = std::make_shared<const RigidPath>(std::move(path));
    return std::make_shared<const Scene>(sceneAt(*scene, {}));
}

/// The ball moves back and forth by 8 cm in 2 s.
std::shared_ptr<const Scene> swinging() {
    return movingStillLife({MotionTrack::Between::Linear,
                            {0, 1, 2},
                            {{0, -0.04, 0.1, 0}, {0, 0.04, 0.1, 0}, {0, -0.04, 0.1, 0}}});
}

/// The ball jumps by 29 cm at the time 1 s, and back at the time 60 s.
std::shared_ptr<const Scene> jumping() {
    return movingStillLife({MotionTrack::Between::Step,
                            {0, 1, 60},
                            {{0, 0, 0.08, 0}, {0.15, -0.25, 0.08, 0}, {0, 0, 0.08, 0}}});
}

RenderedPicture truthAt(const Scene& scene, const std::vector<RigidTransform>& poses,
                        const RenderView& view) {
    Scene still = withPoses(scene, poses);
    for (SceneObject& object : still.objects)
        object.path.reset();
    const PathTracer tracer(std::make_shared<const Scene>(std::move(still)));
    return render_scenes::resolved(render_scenes::traced(tracer, view, 64), view);
}

/// Root mean square difference of colours inside of objects [grey levels].
double differenceOf(const RenderedPicture& a, const RenderedPicture& truth) {
    double squares = 0;
    int values = 0;
    for (std::size_t i = 0; i < truth.id.size(); ++i) {
        if (a.id[i] == 0 || a.id[i] == kCatcherId || truth.colour[i][3] < 255) continue;
        for (std::size_t c = 0; c < 3; ++c, ++values)
            squares += std::pow(double(a.colour[i][c]) - truth.colour[i][c], 2);
    }
    EXPECT_GT(values, 300);
    return std::sqrt(squares / values);
}

/// Runs frames with a camera at rest and some steps of the tracer in each.
struct MovingRun {
    explicit MovingRun(std::shared_ptr<const Scene> moving, const SliceOptions& slices = kThirtyTwo)
        : scene(std::move(moving)), driver(slices, kProduct) {
        PictureScene prepared = pictureScene(scene, {});
        prepared.objects = 2;
        driver.pictures.setScene(std::make_shared<const PictureScene>(std::move(prepared)));
    }
    void until(double end) {
        for (; time < end; time += kFrame) {
            driver.pictures.look(view, view, Timestamp::fromSeconds(time));
            for (int step = 0; step < 40; ++step)
                driver.step();
        }
    }

    std::shared_ptr<const Scene> scene;
    Driver driver;
    RenderView view = viewFrom(kTracedSize, 20);
    double time = 0;
};

TEST(MovingObjects, ATracerWithNewPosesGivesTheSamePictureAsANewTracer) {
    const auto scene = swinging();
    const PathTracer tracer(scene);
    const auto poses = posesAt(*scene, Timestamp::fromSeconds(0.7));
    const auto posed = tracer.posed(std::make_shared<const Scene>(withPoses(*scene, poses)));
    const RenderView view = viewFrom(kTracedSize, 20);
    const RenderedPicture there =
        render_scenes::resolved(render_scenes::traced(*posed, view, 64), view);
    EXPECT_LT(differenceOf(there, truthAt(*scene, poses, view)), 2);
    EXPECT_GT(differenceOf(there, truthAt(*scene, posesAt(*scene, {}), view)), 6);
}

TEST(MovingObjects, PicturesShowObjectsAtThePosesStoredWithThem) {
    MovingRun run(swinging());
    run.until(1.6);
    ASSERT_GT(run.driver.shown.size(), 5U);
    const RenderedPicture& last = run.driver.shown.back();
    ASSERT_EQ(last.poses.size(), run.scene->objects.size());
    const double error = differenceOf(last, truthAt(*run.scene, last.poses, run.view));
    // In a scene without motion, the error after the same number of pictures is 9 grey levels.
    EXPECT_LT(error, 12);
    const auto misplaced = [&](const std::vector<RigidTransform>& poses) {
        const RenderedPicture truth = truthAt(*run.scene, poses, run.view);
        int count = 0;
        for (std::size_t i = 0; i < truth.id.size(); ++i)
            count += (truth.id[i] == 1) != (last.id[i] == 1) ? 1 : 0;
        return count;
    };
    const auto elsewhere = posesAt(*run.scene, Timestamp::fromSeconds(1));
    EXPECT_GT(misplaced(elsewhere), misplaced(last.poses) + 10)
        << "number of pixels with a wrong object";
    EXPECT_EQ(last.scene, run.scene);
    EXPECT_TRUE(last.layered);
    const double from = last.poses[0].translation.y(),
                 now = posesAt(*run.scene, Timestamp::fromSeconds(run.time))[0].translation.y();
    EXPECT_LT(std::abs(from - now), 0.03) << "the picture must show nearly the present poses";
}

TEST(MovingObjects, NewPicturesAreMadeAsLongAsAnObjectMoves) {
    MovingRun run(swinging());
    run.until(1);
    const std::size_t before = run.driver.shown.size();
    run.until(2);
    EXPECT_GT(run.driver.shown.size(), before + 5);
}

TEST(MovingObjects, NewPicturesAreMadeAlsoWithSpatialSlicing) {
    SliceOptions spatial = kThirtyTwo;
    spatial.slicing = Slicing::Spatial;
    MovingRun run(swinging(), spatial);
    run.until(4);
    EXPECT_GT(run.driver.shown.size(), 2U);
}

TEST(MovingObjects, NoShadowStaysWhereTheObjectWas) {
    MovingRun run(jumping());
    run.until(1);
    const RenderedPicture before = run.driver.shown.back();
    run.until(1.5);
    const RenderedPicture after = run.driver.shown.back();
    const RenderedPicture truth = truthAt(*run.scene, after.poses, run.view);
    double ghost = 0;
    int shadowed = 0;
    for (std::size_t i = 0; i < truth.id.size(); ++i) {
        // Compares only pixels that were in the object's shadow before it jumped and must be lit
        // now.
        if (before.id[i] != kCatcherId || before.colour[i][3] < 25 || truth.colour[i][3] > 15)
            continue;
        ++shadowed;
        ghost += std::abs(double(after.colour[i][3]) - truth.colour[i][3]);
    }
    ASSERT_GT(shadowed, 20);
    EXPECT_LT(ghost / shadowed, 8) << "mean error of the alpha in the old shadow, 0 to 255";
}

TEST(MovingObjects, LightFarFromTheMotionIsKept) {
    const auto scene = swinging();
    const PathTracer tracer(scene);
    const Film film(kTracedSize);
    const RenderView view = viewFrom(kTracedSize, 20);
    const auto later = posesAt(*scene, Timestamp::fromSeconds(0.2));
    const auto posed = tracer.posed(std::make_shared<const Scene>(withPoses(*scene, later)));
    const auto history = posed->historyOf(film, view, 64, posesAt(*scene, {}));
    const MovedLight* moved = history.moved();
    ASSERT_NE(moved, nullptr);
    const Eigen::Vector3f up{0, 0, 1};
    const float near = moved->diffuseChange({0, 0.05F, 0}, up),
                far = moved->diffuseChange({-2, 2, 0}, up);
    EXPECT_GT(near, 0.1F);
    EXPECT_LT(far, 0.002F);
    EXPECT_LT(stillWorth(64, near), 12);
    EXPECT_GT(stillWorth(64, far), 60);
    const auto same = posed->historyOf(film, view, 64, later);
    EXPECT_EQ(same.moved()->diffuseChange({0, 0.05F, 0}, up), 0);
}

TEST(MovingObjects, DiffuseLightChangesOnlyInTheShadowOfAMovedObject) {
    Sun sun;
    sun.towards = Eigen::Vector3f(1, 0, 1).normalized();
    Scene dark;
    dark.lighting.sun = sun;
    const EnvironmentLight none(nullptr);
    const FarLight far(none, dark.lighting, dark.catcher);
    const SunLight light(sun);
    const MovedLight::Object ball{
        1, {{0, 0, 0}, 0.1}, {kUnturned, {0, 0, 2}}, {kUnturned, {0, 0.02, 2}}, 0};
    const MovedLight moved({&ball, 1}, light, far);
    const Eigen::Vector3f up{0, 0, 1};
    EXPECT_GT(moved.diffuseChange({-2, 0, 0}, up), 0.1F);
    EXPECT_EQ(moved.diffuseChange({2, 0, 0}, up), 0);
}

TEST(MovingObjects, ShadowsOfOtherMovedObjectsChangeTheLightOnAMovedObject) {
    Sun sun;
    sun.towards = Eigen::Vector3f(0, 0, 1);
    Scene dark;
    dark.lighting.sun = sun;
    const EnvironmentLight none(nullptr);
    const FarLight far(none, dark.lighting, dark.catcher);
    const SunLight light(sun);
    const RigidTransform low{kUnturned, {0, 0, 0.001}}, high{kUnturned, {0, 0, 2}};
    const auto changeOfLow = [&](const RigidTransform& highNow) {
        const std::array objects{MovedLight::Object{1, {{0, 0, 0}, 0.5}, {}, low, 0},
                                 MovedLight::Object{2, {{0, 0, 0}, 0.1}, high, highNow, 0}};
        SeenSurface top;
        top.hit.id = 1;
        top.normal = {0, 0, 1};
        return MovedLight(objects, light, far).at(top, {0, 0, 0.5F}, {3, 0, 3}).diffuse;
    };
    EXPECT_GT(changeOfLow({kUnturned, {0, 0.02, 2}}), 0.1F);
    EXPECT_LT(changeOfLow({kUnturned, {0, 0, 2.001}}), 0.01F) << "both move alike";
}

TEST(MovingObjects, FollowMovesPointsOfAnObjectToTheirEarlierPositions) {
    const EnvironmentLight none(nullptr);
    const FarLight far(none, {}, {});
    const SunLight light({});
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()));
    const MovedLight::Object ball{
        3, {{0, 0, 0}, 0.1}, {kUnturned, {1, 0, 0}}, {turn, {1, 2, 0}}, 0};
    const MovedLight moved({&ball, 1}, light, far);
    const Eigen::Vector3f p{0.1F, 0, 0.05F}, x = Eigen::Vector3f::UnitX();
    Eigen::Vector3f point = turn.cast<float>() * p + Eigen::Vector3f(1, 2, 0),
                    normal = turn.cast<float>() * x, eye = point;
    moved.follow(3, point, normal, eye);
    EXPECT_LT((point - (p + Eigen::Vector3f(1, 0, 0))).norm(), 1e-5F);
    EXPECT_LT((normal - x).norm(), 1e-5F);
    moved.follow(2, normal, point, eye);
    EXPECT_LT((normal - x).norm(), 1e-5F) << "points of other objects must not move";
}

}  // namespace
}  // namespace mfar
