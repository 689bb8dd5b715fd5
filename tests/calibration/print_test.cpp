// Draws the pages of mfar-print as a printer would, and searches the pictures for the targets.
#include "daemon/tools/calibrate/target_finder.h"
#include "daemon/tools/print/printed_targets.h"
#include "pipeline/track/tag_detector.h"
#include "tests/unit/run_program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <gmock/gmock.h>
#include <sstream>
#include <string>
#include <utility>

namespace mfar::print {
namespace {

using calibration::Corner;
using calibration::Target;

constexpr double kPxPerMm = 5;
constexpr double kPxPerM = 1000 * kPxPerMm;
constexpr double kMargin = 10, kFooter = 17;  // [mm]

/// Draws the black path and the size of a page. Ignores text and ruler.
cv::Mat1b printed(const std::string& svg) {
    double width = 0, height = 0;
    EXPECT_EQ(std::sscanf(svg.c_str(),
                          "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%lfmm\" "
                          "height=\"%lfmm\"",
                          &width, &height),
              2);
    EXPECT_NE(svg.find(fmt::format("viewBox=\"0 0 {} {}\"", width, height)), std::string::npos);
    const auto pixel = [](double mm) { return static_cast<int>(std::lround(kPxPerMm * mm)); };
    cv::Mat1b out(pixel(height), pixel(width), 255);
    std::istringstream lines(svg.substr(svg.find("<path d=\"") + 9));
    for (std::string line; std::getline(lines, line) && line[0] == 'M';) {
        double left = 0, top = 0, right = 0, bottom = 0;
        if (std::sscanf(line.c_str(), "M%lf,%lfH%lfV%lf", &left, &top, &right, &bottom) != 4) {
            ADD_FAILURE() << line;
            break;
        }
        const cv::Rect box(pixel(left), pixel(top), pixel(right) - pixel(left),
                           pixel(bottom) - pixel(top));
        EXPECT_GT(box.area(), 0) << line;
        EXPECT_GE(std::min(left, top), kMargin - 1e-3) << line;
        EXPECT_LE(right, width - kMargin + 1e-3) << line;
        EXPECT_LE(bottom, height - kMargin - kFooter + 1e-3) << line;
        out(box) = 0;
    }
    // A camera never sees sharp steps, and the search for corners is made for its pictures.
    cv::GaussianBlur(out, out, {}, 0.7);
    return out;
}

ImageView viewOf(const cv::Mat1b& picture) {
    return {picture.ptr(), {picture.cols, picture.rows}, picture.step, PixelFormat::Gray8};
}

/// Expects eleven ticks with equal distances, 100 mm in all, below the target.
void expectRuler(const std::string& svg) {
    const std::size_t at = svg.find("<path stroke=");
    ASSERT_NE(at, std::string::npos);
    std::istringstream path(svg.substr(svg.find("d=\"", at) + 3));
    double left = 0, y = 0, length = 0;
    char letter = 0;
    path >> letter >> left >> letter >> y >> letter >> length;
    EXPECT_EQ(length, 100);
    for (int cm = 0; cm <= 10; ++cm) {
        double x = 0, top = 0, height = 0;
        path >> letter >> x >> letter >> top >> letter >> height;
        EXPECT_EQ(letter, 'v');
        EXPECT_NEAR(x, left + 10 * cm, 2e-3);
        EXPECT_NEAR(top + 0.5 * height, y, 2e-3);
    }
    path >> letter;
    EXPECT_EQ(letter, '"') << "a twelfth tick";
}

/// Expects all corners of the target, at the distances that `target` gives [m].
void expectTarget(const std::string& svg, const Target& target) {
    const cv::Mat1b picture = printed(svg);
    expectRuler(svg);
    calibration::TargetFinder finder(target, {picture.cols, picture.rows});
    const std::vector<Corner> corners = finder.find(viewOf(picture));
    ASSERT_EQ(corners.size(), target.points.size());
    // The y axis of an AprilGrid points up.
    const double up = target.kind == calibration::TargetKind::AprilGrid ? -1 : 1;
    const auto onPage = [&](const Corner& c) {
        const Eigen::Vector3d& p = target.points[static_cast<std::size_t>(c.index)];
        return Eigen::Vector2d(kPxPerM * p.x(), up * kPxPerM * p.y());
    };
    const Eigen::Vector2d offset = corners.front().pixel - onPage(corners.front());
    for (const Corner& c : corners)
        EXPECT_LT((c.pixel - onPage(c) - offset).norm(), 1) << "corner " << c.index;
}

TEST(PrintedTags, OfEachFamilyAreFoundWithTheirIdAndSize) {
    for (const TagFamilyInfo& family : kTagFamilies) {
        const std::vector<int> ids{0, family.count - 1, 7};
        const std::string svg = tagPage(family.family, ids, 0.05, paperNamed("a4"));
        const cv::Mat1b picture = printed(svg);
        expectRuler(svg);
        DetectorOptions options;
        options.families = {family.family};
        options.maxHamming = 0;
        const std::vector<TagDetection> tags = TagDetector(options).detect(viewOf(picture));
        std::vector<int> found;
        for (const TagDetection& tag : tags) {
            found.push_back(tag.tag.id);
            EXPECT_NE(svg.find(fmt::format(">tag {}</text>", tag.tag.id)), std::string::npos);
            for (std::size_t k = 0; k < 4; ++k)
                EXPECT_NEAR((tag.corners[k] - tag.corners[(k + 1) % 4]).norm(), 0.05 * kPxPerM, 1)
                    << family.name;
            // Upright: the first two corners are the lower ones.
            EXPECT_GT(tag.corners[0].y(), tag.corners[2].y() + 100) << family.name;
            EXPECT_LT(tag.corners[0].x(), tag.corners[1].x() - 100) << family.name;
        }
        EXPECT_THAT(found, testing::UnorderedElementsAreArray(ids)) << family.name;
    }
}

TEST(PrintedTags, AreOnUprightPaperIfTheyFit) {
    const auto widthOf = [](const std::string& svg) {
        return std::stod(svg.substr(svg.find("width=\"") + 7));
    };
    const Paper& paper = paperNamed("a4");
    EXPECT_EQ(widthOf(tagPage(TagFamily::Tag36h11, std::array{0}, 0.1, paper)), paper.width);
    EXPECT_EQ(widthOf(tagPage(TagFamily::Tag36h11, std::array{0, 1}, 0.1, paper)), paper.height);
}

// The outermost cells of this family are black. Without gaps, both tags would be one shape.
TEST(PrintedTags, HaveGaps) {
    const cv::Mat1b picture =
        printed(tagPage(TagFamily::TagStandard41h12, std::array{0, 1}, 0.01, paperNamed("a4")));
    cv::Mat1b whole;
    const cv::Mat1b black = picture < 128;
    cv::morphologyEx(black, whole, cv::MORPH_CLOSE, cv::Mat::ones(21, 21, CV_8U));
    cv::Mat labels;
    EXPECT_EQ(cv::connectedComponents(whole, labels), 3) << "background and two tags";
}

TEST(PrintedTags, HaveNumbersThatDoNotOverlap) {
    const std::string svg = tagPage(TagFamily::Tag36h11, std::array{0, 1}, 0.005, paperNamed("a4"));
    const auto middleOf = [&](int id) {
        const std::size_t end = svg.find(fmt::format(">tag {}</text>", id));
        return std::stod(svg.substr(svg.rfind("x=\"", end) + 3));
    };
    EXPECT_GE(middleOf(1) - middleOf(0), 15);
}

TEST(PrintedAprilGrid, HasAllCornersAtTheirDistances) {
    for (const Paper& paper : kPapers) {
        const double size = largestTag(4, 6, 0.3, paper);
        EXPECT_GT(size, 0.025) << paper.name;
        const Target grid = calibration::aprilGrid(4, 6, size, 0.3);
        expectTarget(gridPage(grid, paper), grid);
        EXPECT_THROW((void)gridPage(calibration::aprilGrid(4, 6, size + 0.001, 0.3), paper),
                     std::runtime_error)
            << paper.name;
    }
}

TEST(PrintedCheckerboard, HasAllCornersAtTheirDistances) {
    for (const Paper& paper : kPapers) {
        const double square = largestSquare(9, 6, paper);
        EXPECT_GT(square, 0.02) << paper.name;
        const Target board = calibration::checkerboard(9, 6, square);
        expectTarget(boardPage(board, paper), board);
        EXPECT_THROW((void)boardPage(calibration::checkerboard(9, 6, square + 0.001), paper),
                     std::runtime_error)
            << paper.name;
    }
}

class MfarPrint : public testing::Test {
protected:
    [[nodiscard]] test::Outcome run(const std::string& arguments) const {
        return test::execute(folder_, fmt::format("{} {}", MFAR_PRINT, arguments));
    }
    [[nodiscard]] std::string file(const char* name) const { return (folder_ / name).string(); }

    const test::TempFolder folder_;
};

TEST_F(MfarPrint, WritesAGridAndItsDescription) {
    const test::Outcome ran = run("aprilgrid --columns 5 --rows 4 --out " + file("grid.svg"));
    ASSERT_EQ(ran.status, 0) << ran.text;
    const Target grid = calibration::readAprilGrid(file("grid.yaml"));
    EXPECT_EQ(grid.columns, 5);
    EXPECT_EQ(grid.rows, 4);
    expectTarget(test::readFile(file("grid.svg")), grid);
    EXPECT_EQ(run("aprilgrid --out " + file("grid.svg")).status, 0) << "replaces its own files";
    EXPECT_EQ(calibration::readAprilGrid(file("grid.yaml")).rows, 8);
}

TEST_F(MfarPrint, DoesNotReplaceADescriptionOfAnythingElse) {
    test::writeFile(file("rig.yaml"), "cam0: 1\n");
    const test::Outcome ran = run("aprilgrid --out " + file("rig.svg"));
    EXPECT_EQ(ran.status, 1);
    EXPECT_NE(ran.text.find("rig.yaml is not the description of an AprilGrid"), std::string::npos)
        << ran.text;
    EXPECT_EQ(test::readFile(file("rig.yaml")), "cam0: 1\n");
    EXPECT_FALSE(std::filesystem::exists(file("rig.svg")));
    std::filesystem::create_directory(file("grid.yaml"));
    EXPECT_EQ(run("aprilgrid --out " + file("grid.svg")).status, 1);
    EXPECT_FALSE(std::filesystem::exists(file("grid.svg")));
}

TEST_F(MfarPrint, WritesTagsAndACheckerboard) {
    ASSERT_EQ(
        run("tags 0 1 --family tag25h9 --size 0.06 --paper A4 --out " + file("tags.svg")).status,
        0);
    DetectorOptions options;
    options.families = {TagFamily::Tag25h9};
    TagDetector detector(options);
    EXPECT_EQ(detector.detect(viewOf(printed(test::readFile(file("tags.svg"))))).size(), 2U);
    const test::Outcome board = run("checkerboard 7x4 --paper letter --out " + file("board.svg"));
    ASSERT_EQ(board.status, 0) << board.text;
    const std::string name = "--checkerboard 7x4 --square ";
    const std::size_t at = board.text.find(name);
    ASSERT_NE(at, std::string::npos) << board.text;
    expectTarget(test::readFile(file("board.svg")),
                 calibration::checkerboard("7x4", std::stod(board.text.substr(at + name.size()))));
}

TEST_F(MfarPrint, RefusesWhatCannotBePrintedAndWritesNothing) {
    const std::string out = " --out " + file("page.svg");
    const std::pair<std::string, const char*> wrong[] = {
        {"", "a command is missing; expected one of tags, aprilgrid, checkerboard"},
        {"tags" + out, "id is required"},
        {"tags 0", "--out is required"},
        {"tags -1" + out, "Value -1 not in range"},
        {"tags 010" + out, "010: ids are written without leading zeros"},
        {"tags 0 --family tag99" + out, "tag99"},
        {"tags 0 --size nan" + out, "--size"},
        {"tags 0 --paper a9" + out, "a9"},
        {"tags 0 --out " + file("page.png"), "must end with .svg"},
        {"tags 0 --out " + file("none/page.svg"), "its folder does not exist"},
        {"aprilgrid --columns 0" + out, "--columns"},
        {"aprilgrid --spacing nan" + out, "--spacing"},
        {"checkerboard --square inf" + out, "--square"},
    };
    for (const auto& [arguments, message] : wrong) {
        const test::Outcome ran = run(arguments);
        EXPECT_EQ(ran.status, 64) << arguments;
        EXPECT_NE(ran.text.find(message), std::string::npos) << ran.text;
    }
    const std::pair<std::string, const char*> impossible[] = {
        {"tags 587" + out, "family tag36h11 has the tags 0 to 586, but not 587"},
        {"tags 0 --size 0.3" + out, "a tag of 0.3 m with the cells around it does not fit on A4"},
        {"tags 0 1 2 --size 0.1" + out, "3 tags of 0.1 m do not fit on A4, only 2"},
        {"aprilgrid --size 0.1" + out,
         "6 x 8 tags with an edge of 0.1 m does not fit on A4; in whole mm, at most 0.023 m fit"},
        {"aprilgrid --columns 2 --rows 1" + out, "an AprilGrid needs at least 3 tags"},
        {"aprilgrid --columns 30 --rows 30" + out, "has 900 tags, but its family has only 587"},
        {"checkerboard 8x6" + out, "looks the same upside down"},
        {"checkerboard 9" + out, "expected the numbers of inner corners"},
        {"checkerboard 9x6 --square 0.1" + out, "in whole mm, at most 0.024 m fit"},
    };
    for (const auto& [arguments, message] : impossible) {
        const test::Outcome ran = run(arguments);
        EXPECT_EQ(ran.status, 1) << arguments;
        EXPECT_EQ(ran.text.find("mfar-print: "), 0U) << ran.text;
        EXPECT_NE(ran.text.find(message), std::string::npos) << ran.text;
    }
    for (const char* name : {"page.svg", "page.yaml", "page.png"})
        EXPECT_FALSE(std::filesystem::exists(file(name))) << name;
}

}  // namespace
}  // namespace mfar::print
