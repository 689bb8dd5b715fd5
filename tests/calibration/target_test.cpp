#include "base/calibration/calibration_error.h"
#include "daemon/tools/calibrate/coverage.h"
#include "daemon/tools/calibrate/target_finder.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <string>

namespace mfar::test {
namespace {

using namespace calibration;

constexpr Size kPicture{640, 480};
constexpr const char* kGridText = "target_type: 'aprilgrid' #gridtype\ntagCols: 6\ntagRows: 5\n"
                                  "tagSize: 0.088 #m\ntagSpacing: 0.3\n";

TEST(Target, KalibrsDescriptionIsRead) {
    const TempFolder folder;
    writeFile(folder / "grid.yaml", kGridText);
    const Target grid = readAprilGrid(folder / "grid.yaml");
    ASSERT_EQ(grid.points.size(), 120U);
    // Tag 7 is the second tag of the second row from below. Its third corner is the upper right.
    const double expected = 0.088 * 1.3 + 0.088;
    EXPECT_TRUE(grid.points[30].isApprox(Eigen::Vector3d(expected, expected, 0), 1e-12));
}

TEST(Target, ImpossibleDescriptionsAreRefusedWithTheFileAndTheLineIfKnown) {
    struct Fault {
        const char *from, *to, *where, *what;
    };
    constexpr Fault kFaults[] = {
        {"'aprilgrid'", "'circlegrid'", ":1: ", "'circlegrid' is not supported"},
        {"tagCols: 6", "tagCols: 6.5", ":2: ", "whole number"},
        {"tagCols: 6", "tagCols: 0", ":2: ", "whole number"},
        {"tagCols: 6\ntagRows: 5", "tagCols: 2\ntagRows: 1", ": ", "at least 3 tags"},
        {"tagRows: 5", "tagCos: 5", ": ", "has no key tagRows"},
        {"0.088", "-0.088", ":4: ", "is not between"},
        {"0.088", ".nan", ":4: ", "not finite"},
        {"0.3", "much", ":5: ", "is not a number"},
    };
    for (const Fault& fault : kFaults) {
        const TempFolder folder;
        writeFile(folder / "grid.yaml", kGridText);
        replaceInFile(folder / "grid.yaml", fault.from, fault.to);
        try {
            static_cast<void>(readAprilGrid(folder / "grid.yaml"));
            FAIL() << "accepted: " << fault.to;
        } catch (const CalibrationError& e) {
            const std::string said = e.what();
            EXPECT_TRUE(said.starts_with((folder / "grid.yaml").string() + fault.where)) << said;
            EXPECT_NE(said.find(fault.what), std::string::npos) << said;
        }
    }
}

TEST(Target, CheckerboardsThatLookTheSameUpsideDownAreRefused) {
    EXPECT_EQ(checkerboard("9x6", 0.025).points.size(), 54U);
    for (const char* const words : {"8x6", "9x7", "9", "x", "9x", "9x6x2", "-9x6", "999x6", "a"})
        EXPECT_THROW((void)checkerboard(words, 0.025), std::runtime_error) << words;
    EXPECT_THROW((void)checkerboard("9x6", -1), std::runtime_error);
    EXPECT_THROW((void)checkerboard("9x6", std::nan("")), std::runtime_error);
}

/// A simulated photograph of a print. `pixelOfTarget`: homography from metres on the target to
/// pixels. The print is drawn four times too large and then reduced, so that edges have grey levels
/// as in a sensor.
struct Scene {
    cv::Mat1b picture;
    cv::Matx33d pixelOfTarget;
};

/// Photographs a paper with `texels` texels per metre. The target's origin is at texel `origin`.
/// The target's y axis points upwards if `upwards` is true. `turn`: rotation of the paper in the
/// picture [rad].
Scene photograph(const cv::Mat1b& paper, double texels, cv::Point2d origin, bool upwards,
                 double turn) {
    const cv::Matx33d texelOfTarget{texels,   0, origin.x, 0, upwards ? -texels : texels,
                                    origin.y, 0, 0,        1};
    // Whole numbers are edges of texels in `origin`, but centres of texels in warpPerspective().
    const cv::Matx33d middle{1, 0, -0.5, 0, 1, -0.5, 0, 0, 1};
    const double c = std::cos(turn), s = std::sin(turn), w = paper.cols / 2., h = paper.rows / 2.;
    const double scale = 430. / paper.rows;
    const cv::Matx33d centred{1, 0, -w, 0, 1, -h, 0, 0, 1};
    const cv::Matx33d tilt{c * scale,    -s * scale,   0, s * scale * 0.9, c * scale, 0,
                           2e-4 * scale, 3e-4 * scale, 1};
    const cv::Matx33d place{1, 0, 318.3, 0, 1, 241.7, 0, 0, 1};
    const cv::Matx33d pixelOfTexel = place * tilt * centred;
    constexpr double kFine = 4;
    // Pixel p of the picture covers the pixels 4 p to 4 p + 3 of the large drawing.
    const cv::Matx33d fine{kFine, 0, kFine / 2 - 0.5, 0, kFine, kFine / 2 - 0.5, 0, 0, 1};
    cv::Mat1b large;
    cv::warpPerspective(paper, large, fine * pixelOfTexel,
                        cv::Size(640, 480) * static_cast<int>(kFine), cv::INTER_LINEAR,
                        cv::BORDER_CONSTANT, 200);
    Scene out;
    cv::resize(large, out.picture, {640, 480}, 0, 0, cv::INTER_AREA);
    cv::GaussianBlur(out.picture, out.picture, {}, 0.6);
    out.pixelOfTarget = pixelOfTexel * middle * texelOfTarget;
    return out;
}

void expectCorners(const Target& target, const Scene& scene, const std::vector<Corner>& corners,
                   std::size_t least) {
    EXPECT_GE(corners.size(), least);
    double sum = 0;
    Eigen::Vector2d bias = Eigen::Vector2d::Zero();
    for (const Corner& c : corners) {
        const Eigen::Vector3d& p = target.points[c.index];
        const cv::Vec3d q = scene.pixelOfTarget * cv::Vec3d(p.x(), p.y(), 1);
        const Eigen::Vector2d error = c.pixel - Eigen::Vector2d(q[0], q[1]) / q[2];
        EXPECT_LT(error.norm(), 0.3) << "corner " << c.index;
        sum += error.squaredNorm();
        bias += error / static_cast<double>(corners.size());
    }
    EXPECT_LT(std::sqrt(sum / static_cast<double>(corners.size())), 0.08);
    EXPECT_LT(bias.norm(), 0.03);
}

/// A grid as Kalibr prints it, with cells of `cell` x `cell` texels. Each tag is rotated by `turn`
/// quarter turns and has a border of `border` cells (1 or 2).
cv::Mat1b printedGrid(const Target& grid, int cell, int turn, int border) {
    const int tagCells = 6 + 2 * border;
    const int gap = static_cast<int>(std::lround(tagCells * grid.spacing));
    const int pitch = tagCells + gap;
    const int width = grid.columns * pitch + gap, height = grid.rows * pitch + gap;
    cv::Mat1b cells(height + 2, width + 2, 255);
    for (int row = 0; row <= grid.rows; ++row)
        for (int column = 0; column <= grid.columns; ++column)
            cells(cv::Rect(1 + column * pitch, 1 + row * pitch, gap, gap)) = 0;
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            const int id = (grid.rows - 1 - row) * grid.columns + column + grid.firstId;
            const TagPicture tag = drawTag({TagFamily::Tag36h11, id});
            cv::Mat1b whole(tag.size, tag.size, const_cast<unsigned char*>(tag.cells.data()));
            cv::Mat1b inner(tagCells, tagCells, std::uint8_t{0});
            whole(cv::Rect(tag.corner + 1, tag.corner + 1, 6, 6))
                .copyTo(inner(cv::Rect(border, border, 6, 6)));
            for (int i = 0; i < turn; ++i)
                cv::rotate(inner, inner, cv::ROTATE_90_CLOCKWISE);
            inner.copyTo(cells(
                cv::Rect(1 + gap + column * pitch, 1 + gap + row * pitch, tagCells, tagCells)));
        }
    }
    cv::Mat1b paper;
    cv::resize(cells, paper, {}, cell, cell, cv::INTER_NEAREST);
    return paper;
}

Scene photographOfGrid(const Target& grid, int printTurn, int border, double turn) {
    constexpr int kCell = 20;
    const int tagCells = 6 + 2 * border;
    const cv::Mat1b paper = printedGrid(grid, kCell, printTurn, border);
    // The paper begins with a white rim of one cell and a row of black squares. So the first corner
    // of a tag has this distance from the paper's left and lower edges.
    const double first = (1 + tagCells * grid.spacing) * kCell;
    return photograph(paper, kCell * tagCells / 0.08, {first, paper.rows - first}, true, turn);
}

void expectGridFound(int turn, int border) {
    const Target grid = aprilGrid(5, 4, 0.08, border == 1 ? 0.25 : 0.3, 3);
    const Scene scene = photographOfGrid(grid, turn, border, 0.3);
    TargetFinder finder(grid, kPicture);
    const auto corners =
        finder.find({scene.picture.ptr(), kPicture, scene.picture.step, PixelFormat::Gray8});
    expectCorners(grid, scene, corners, 64);
}

TEST(TargetFinder, AprilGridCornersAreFoundForAnyRotationOfItsTags) {
    for (const int turn : {0, 1, 2, 3})
        expectGridFound(turn, 1);
}

TEST(TargetFinder, TagsWithKalibrsWideBordersAreFound) {
    expectGridFound(2, 2);
}

TEST(TargetFinder, CheckerboardCornersKeepTheirOrderUpsideDown) {
    const Target board = checkerboard(9, 6, 0.025);
    constexpr int kSquare = 100;
    cv::Mat1b paper(9 * kSquare, 12 * kSquare, 255);
    for (int row = 0; row < 7; ++row)
        for (int column = 0; column < 10; ++column)
            if ((row + column) % 2 == 0)
                paper(cv::Rect((column + 1) * kSquare, (row + 1) * kSquare, kSquare, kSquare)) = 20;
    const cv::Point2d origin(2. * kSquare, 2. * kSquare);
    for (const double turn : {0.2, 0.2 + M_PI}) {
        const Scene scene = photograph(paper, kSquare / 0.025, origin, false, turn);
        TargetFinder finder(board, kPicture);
        const auto corners =
            finder.find({scene.picture.ptr(), kPicture, scene.picture.step, PixelFormat::Gray8});
        expectCorners(board, scene, corners, 54);
    }
}

TEST(TargetFinder, CornersOfTagsCutByThePicturesEdgeLieInsideThePicture) {
    const Target grid = aprilGrid(5, 4, 0.08, 0.25);
    const Scene scene = photographOfGrid(grid, 0, 1, 0.3);
    TargetFinder finder(grid, kPicture);
    std::size_t most = 0;
    for (int left = 100; left <= 220; ++left) {
        const Size size{kPicture.width - left, kPicture.height};
        const cv::Mat1b cut = scene.picture(cv::Rect(left, 0, size.width, size.height)).clone();
        const auto corners = finder.find({cut.ptr(), size, cut.step, PixelFormat::Gray8});
        most = std::max(most, corners.size());
        for (const Corner& c : corners)
            EXPECT_TRUE(c.pixel.x() > 0 && c.pixel.x() < size.width - 1) << left;
    }
    EXPECT_GE(most, 32U);
}

TEST(TargetFinder, UniformPicturesGiveNoCorners) {
    const cv::Mat1b grey(480, 640, 128);
    const Target grid = aprilGrid(6, 6, 0.064, 0.25), board = checkerboard(9, 6, 0.025);
    for (const Target* target : {&grid, &board}) {
        TargetFinder finder(*target, kPicture);
        EXPECT_TRUE(finder.find({grey.ptr(), kPicture, grey.step, PixelFormat::Gray8}).empty());
    }
}

TEST(Coverage, CountsCoveredCellsAndReportsTheEmptyPartOfThePicture) {
    Coverage coverage(kPicture);
    EXPECT_EQ(coverage.share(), 0);
    std::vector<Corner> corners;
    for (int y = 0; y < 480; y += 10)
        for (int x = 0; x < 640; x += 10)
            if (x < 430 || y < 320) corners.push_back({0, {1. * x, 1. * y}});
    coverage.add(corners);
    EXPECT_EQ(coverage.emptiest(), "the bottom right");
    EXPECT_NEAR(coverage.share(), 1 - 5. * 4 / (16 * 12), 0.03);
    EXPECT_EQ(coverage.map().size(), 12U);
    EXPECT_EQ(coverage.map()[11].back(), ' ');
    EXPECT_NE(coverage.map()[0].front(), ' ');
}

}  // namespace
}  // namespace mfar::test
