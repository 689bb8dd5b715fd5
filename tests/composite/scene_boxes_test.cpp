#include "pipeline/composite/scene_boxes.h"
#include "pipeline/composite/silhouette.h"
#include "pipeline/results.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace mfar {
namespace {

const CameraModel kWide{{157, 123}, 150, 152, 82.5, 57.1, {-0.28, 0.07, 0.002, -0.001, 0.004}};
const RigidTransform kEye{Eigen::Quaterniond(0.7, 0.3, -0.5, 0.4).normalized(), {1, 2, -0.5}};

std::shared_ptr<Model> crumpledBall(float radius) {
    std::mt19937 random(7);
    std::normal_distribution<float> normal;
    auto model = std::make_shared<Model>();
    model->materials.resize(1);
    model->meshes.resize(2);
    for (Mesh& mesh : model->meshes) {
        for (std::uint32_t i = 0; i < 300; ++i) {
            const Eigen::Vector3f p =
                radius *
                Eigen::Vector3f(normal(random), normal(random), normal(random)).normalized();
            for (int k = 0; k < 3; ++k)
                mesh.positions.push_back(p + 0.05F * radius * Eigen::Vector3f::Unit(k));
            mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        }
    }
    return model;
}

Scene sceneAt(const Eigen::Vector3d& inCamera, float radius = 0.2F) {
    Scene scene;
    scene.objects.push_back(
        {crumpledBall(radius),
         kEye * RigidTransform{Eigen::Quaterniond(1, 2, 3, 4).normalized(), inCamera}, 1.5F});
    return scene;
}

int coveredTiles(const std::vector<SurfaceRange>& tiles) {
    return static_cast<int>(
        std::count_if(tiles.begin(), tiles.end(), [](const auto& t) { return t.farthest > 0; }));
}

TEST(SceneBoxes, BoxesCoverTheTileOfEveryVisibleVertex) {
    const Scene scene = sceneAt({0.05, -0.02, 0.9});
    SceneBoxes boxes(scene);
    Silhouette silhouette(kWide, 0);
    const auto& tiles = silhouette.run(boxes, kEye);
    const SceneObject& object = scene.objects[0];
    int seen = 0;
    for (const Mesh& mesh : object.model->meshes) {
        for (const Eigen::Vector3f& v : mesh.positions) {
            const Eigen::Vector3d p =
                kEye.inverse() * (object.T_world_object * (object.scale * v).cast<double>());
            const Eigen::Array2i tile =
                ((kWide.project(p.hnormalized()).array() + 0.5) / kTileSize).floor().cast<int>();
            if ((tile < 0).any() || tile.x() >= silhouette.tileCount().width ||
                tile.y() >= silhouette.tileCount().height)
                continue;
            ++seen;
            const SurfaceRange& r = tiles[tile.y() * silhouette.tileCount().width + tile.x()];
            ASSERT_LE(r.nearest, p.z() + 1e-6);
            ASSERT_GE(r.farthest, p.z() - 1e-6);
        }
    }
    EXPECT_GT(seen, 1000);
}

TEST(SceneBoxes, AFewTightBoxesCoverAModel) {
    const Scene scene = sceneAt({0, 0, 3});
    SceneBoxes boxes(scene);
    EXPECT_LT(boxes.world().size(), 217U);
    Silhouette silhouette(kWide, 0);
    // A ball of radius 0.3 at 3 m has a radius of about 16 px around the principal point.
    EXPECT_LE(coveredTiles(silhouette.run(boxes, kEye)), 16);
}

TEST(SceneBoxes, BoxesOfAMovingObjectMoveWithIt) {
    Scene scene = sceneAt({0, 0, 3});
    RigidPath path;
    path.length = 2;
    path.joints.resize(1);
    path.joints[0].T_parent_joint = scene.objects[0].T_world_object;
    path.joints[0].translation = {
        MotionTrack::Between::Linear, {0, 2}, {{0, 0, 0, 0}, {1, 1, -1, 0}}};
    scene.objects[0].path = std::make_shared<const RigidPath>(path);
    SceneBoxes moving(scene);
    EXPECT_TRUE(moving.world().empty());
    EXPECT_FALSE(moving.empty());
    moving.setTime(Timestamp::fromSeconds(1));
    scene.objects[0].T_world_object = path.at(1);
    scene.objects[0].path.reset();
    SceneBoxes still(scene);
    const Scene begin = sceneAt({0, 0, 3});
    SceneBoxes unmoved(begin);
    Silhouette a(kWide, 0), b(kWide, 0), c(kWide, 0);
    const std::vector<SurfaceRange>& moved = a.run(moving, kEye);
    const std::vector<SurfaceRange>& there = b.run(still, kEye);
    const std::vector<SurfaceRange>& before = c.run(unmoved, kEye);
    const auto inBoth = [&](const std::vector<SurfaceRange>& other) {
        int tiles = 0;
        for (std::size_t i = 0; i < there.size(); ++i)
            tiles += other[i].farthest > 0 && there[i].farthest > 0 ? 1 : 0;
        return tiles;
    };
    EXPECT_GE(coveredTiles(there), 6);
    EXPECT_LT(inBoth(before), coveredTiles(there) / 2) << "the object left most of its tiles";
    EXPECT_GE(inBoth(moved), coveredTiles(there) - 2);
    EXPECT_LE(coveredTiles(moved), coveredTiles(there) + 2);
}

TEST(SceneBoxes, TheShadowCatcherHasItsOwnBoxes) {
    Scene scene;
    EXPECT_TRUE(SceneBoxes(scene.catcher).world().empty());
    scene.catcher.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    scene.catcher.triangles = {{0, 1, 2}};
    EXPECT_TRUE(SceneBoxes(scene).world().empty());
    const SceneBoxes boxes(scene.catcher);
    ASSERT_EQ(boxes.world().size(), 1U);
    EXPECT_EQ(boxes.world()[0].max(), Eigen::Vector3d(1, 1, 0));
}

TEST(SceneBoxes, ObjectsOutOfViewOrSeenFromAnInvalidPoseCoverNothing) {
    Silhouette silhouette(kWide, 4);
    for (const Eigen::Vector3d& p :
         {Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(3, 0, 1), Eigen::Vector3d(0, -4, 2)}) {
        SceneBoxes boxes(sceneAt(p));
        EXPECT_EQ(coveredTiles(silhouette.run(boxes, kEye)), 0) << p.transpose();
    }
    SceneBoxes before(sceneAt({0, 0, 1}));
    EXPECT_GT(coveredTiles(silhouette.run(before, kEye)), 0);
    RigidTransform nowhere = kEye;
    nowhere.translation.x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(coveredTiles(silhouette.run(before, nowhere)), 0);
}

TEST(SceneBoxes, SurfacesAroundTheCameraCoverTheWholePicture) {
    Scene scene = sceneAt({0, 0, 0.1});
    auto room = std::make_shared<Model>();
    room->meshes.resize(1);
    for (const ShapeMesh::Vertex& v : shapeMesh(VirtualShape::Box).vertices)
        room->meshes[0].positions.push_back(3 * v.position);
    room->meshes[0].triangles = shapeMesh(VirtualShape::Box).triangles;
    scene.objects[0].model = room;
    SceneBoxes boxes(scene);
    Silhouette silhouette(kWide, 0);
    EXPECT_EQ(coveredTiles(silhouette.run(boxes, kEye)), 80);
}

}  // namespace
}  // namespace mfar
