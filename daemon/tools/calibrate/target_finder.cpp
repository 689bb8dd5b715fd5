#include "daemon/tools/calibrate/target_finder.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mfar::calibration {
namespace {

constexpr int kLeastWindow = 2;
constexpr int kLargestWindow = 11;
constexpr int kLargeWidth = 1000;  // [px]; from this width on, pictures are searched at half size
constexpr int kLeastTags = 3;      // fewer tags do not show the orientation of the print

cv::Mat matOf(const ImageView& luma) {
    return {luma.size.height, luma.size.width, CV_8UC1, const_cast<std::uint8_t*>(luma.data),
            luma.stride};
}

DetectorOptions detectorOptions(Size picture, int borderCells) {
    DetectorOptions out;
    out.borderCells = borderCells;
    out.decimation = picture.width >= kLargeWidth ? 2 : 1;
    out.maxHamming = 0;
    out.refine = true;
    return out;
}

double shortestEdge(const TagDetection& tag) {
    double out = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 4; ++k)
        out = std::min(out, (tag.corners[k] - tag.corners[(k + 1) % 4]).norm());
    return out;
}

/// Returns half the side of the window in which a tag's corner is refined [px]. Besides white
/// paper, the window contains only parts of the tag's black border and of the black square that an
/// AprilGrid has at each tag corner, in the gap between the tags. The square is as wide as the gap;
/// the border is at least an eighth of the tag's edge wide. The factor 0.9 allows for slanted
/// edges.
int windowFor(const TagDetection& tag, const Target& target) {
    const double clear = shortestEdge(tag) * std::min(1. / 8, target.spacing);
    return std::min(kLargestWindow, static_cast<int>(0.9 * clear));
}

void refine(const cv::Mat& picture, std::vector<cv::Point2f>& points, int window) {
    cv::cornerSubPix(picture, points, {window, window}, {-1, -1},
                     {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 40, 0.001});
}

/// Returns the target's four corners at a detected tag. Corner k of the printed tag is corner (k +
/// turn) % 4 of the detected tag.
std::vector<Corner> cornersOf(const TagDetection& tag, int slot, int turn) {
    std::vector<Corner> out;
    for (int k = 0; k < 4; ++k)
        out.push_back({4 * slot + k, tag.corners[(k + turn) % 4]});
    return out;
}

/// Returns the mean error [px] of a homography from the target's plane to the corners.
double planeError(const Target& target, const std::vector<Corner>& corners) {
    std::vector<cv::Point2d> on, seen;
    for (const Corner& c : corners) {
        on.emplace_back(target.points[c.index].x(), target.points[c.index].y());
        seen.emplace_back(c.pixel.x(), c.pixel.y());
    }
    const cv::Mat H = cv::findHomography(on, seen);
    if (H.empty()) return std::numeric_limits<double>::infinity();
    std::vector<cv::Point2d> expected;
    cv::perspectiveTransform(on, expected, H);
    double sum = 0;
    for (std::size_t i = 0; i < seen.size(); ++i)
        sum += cv::norm(expected[i] - seen[i]);
    return sum / static_cast<double>(seen.size());
}

/// Refines the corners. Keeps a corner if it moved by less than `reach` [px] and its refinement
/// window is inside the picture.
void keepRefined(const cv::Mat& picture, std::vector<Corner>& corners, int window, double reach) {
    const cv::Rect inside(window + 2, window + 2, picture.cols - 2 * window - 4,
                          picture.rows - 2 * window - 4);
    // OpenCV 4.10 refuses corners outside the picture. A tag at the picture's edge may have some.
    std::erase_if(corners, [&](const Corner& c) {
        return !inside.contains(cv::Point2d(c.pixel.x(), c.pixel.y()));
    });
    if (corners.empty()) return;
    std::vector<cv::Point2f> points;
    for (const Corner& c : corners)
        points.emplace_back(static_cast<float>(c.pixel.x()), static_cast<float>(c.pixel.y()));
    refine(picture, points, window);
    std::vector<Corner> kept;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector2d p{points[i].x, points[i].y};
        if (!inside.contains(points[i]) || !((p - corners[i].pixel).norm() < reach)) continue;
        kept.push_back({corners[i].index, p});
    }
    corners = kept;
}

int squareLevel(const cv::Mat& picture, const std::vector<cv::Point2f>& c, int at, int columns) {
    const cv::Point2f middle = 0.25F * (c[at] + c[at + 1] + c[at + columns] + c[at + columns + 1]);
    return picture.at<std::uint8_t>(cv::Point(middle));
}

}  // namespace

TargetFinder::TargetFinder(const Target& target, Size picture)
    : target_(target), detectors_{TagDetector(detectorOptions(picture, 1)),
                                  TagDetector(detectorOptions(picture, 2))} {}

int TargetFinder::leastTags() const {
    return std::min(kLeastTags, target_.columns * target_.rows);
}

std::vector<Corner> TargetFinder::find(const ImageView& luma) {
    return target_.kind == TargetKind::AprilGrid ? findTags(luma) : findBoard(luma);
}

// Finds the orientation of the printed tags. Kalibr and other programs print tags turned by a
// multiple of 90 degrees, compared with the AprilTag library. Only with the right one of the four
// orientations do the corners of all tags fit a plane.
void TargetFinder::learnTurn(const std::vector<TagDetection>& tags) {
    double least = std::numeric_limits<double>::infinity();
    for (int turn = 0; turn < 4; ++turn) {
        std::vector<Corner> corners;
        for (const TagDetection& tag : tags)
            for (const Corner& c : cornersOf(tag, tag.tag.id - target_.firstId, turn))
                corners.push_back(c);
        const double error = planeError(target_, corners);
        if (!(error < least)) continue;
        least = error;
        turn_ = turn;
    }
}

// Detects tags in a copy of the picture whose black areas are thinner by one pixel, or by three in
// a large picture. Otherwise, black squares that meet at a corner may join the whole grid into one
// shape, in which no tag is found. In a clean print, the thinner areas gave 19 of 20 tags instead
// of 5. The corners are measured in the original picture.
std::vector<TagDetection> TargetFinder::detect(const cv::Mat& picture) {
    const int side = picture.cols >= kLargeWidth ? 4 : 2;
    cv::dilate(picture, thinned_, cv::Mat::ones(side, side, CV_8U));
    const ImageView view{
        thinned_.ptr(), {thinned_.cols, thinned_.rows}, thinned_.step, PixelFormat::Gray8};
    std::vector<TagDetection> tags;
    for (int border = 0; border < 2; ++border) {
        if (border_ >= 0 && border != border_) continue;
        std::vector<TagDetection> found = detectors_[border].detect(view);
        if (found.size() > tags.size()) tags = std::move(found);
        if (border_ < 0 && static_cast<int>(tags.size()) >= leastTags()) border_ = border;
    }
    // The dilation's kernel has an even size and shifts the picture by half a pixel.
    for (TagDetection& tag : tags)
        for (Eigen::Vector2d& corner : tag.corners)
            corner.array() -= 0.5;
    return tags;
}

std::vector<Corner> TargetFinder::findTags(const ImageView& luma) {
    const cv::Mat picture = matOf(luma);
    std::vector<TagDetection> tags = detect(picture);
    std::erase_if(tags, [&](const TagDetection& tag) {
        const int slot = tag.tag.id - target_.firstId;
        return slot < 0 || slot >= target_.columns * target_.rows ||
               windowFor(tag, target_) < kLeastWindow;
    });
    if (turn_ < 0 && static_cast<int>(tags.size()) >= leastTags()) learnTurn(tags);
    if (turn_ < 0) return {};
    const double reach = luma.size.width >= kLargeWidth ? 4 : 2.5;
    std::vector<Corner> out;
    for (const TagDetection& tag : tags) {
        std::vector<Corner> corners = cornersOf(tag, tag.tag.id - target_.firstId, turn_);
        keepRefined(picture, corners, windowFor(tag, target_), reach);
        out.insert(out.end(), corners.begin(), corners.end());
    }
    return out;
}

std::vector<Corner> TargetFinder::findBoard(const ImageView& luma) const {
    const cv::Mat picture = matOf(luma);
    std::vector<cv::Point2f> points;
    const int columns = target_.columns;
    const int flags =
        cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK;
    if (!cv::findChessboardCorners(picture, {columns, target_.rows}, points, flags)) return {};
    float edge = std::numeric_limits<float>::infinity();
    for (std::size_t i = 1; i < points.size(); ++i)
        edge = std::min(edge, static_cast<float>(cv::norm(points[i] - points[i - 1])));
    const int window = std::clamp(static_cast<int>(0.45F * edge), kLeastWindow, kLargestWindow);
    refine(picture, points, window);
    // The first square must be dark. Otherwise, OpenCV began at the other end of the checkerboard.
    const int first = squareLevel(picture, points, 0, columns);
    const int second = squareLevel(picture, points, 1, columns);
    if (first > second) std::reverse(points.begin(), points.end());
    std::vector<Corner> out;
    for (std::size_t i = 0; i < points.size(); ++i)
        out.push_back({static_cast<int>(i), {points[i].x, points[i].y}});
    return out;
}

}  // namespace mfar::calibration
