#include "pipeline/track/tag_map.h"
#include "tests/unit/temp_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace mfar {
namespace {

constexpr const char* kGood = R"(# a comment
family = "tag36h11"

[[tags]]
id = 3
size = 0.08
position = [0.1, -0.2, 1]
orientation = [0.5, 0.5, -0.5, 0.5]

[[tags]]
id = 3
family = "tag16h5"
size = 1
position = [0, 0, 0]
orientation = [1, 0, 0, 0]
)";

constexpr const char* kBundle = R"(standalone_tags:
  - {id: 9, size: 0.2}
tag_bundles:
  - name: desk
    layout:
      - {id: 1, size: 0.05, x: 0, y: 0, z: 0, qw: 1, qx: 0, qy: 0, qz: 0}
      - {id: 2, size: 0.05, x: 0.1, y: 0.2}
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

template <class F>
std::string refusal(const F& read) {
    try {
        read();
    } catch (const TagMapError& error) {
        return error.what();
    }
    return "not refused";
}

TEST(TagMap, ReadsToml) {
    const TagMap map = tagMapFromToml(kGood, "tags.toml");
    ASSERT_EQ(map.tags().size(), 2U);
    EXPECT_EQ(map.families(), (std::vector{TagFamily::Tag36h11, TagFamily::Tag16h5}));
    const MappedTag* tag = map.find({TagFamily::Tag36h11, 3});
    ASSERT_NE(tag, nullptr);
    EXPECT_EQ(tag->size, 0.08);
    EXPECT_EQ(tag->T_world_tag.translation, Eigen::Vector3d(0.1, -0.2, 1));
    EXPECT_TRUE(tag->T_world_tag.rotation.isApprox(Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5)));
    EXPECT_EQ(map.find({TagFamily::Tag36h11, 4}), nullptr);
}

TEST(TagMap, BrokenTomlIsRefusedWithFileAndLine) {
    const std::vector<std::tuple<std::string, std::string, std::string>> cases{
        {"id = 3", "id = ", "t.toml:5: "},
        {"id = 3", "id = 587", "t.toml:5: id must be from 0 to 586 in family tag36h11, not 587"},
        {"id = 3", "id = -1", "t.toml:5: id must be"},
        {"id = 3", "id = 3.5", "t.toml:5: id must be a whole number"},
        {"id = 3", "ident = 3", "t.toml:5: unknown key ident; expected one of id, size"},
        {"size = 0.08", "size = 0", "t.toml:6: size must be from 0.001 to 100 m, not 0"},
        {"size = 0.08", "size = nan", "t.toml:6: size must be a finite number"},
        {"size = 0.08", "size = \"big\"", "t.toml:6: size must be a finite number"},
        {"size = 0.08\n", "", "t.toml:4: a tag has no key size"},
        {"0.1, -0.2, 1", "0.1, -0.2", "t.toml:7: position must be a list of 3"},
        {"0.1, -0.2, 1", "0.1, -0.2, inf", "t.toml:7: position must be a finite number"},
        {"0.5, 0.5, -0.5, 0.5", "0.5, 0.5, -0.5, 0.6",
         "t.toml:8: the quaternion must have length 1"},
        {"0.5, 0.5, -0.5, 0.5", "0, 0, 0, 0", "t.toml:8: the quaternion must have length 1"},
        {"family = \"tag16h5\"\n", "", "t.toml:11: tag 3 of family tag36h11 occurs twice"},
        {"family = \"tag16h5\"", "family = \"tag\"", "t.toml:12: family must be one of"},
        {"family = \"tag16h5\"", "family = \"tag16h5", "t.toml:12: the closing quote of a text"},
        {"family = \"tag36h11\"\n", "",
         "t.toml:3: neither this tag nor the file has the key \"family\""},
        {"# a comment", "units = \"mm\"", "t.toml:1: unknown key units"},
    };
    for (const auto& [from, to, message] : cases) {
        const std::string text = replaced(kGood, from, to);
        const std::string said = refusal([&] { (void)tagMapFromToml(text, "t.toml"); });
        EXPECT_EQ(said.substr(0, message.size()), message) << said;
        EXPECT_EQ(said.find('\n'), std::string::npos);
    }
    for (const char* empty : {"", "family = \"tag36h11\"", "tags = []", "tags = 3", "tags = [3]"})
        EXPECT_EQ(refusal([&] { (void)tagMapFromToml(empty, "t.toml"); }).substr(0, 6), "t.toml");
}

TEST(TagMap, ReadsAnAprilTagRosBundleAndTurnsItsTagFrame) {
    const TagMap map = tagMapFromRosYaml(kBundle, "tags.yaml");
    ASSERT_EQ(map.tags().size(), 2U);
    const MappedTag* tag = map.find({TagFamily::Tag36h11, 2});
    ASSERT_NE(tag, nullptr);
    // The bottom left corner is at (-, +) if y points down (mfar) and at (-, -) if y points up
    // (apriltag_ros).
    const Eigen::Vector3d corner = tag->T_world_tag * Eigen::Vector3d(-0.025, 0.025, 0);
    EXPECT_TRUE(corner.isApprox(Eigen::Vector3d(0.1 - 0.025, 0.2 - 0.025, 0)));
    EXPECT_EQ(map.find({TagFamily::Tag36h11, 9}), nullptr);
}

TEST(TagMap, ASingleStandaloneTagIsTheOriginOfTheWorld) {
    const TagMap map =
        tagMapFromRosYaml("standalone_tags: [{id: 4, size: 0.3}]", "t.yaml", TagFamily::Tag25h9);
    const MappedTag* tag = map.find({TagFamily::Tag25h9, 4});
    ASSERT_NE(tag, nullptr);
    EXPECT_EQ(tag->size, 0.3);
    EXPECT_EQ(tag->T_world_tag.translation, Eigen::Vector3d(0, 0, 0));
}

TEST(TagMap, BrokenBundlesAreRefusedWithFileAndLine) {
    const std::vector<std::tuple<std::string, std::string, std::string>> cases{
        {"id: 2", "id: 1", "t.yaml:7: tag 1 of family tag36h11 occurs twice"},
        {"id: 2", "id: 9", "t.yaml:7: tag 9 of family tag36h11 occurs twice"},
        {"id: 2", "id: two", "t.yaml:7: id must be a whole number"},
        {"id: 2", "id: 2, id: 3", "t.yaml:7: id occurs twice"},
        {"id: 2,", "", "t.yaml:7: a tag has no key id"},
        {"id: 2", "idd: 2", "t.yaml:7: unknown key idd"},
        {"size: 0.2", "size: -0.2", "t.yaml:2: size must be from 0.001"},
        {"x: 0.1", "x: .nan", "t.yaml:7: x must be a finite number"},
        {"x: 0.1", "qw: 0.1", "t.yaml:7: the quaternion must have length 1"},
        {"layout:", "tags:", "t.yaml:5: unknown key tags"},
        {"tag_bundles:", "bundles:", "t.yaml:3: unknown key bundles"},
        {"x: 0.1, y: 0.2}", "x: [", "t.yaml:"},
        {"  - name: desk", "  - name: a\n  - name: desk", "t.yaml:5: a second bundle"},
    };
    for (const auto& [from, to, message] : cases) {
        const std::string text = replaced(kBundle, from, to);
        const std::string said = refusal([&] { (void)tagMapFromRosYaml(text, "t.yaml"); });
        EXPECT_EQ(said.substr(0, message.size()), message) << said;
        EXPECT_EQ(said.find('\n'), std::string::npos);
    }
    for (const char* text : {"", "3", "[]", "{}", "standalone_tags: []",
                             "standalone_tags: [{id: 1, size: 1}, {id: 2, size: 1}]",
                             "tag_bundles: [{name: a}]", "tag_bundles: 3", "? [a] : b"})
        EXPECT_EQ(refusal([&] { (void)tagMapFromRosYaml(text, "t.yaml"); }).substr(0, 6), "t.yaml")
            << text;
}

TEST(TagMap, DeeplyNestedTextsAreRefusedBeforeTheyAreParsed) {
    std::string dots = "a";
    for (int i = 0; i < 50'000; ++i)
        dots += ".a";
    EXPECT_EQ(refusal([&] { (void)tagMapFromToml(dots + " = 1\n", "t.toml"); }),
              "t.toml:1: a key has more than 32 parts");
    const std::string open(50'000, '[');
    EXPECT_EQ(refusal([&] { (void)tagMapFromToml("a = " + open, "t.toml"); }),
              "t.toml:1: brackets are nested more than 32 levels deep");
    EXPECT_EQ(refusal([&] { (void)tagMapFromRosYaml("a: " + open, "t.yaml"); }),
              "t.yaml:1: the file is nested more than 16 levels deep");
}

TEST(TagMap, TooLargeIntegersAreReportedWithFileAndLine) {
    for (const char* key : {"size", "position", "orientation"}) {
        std::string text = "[[tags]]\nfamily = \"tag36h11\"\nid = 1\nsize = 1\n"
                           "position = [0, 0, 0]\norientation = [1, 0, 0, 0]\n";
        const std::size_t at = text.find_first_of("01", text.find(std::string(key) + " = "));
        text.replace(at, 1, "9007199254740993");
        const std::string said = refusal([&] { (void)tagMapFromToml(text, "t.toml"); });
        const auto line = 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n');
        EXPECT_TRUE(said.starts_with(fmt::format("t.toml:{}: ", line))) << key << ": " << said;
    }
}

TEST(TagMap, TheEndingOfAFileNameSelectsItsFormat) {
    const test::TempFolder folder;
    test::writeFile(folder / "tags.toml", kGood);
    test::writeFile(folder / "tags.yaml", kBundle);
    EXPECT_EQ(loadTagMap(folder / "tags.toml").tags().size(), 2U);
    EXPECT_NE(loadTagMap(folder / "tags.yaml").find({TagFamily::Tag36h11, 1}), nullptr);
    EXPECT_NE(refusal([&] { (void)loadTagMap(folder / "absent.toml"); }).find("is missing"),
              std::string::npos);
    EXPECT_NE(refusal([&] { (void)loadTagMap(folder.path()); }).find("is not a regular file"),
              std::string::npos);
}

}  // namespace
}  // namespace mfar
