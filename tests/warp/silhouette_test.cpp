#include "pipeline/gles/model_silhouette.h"
#include "tests/engine/gl_test.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace mfar {
namespace {

using SilhouetteGl = GlTest;

constexpr Size kSeen{60, 40};

CameraModel seeing() {
    return {kSeen, 50, 50, 29.5, 19.5, {}};
}

/// A square of 0.4 m about (x, 0, 1) that faces a camera at the origin.
SceneObject squareAt(double x, const Material& material) {
    auto model = std::make_shared<Model>();
    Mesh mesh;
    mesh.positions = {{-0.2F, -0.2F, 0}, {-0.2F, 0.2F, 0}, {0.2F, 0.2F, 0}, {0.2F, -0.2F, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    model->meshes.push_back(mesh);
    model->materials.push_back(material);
    return {model, {Eigen::Quaterniond::Identity(), {x, 0, 1}}, 1};
}

SceneObject turnedRound(SceneObject object) {
    object.T_world_object.rotation =
        Eigen::Quaterniond(Eigen::AngleAxisd(3.14159265358979, Eigen::Vector3d::UnitY()));
    return object;
}

std::array<int, 256> pixelsOfEach(const gpu::Texture& surface) {
    const Size size = surface.size();
    std::vector<std::array<std::uint32_t, 4>> texels(static_cast<std::size_t>(size.width) *
                                                     static_cast<std::size_t>(size.height));
    const gpu::Framebuffer from(surface);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from.id());
    glReadPixels(0, 0, size.width, size.height, GL_RGBA_INTEGER, GL_UNSIGNED_INT, texels.data());
    std::array<int, 256> out{};
    for (const auto& texel : texels)
        ++out[texel[0] & 0xff];
    return out;
}

std::array<int, 256> seen(ModelSilhouette& silhouette) {
    silhouette.draw({}, {0, 0, kSeen.width, kSeen.height});
    return pixelsOfEach(silhouette.surface());
}

std::array<int, 256> seen(std::vector<SceneObject> objects) {
    ModelSilhouette silhouette(seeing());
    Scene scene;
    scene.objects = std::move(objects);
    silhouette.setScene(scene);
    return seen(silhouette);
}

constexpr int kSquare = 4 * 20 * 20;  // pixels of the square, at twice the resolution

TEST_F(SilhouetteGl, BackFacesAreVisibleOnlyIfTwoSided) {
    Material twoSided;
    twoSided.doubleSided = true;
    EXPECT_NEAR(seen({squareAt(0, {})})[1], kSquare, 200);
    EXPECT_EQ(seen({turnedRound(squareAt(0, {}))})[1], 0);
    EXPECT_NEAR(seen({turnedRound(squareAt(0, twoSided))})[1], kSquare, 200);
}

TEST_F(SilhouetteGl, SurfacesWithTransparentAlphaFactorAreNotDrawn) {
    Material pane;
    pane.baseColour.w() = 0.2F;
    pane.alphaCutoff = 0.5F;
    Material solid = pane;
    solid.baseColour.w() = 0.6F;
    EXPECT_EQ(seen({squareAt(0, pane)})[1], 0);
    EXPECT_NEAR(seen({squareAt(0, solid)})[1], kSquare, 200);
}

TEST_F(SilhouetteGl, AnotherSceneWithTheSameModelsShowsThemAtTheirNewPoses) {
    const SceneObject left = squareAt(-0.25, {}), right = squareAt(0.25, {});
    ModelSilhouette silhouette(seeing());
    Scene scene;
    scene.objects = {left, right};
    silhouette.setScene(scene);
    EXPECT_EQ(silhouette.triangles(), 4U);
    EXPECT_NEAR(seen(silhouette)[1], seen(silhouette)[2], 100);
    scene.objects = {right, squareAt(5, {})};
    silhouette.setScene(scene);
    EXPECT_EQ(silhouette.triangles(), 4U);
    const auto now = seen(silhouette);
    EXPECT_NEAR(now[1], kSquare, 200);
    EXPECT_EQ(now[2], 0);
}

}  // namespace
}  // namespace mfar
