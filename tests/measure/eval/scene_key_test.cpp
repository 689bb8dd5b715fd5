#include "pipeline/scene/scene.h"
#include "tests/measure/eval/scene_key.h"
#include "tests/measure/eval/warp_scenes.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>

namespace mfar::eval {
namespace {

TEST(SceneKey, IsTheSameForEachCopyOfAScene) {
    for (const std::string& name : warpSceneNames())
        EXPECT_EQ(sceneKey(*warpScene(name)), sceneKey(*warpScene(name))) << name;
    EXPECT_NE(sceneKey(*warpScene("still-life")), sceneKey(*warpScene("showpiece")));
}

/// Returns a function that changes the model of the first object.
std::function<void(Scene&)> inModel(const std::function<void(Model&)>& change) {
    return [change](Scene& scene) {
        Model model = *scene.objects.front().model;
        change(model);
        scene.objects.front().model = std::make_shared<const Model>(std::move(model));
    };
}

std::function<void(Scene&)> inEnvironment(const std::function<void(Environment&)>& change) {
    return [change](Scene& scene) {
        Environment environment = *scene.lighting.environment;
        change(environment);
        scene.lighting.environment = std::make_shared<const Environment>(std::move(environment));
    };
}

TEST(SceneKey, ChangesWithEveryPartOfTheScene) {
    const auto scene = warpScene("still-life");
    const std::uint64_t key = sceneKey(*scene);
    const std::function<void(Scene&)> changes[] = {
        [](Scene& s) { s.objects.pop_back(); },
        [](Scene& s) { s.objects.back().T_world_object.translation.x() += 1e-3; },
        [](Scene& s) { s.objects.back().T_world_ground.translation.z() += 1e-3; },
        [](Scene& s) { s.objects.back().scale *= 1.01F; },
        [](Scene& s) { s.objects.back().path = std::make_shared<const RigidPath>(); },
        inModel([](Model& m) { m.meshes.front().positions.front().x() += 1e-3F; }),
        inModel([](Model& m) { m.materials.front().roughness += 0.01F; }),
        inEnvironment([](Environment& e) { e.radiance.back().x() += 0.01F; }),
        [](Scene& s) { s.lighting.environment.reset(); },
        [](Scene& s) { s.lighting.sun->irradiance.y() += 0.01F; },
        [](Scene& s) { s.lighting.sun.reset(); },
        [](Scene& s) { s.catcher.positions.front().z() += 1e-3F; },
        [](Scene& s) { s.catcher.triangles.pop_back(); },
        [](Scene& s) { s.catcher.albedo.x() = 0.5F; },
    };
    int number = 0;
    for (const auto& change : changes) {
        Scene changed = *scene;
        change(changed);
        EXPECT_NE(sceneKey(changed), key) << "change " << number;
        ++number;
    }
}

}  // namespace
}  // namespace mfar::eval
