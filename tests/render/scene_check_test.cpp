#include "pipeline/render/scene_check.h"
#include "tests/render/render_scenes.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>

namespace mfar {
namespace {

using namespace render_scenes;

constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();

void expectUnsound(const std::function<void(Scene&, Model&)>& change) {
    Scene scene;
    Model model = modelOf(sphere({0, 0, 0}, 1, 4), {});
    scene.catcher = ground(1, 0.5F);
    scene.lighting = {evenLight(1), Sun{}};
    scene.lighting.sun->towards = {0, 0, 1};
    scene.objects.emplace_back();
    const auto withModels = [](Scene shown, const Model& ofAll) {
        const auto shared = std::make_shared<const Model>(ofAll);
        for (SceneObject& object : shown.objects)
            object.model = shared;
        return shown;
    };
    ASSERT_NO_THROW(validate(withModels(scene, model)))
        << "the scene must be valid before the change";
    change(scene, model);
    EXPECT_THROW(validate(withModels(scene, model)), std::invalid_argument);
}

TEST(SceneCheck, ValidScenesAreAccepted) {
    EXPECT_NO_THROW(validate(Scene{}));
    Scene scene;
    scene.objects.push_back(objectOf(modelOf(square(1, 0), {})));
    scene.catcher = ground(1, 1);
    scene.lighting.sun = Sun{};
    EXPECT_NO_THROW(validate(scene));
}

TEST(SceneCheck, FaultsOfModelsAreFound) {
    expectUnsound([](Scene&, Model& m) { m.materials.clear(); });
    expectUnsound([](Scene&, Model& m) { m.meshes[0].positions[3].x() = kNotANumber; });
    expectUnsound([](Scene&, Model& m) { m.meshes[0].normals.pop_back(); });
    expectUnsound([](Scene&, Model& m) { m.meshes[0].triangles[0][2] = 1000; });
    expectUnsound([](Scene&, Model& m) { m.meshes[0].material = 1; });
    expectUnsound([](Scene&, Model& m) { m.materials[0].normalTexture = 0; });
    expectUnsound([](Scene&, Model& m) { m.materials[0].roughness = kNotANumber; });
    for (const float emission : {-1.0F, kNotANumber, std::numeric_limits<float>::infinity()})
        expectUnsound([=](Scene&, Model& m) { m.materials[0].emission.y() = emission; });
    expectUnsound([](Scene&, Model& m) { m.textures.push_back({{2, 2}, true, {}}); });
}

TEST(SceneCheck, FaultsOfTheSceneAreFound) {
    expectUnsound([](Scene& s, Model&) { s.objects[0].scale = 0; });
    expectUnsound(
        [](Scene& s, Model&) { s.objects[0].T_world_object.translation.z() = kNotANumber; });
    expectUnsound([](Scene& s, Model&) { s.objects.resize(251); });
    expectUnsound([](Scene& s, Model&) { s.catcher.triangles[0][0] = 99; });
    expectUnsound([](Scene& s, Model&) { s.catcher.albedo.x() = 1.5F; });
    expectUnsound([](Scene& s, Model&) { s.lighting.sun->angularRadius = 0; });
    expectUnsound([](Scene& s, Model&) { s.lighting.sun->towards = {0, 0, 0}; });
    expectUnsound([](Scene& s, Model&) { s.lighting.sun->irradiance.x() = kNotANumber; });
    expectUnsound([](Scene& s, Model&) {
        auto broken = std::make_shared<Environment>(*s.lighting.environment);
        broken->radiance.pop_back();
        s.lighting.environment = broken;
    });
}

}  // namespace
}  // namespace mfar
