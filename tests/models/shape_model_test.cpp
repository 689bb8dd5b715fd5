#include "pipeline/models/shape_model.h"
#include "tests/fuzz/sound_model.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace mfar {
namespace {

TEST(ShapeModel, ShapesAreValidModelsOfTheirSize) {
    for (const VirtualShape shape : {VirtualShape::Box, VirtualShape::Sphere, VirtualShape::Quad}) {
        VirtualObject object;
        object.shape = shape;
        object.size = {0.1, 0.2, 0.4};
        const Model model = shapeModel(object);
        EXPECT_NO_THROW(test::requireSoundModel(model));
        Eigen::AlignedBox3f box;
        for (const Eigen::Vector3f& p : model.meshes.at(0).positions)
            box.extend(p);
        const bool flat = shape == VirtualShape::Quad;
        EXPECT_LT((box.sizes() - Eigen::Vector3f(0.1F, 0.2F, flat ? 0 : 0.4F)).norm(), 1e-3F);
        EXPECT_EQ(model.materials[0].doubleSided, flat);
    }
}

// The normal is the gradient of the ellipsoid's equation, not the stretched normal of a sphere.
TEST(ShapeModel, EllipsoidNormalsAreTheSurfaceGradients) {
    VirtualObject object;
    object.shape = VirtualShape::Sphere;
    object.size = {1, 2, 4};
    const Model model = shapeModel(object);
    const Mesh& mesh = model.meshes.at(0);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Eigen::Vector3f& p = mesh.positions[i];
        const Eigen::Vector3f gradient = Eigen::Vector3f(p.x(), p.y() / 4, p.z() / 16).normalized();
        ASSERT_LT((mesh.normals[i] - gradient).norm(), 1e-4F);
    }
}

TEST(ShapeModel, TheCheckerboardHasTheObjectsSquaresAndColours) {
    VirtualObject object;
    object.squares = 3;
    const Model model = shapeModel(object);
    const SurfaceTexture& texture = model.textures.at(0);
    const auto at = [&](float u, float v) {
        const auto x = static_cast<std::size_t>(u * texture.size.width),
                   y = static_cast<std::size_t>(v * texture.size.height);
        return texture.texels[y * texture.size.width + x];
    };
    const std::array<std::uint8_t, 4> first = {230, 230, 230, 255}, second = {204, 51, 26, 255};
    EXPECT_EQ(at(0.1F, 0.1F), first);
    EXPECT_EQ(at(0.5F, 0.1F), second);
    EXPECT_EQ(at(0.5F, 0.5F), first);
    EXPECT_EQ(at(0.1F, 0.9F), first);
    object.colours[1] = object.colours[0];
    const Model plain = shapeModel(object);
    EXPECT_TRUE(plain.textures.empty());
    EXPECT_NEAR(plain.materials[0].baseColour.x(), 0.791F, 0.005F)
        << "the base colour must be linear";
}

}  // namespace
}  // namespace mfar
