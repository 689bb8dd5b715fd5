#include "daemon/config.h"
#include "tests/daemon/config_faults.h"

#include <gtest/gtest.h>

#include <fstream>
#include <gmock/gmock.h>
#include <sstream>
#include <string>

namespace mfar {
namespace {

using test::configFaults;
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
    const VirtualObject& first = config.objects[0];
    EXPECT_EQ(first.shape, VirtualShape::Sphere);
    EXPECT_EQ(first.size, Eigen::Vector3d(0.1, 0.2, 0.3));
    EXPECT_EQ(first.T_world_object.translation, Eigen::Vector3d(-1, 2.5, 0));
    EXPECT_EQ(first.T_world_object.rotation.x(), 1);
    EXPECT_EQ(first.colours[0], Eigen::Vector3f(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(first.colours[1], Eigen::Vector3f(1, 1, 1));
    EXPECT_EQ(first.squares, 8);
    const VirtualObject& second = config.objects[1];
    EXPECT_EQ(second.shape, VirtualShape::Box);
    EXPECT_EQ(second.size, Eigen::Vector3d(0.1, 0.1, 0.1));
    EXPECT_EQ(second.colours[1], Eigen::Vector3f(0.5F, 0.5F, 0.5F)) << "one alone is the whole's";
}

TEST(ObjectsConfig, FaultsHaveTheirPlace) {
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
    std::string many;
    for (int i = 0; i < 65; ++i)
        many += "[[objects]]\n";
    EXPECT_THAT(configFaults(many), HasSubstr("at most 64"));
}

// The default file shows an object in comments: as it stands there it must be right.
TEST(ObjectsConfig, TheDefaultFilesExampleIsValid) {
    std::ifstream in(MFAR_DEFAULT_CONFIG);
    std::string text, line;
    bool inExample = false;
    while (std::getline(in, line)) {
        inExample = inExample || line == "# [[objects]]";
        if (inExample && line.starts_with("# ")) text += line.substr(2) + "\n";
    }
    ASSERT_TRUE(inExample);
    const Config config = parseConfig(text, "example");
    ASSERT_EQ(config.objects.size(), 1U);
    const VirtualObject plain;
    EXPECT_EQ(config.objects[0].colours, plain.colours);
    EXPECT_EQ(config.objects[0].squares, plain.squares);
}

}  // namespace
}  // namespace mfar
