#include "daemon/config.h"
#include "daemon/virtual_world.h"
#include "tests/daemon/config_faults.h"
#include "tests/models/gltf_maker.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <gmock/gmock.h>
#include <sstream>
#include <string>

namespace mfar {
namespace {

using test::configFaults;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST(ObjectsConfig, EveryKeyIsRead) {
    const Config config = parseConfig(R"(
[[objects]]
shape = "sphere"
size = [0.1, 0.2, 0.3]
position = [-1, 2.5, 0]
orientation = [0.0, 1, 0, 0]
colour = [0.1, 0.2, 0.3]
second_colour = [1, 1, 1]
squares = 8
[[objects]]
colour = [0.5, 0.5, 0.5]
)",
                                      "test.toml");
    ASSERT_EQ(config.objects.size(), 2U);
    EXPECT_FALSE(config.objects[0].model);
    EXPECT_FALSE(config.objects[0].tag);
    const VirtualObject& first = config.objects[0].shape;
    EXPECT_EQ(first.shape, VirtualShape::Sphere);
    EXPECT_EQ(first.size, Eigen::Vector3d(0.1, 0.2, 0.3));
    const RigidTransform& place = config.objects[0].T_anchor_object;
    EXPECT_EQ(place.translation, Eigen::Vector3d(-1, 2.5, 0));
    EXPECT_EQ(place.rotation.x(), 1);
    EXPECT_EQ(first.colours[0], Eigen::Vector3f(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(first.colours[1], Eigen::Vector3f(1, 1, 1));
    EXPECT_EQ(first.squares, 8);
    const VirtualObject& second = config.objects[1].shape;
    EXPECT_EQ(second.shape, VirtualShape::Box);
    EXPECT_EQ(second.size, Eigen::Vector3d(0.1, 0.1, 0.1));
    EXPECT_EQ(second.colours[1], Eigen::Vector3f(0.5F, 0.5F, 0.5F))
        << "a single colour must apply to the whole object";
}

TEST(ObjectsConfig, IfThereAreTooManyObjectsOnlyTheirNumberIsReported) {
    std::string text;
    for (int i = 0; i < 65; ++i)
        text += "[[objects]]\nshape = \"sphere\"\n";
    EXPECT_EQ(configFaults(text),
              "test.toml:1:1: found 65 sections [[objects]]; at most 64 are allowed");
}

TEST(ObjectsConfig, FaultsAreReportedWithLineAndColumn) {
    EXPECT_THAT(configFaults("[[objects]]\nshape = \"teapot\"\n"),
                StartsWith("test.toml:2:9: objects[0].shape = \"teapot\": must be one of \"box\""));
    EXPECT_THAT(configFaults("[[objects]]\n[[objects]]\nsize = [1, 2]\n"),
                StartsWith("test.toml:3:8: objects[1].size must be a list of 3 numbers"));
    EXPECT_THAT(configFaults("[[objects]]\nsize = [1, nan, 1]\n"),
                StartsWith("test.toml:2:12: objects[0].size must hold numbers from 0.001 to 100"));
    EXPECT_THAT(configFaults("[[objects]]\norientation = [0, 0, 0, 0]\n"), HasSubstr("length 1"));
    EXPECT_THAT(
        configFaults("[[objects]]\npositon = [0, 0, 0]\n"),
        StartsWith("test.toml:2:1: unknown key objects[0].positon; the nearest known one is "
                   "objects[0].position"));
    EXPECT_THAT(configFaults("objects = 3\n"), HasSubstr("sections [[objects]]"));
    EXPECT_THAT(configFaults("[objects]\nsize = [1, 1, 1]\n"), HasSubstr("sections [[objects]]"));
}

TEST(ObjectsConfig, ModelsAreRead) {
    const test::TempFolder folder;
    const std::vector<std::uint8_t> glb = test::oneTriangle().glb();
    test::writeFile(folder / "thing.glb", {reinterpret_cast<const char*>(glb.data()), glb.size()});
    const Config config = parseConfig(R"(
[[objects]]
model = "thing.glb"
scale = 0.5
tag = 3
position = [0, 0.1, 0]
[[objects]]
model = "showpiece"
tag = 1
family = "tag25h9"
[[objects]]
model = "thing.glb"
)",
                                      (folder / "test.toml").string());
    ASSERT_EQ(config.objects.size(), 3U);
    EXPECT_EQ(config.objects[0].model, config.objects[2].model)
        << "a file that two objects name must be read once";
    const PlacedObject& thing = config.objects[0];
    ASSERT_TRUE(thing.model);
    EXPECT_EQ(thing.model->meshes.size(), 1U);
    EXPECT_EQ(thing.modelName, "thing.glb");
    EXPECT_EQ(thing.scale, 0.5F);
    EXPECT_EQ(thing.tag, (TagKey{TagFamily::Tag36h11, 3}));
    EXPECT_EQ(thing.T_anchor_object.translation.y(), 0.1);
    ASSERT_TRUE(config.objects[1].model);
    EXPECT_EQ(config.objects[1].tag, (TagKey{TagFamily::Tag25h9, 1}));
    EXPECT_TRUE(placedShapes(config.objects, {}).empty());
}

TEST(ObjectsConfig, ObjectsReadAgainAreEqualUnlessTheirConfigurationOrModelChanged) {
    const test::TempFolder folder;
    const auto read = [&](const std::string& place) {
        return parseConfig("[[objects]]\nmodel = \"a.glb\"\nposition = [" + place + "]\n",
                           (folder / "test.toml").string())
            .objects;
    };
    test::GltfMaker maker = test::oneTriangle();
    const auto save = [&] {
        const std::vector<std::uint8_t> glb = maker.glb();
        test::writeFile(folder / "a.glb", {reinterpret_cast<const char*>(glb.data()), glb.size()});
    };
    save();
    const auto first = read("0, 0, 1");
    EXPECT_TRUE(first == read("0, 0, 1"));
    EXPECT_FALSE(first == read("0, 0, 2"));
    maker.root["nodes"][0]["translation"] = {0, 0, 0.5};
    save();
    EXPECT_FALSE(first == read("0, 0, 1"));
}

TEST(ObjectsConfig, AFileWithSeveralNamesIsReadOnce) {
    const test::TempFolder folder;
    const std::vector<std::uint8_t> glb = test::oneTriangle().glb();
    test::writeFile(folder / "thing.glb", {reinterpret_cast<const char*>(glb.data()), glb.size()});
    std::filesystem::create_symlink(folder / "thing.glb", folder / "same.glb");
    const std::string name = (folder / "test.toml").string();
    const std::string object = "[[objects]]\nmodel = ";
    const Config config =
        parseConfig(object + "\"thing.glb\"\n" + object + "\"./thing.glb\"\n" + object +
                        "\"same.glb\"\n" + object + "\"" + (folder / "thing.glb").string() + "\"\n",
                    name);
    ASSERT_EQ(config.objects.size(), 4U);
    for (const PlacedObject& one : config.objects)
        EXPECT_EQ(one.model, config.objects[0].model) << one.modelName;
}

TEST(ObjectsConfig, TooManyMovingPartsAreRefusedAtTheObjectThatExceedsTheLimit) {
    const test::TempFolder folder;
    test::GltfMaker maker = test::oneTriangle();
    for (int node = 0; node < 16; ++node) {
        if (node > 0) maker.root["nodes"].push_back({{"mesh", 0}});
        maker.root["scenes"][0]["nodes"][node] = node;
        maker.animate(node, "translation", {0, 1}, {0, 0, 0, 1, 0, 0});
    }
    const std::vector<std::uint8_t> glb = maker.glb();
    test::writeFile(folder / "a.glb", {reinterpret_cast<const char*>(glb.data()), glb.size()});
    const std::string object = "[[objects]]\nmodel = \"" + (folder / "a.glb").string() + "\"\n";
    std::string many;
    for (int i = 0; i < 14; ++i)
        many += object;
    EXPECT_EQ(configFaults(many), "");
    EXPECT_THAT(configFaults(many + object),
                AllOf(StartsWith("test.toml:30:9: objects[14].model"), HasSubstr("more than 250")));
    for (int i = 0; i < 12; ++i)
        many += "[[objects]]\nshape = \"sphere\"\n";
    EXPECT_EQ(configFaults(many), "") << "238 parts of models and 12 shapes must be accepted";
    EXPECT_THAT(configFaults(many + "[[objects]]\n"),
                AllOf(StartsWith("test.toml:28:9: objects[13].model"), HasSubstr("more than 250")));
}

TEST(ObjectsConfig, UnreadableModelsAreReportedWithLineAndColumn) {
    EXPECT_THAT(configFaults("[[objects]]\nmodel = \"none.glb\"\n"),
                StartsWith("test.toml:2:9: objects[0].model = \"none.glb\": none.glb: is missing"));
    EXPECT_THAT(configFaults("[[objects]]\nscale = 0\n"), HasSubstr("objects[0].scale must be"));
    EXPECT_THAT(configFaults("[[objects]]\ntag = 600\n"),
                StartsWith("test.toml:2:7: objects[0].tag must be from 0 to 586"));
    EXPECT_THAT(configFaults("[[objects]]\nfamily = \"tag99\"\n"),
                HasSubstr("must be one of \"tag36h11\""));
}

// The tag is on a wall that faces the world's -y. The tag's x axis is the world's x, the tag's y
// axis is the world's -z.
TEST(ObjectsConfig, ObjectsAreAnchoredToTheirTag) {
    const TagKey key{TagFamily::Tag36h11, 5};
    Eigen::Matrix3d R_world_tag;
    R_world_tag << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    const RigidTransform T_world_tag{Eigen::Quaterniond(R_world_tag), {1, 2, 3}};
    const TagMap map({{key, 0.1, T_world_tag}});
    PlacedObject object;
    object.T_anchor_object.translation = {0.1, 0.2, 0.3};
    EXPECT_EQ(worldPlace(object, map).value().translation, Eigen::Vector3d(0.1, 0.2, 0.3));
    object.tag = key;
    const RigidTransform T = worldPlace(object, map).value();
    // The offset points to the right along the wall, upwards, and out of the wall.
    EXPECT_LT((T.translation - Eigen::Vector3d(1.1, 1.7, 3.2)).norm(), 1e-9);
    EXPECT_LT((T.rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d(0, -1, 0)).norm(), 1e-9);
    const Scene scene = sceneOf({object}, {}, map);
    ASSERT_EQ(scene.objects.size(), 1U);
    EXPECT_LT((scene.objects[0].T_world_ground.translation - Eigen::Vector3d(1, 2, 3)).norm(),
              1e-9);
    EXPECT_LT((scene.objects[0].T_world_ground.rotation.inverse() * T.rotation).vec().norm(), 1e-9);
    ASSERT_EQ(placedShapes({object}, map).size(), 1U);
    EXPECT_LT((placedShapes({object}, map)[0].T_world_object.translation - T.translation).norm(),
              1e-12);
    object.tag->id = 6;
    EXPECT_FALSE(worldPlace(object, map))
        << "an object on a tag that is not in the map has no pose";
    EXPECT_TRUE(placedShapes({object}, map).empty());
}

TEST(ObjectsConfig, NotesOfAModelAreReportedOnce) {
    auto model = std::make_shared<Model>();
    model->notes = {"a.glb: animations[0]: first", "a.glb: skins[0]: second"};
    PlacedObject shape, one;
    one.model = model;
    EXPECT_EQ(modelNotes({shape, one, one}), model->notes);
    EXPECT_TRUE(modelNotes({shape}).empty());
}

TEST(ObjectsConfig, KeysWithoutEffectAreReported) {
    Config config = parseConfig("[[objects]]\nshape = \"sphere\"\nscale = 2\n"
                                "[[objects]]\nmodel = \"showpiece\"\nshape = \"sphere\"\n"
                                "colour = [1, 0, 0]\nscale = 2\n",
                                "test.toml");
    const std::vector<std::string> unused{
        "test.toml:3:9: objects[0].scale: has no effect, because the object is a simple shape",
        "test.toml:6:9: objects[1].shape: has no effect, because the object is a model",
        "test.toml:7:10: objects[1].colour: has no effect, because the object is a model"};
    EXPECT_EQ(notesOf(config), unused);
    config.pose.source = PoseOrigin::None;
    EXPECT_THAT(
        notesOf(config),
        testing::Contains("no object of [[objects]] is shown, because pose.source is \"none\""));
    config.objects.clear();
    EXPECT_EQ(notesOf(config), unused);
}

TEST(ObjectsConfig, OmittedObjectsAreReported) {
    const TagMap map({{{TagFamily::Tag36h11, 5}, 0.1, {}}});
    PlacedObject shape, onTag, model;
    onTag.tag = TagKey{TagFamily::Tag25h9, 6};
    model.model = std::make_shared<const Model>();
    model.modelName = "jar.glb";
    EXPECT_THAT(
        leftOut({shape, onTag, model}, map, ""),
        testing::ElementsAre("objects[1] is not shown: it stands on tag 6 of family tag25h9, "
                             "and this tag is not in the tag map"));
    EXPECT_THAT(leftOut({model}, map, "there is no tracer"),
                testing::ElementsAre(
                    "objects[0] is not shown: jar.glb is a model, but there is no tracer"));
    onTag.tag = TagKey{TagFamily::Tag36h11, 5};
    EXPECT_TRUE(leftOut({shape, onTag}, map, "there is no tracer").empty());
}

}  // namespace
}  // namespace mfar
