#include "tests/demo/occlusion_pictures.h"

#include "tests/demo/picture_layout.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace mfar::demo {
namespace {

constexpr double kMostError = 0.05;  // relative depth error at the upper end of the colour scale
const cv::Scalar kUnknown(120, 120, 120);

struct Range {
    double far, near;
};

// Range of the inverse depths without the farthest and nearest 1 % of the pixels.
Range rangeOf(const cv::Mat& inverseDepth) {
    std::vector<float> values;
    for (const float value : cv::Mat_<float>(inverseDepth))
        if (value > 0) values.push_back(value);
    std::sort(values.begin(), values.end());
    return {values[values.size() / 100], values[values.size() - 1 - values.size() / 100]};
}

/// Maps `shares` from 0 to 1 to colours from blue to red (OpenCV's Turbo). Pixels with `known` = 0
/// become grey.
cv::Mat colours(const cv::Mat& shares, const cv::Mat& known) {
    cv::Mat levels, out;
    shares.convertTo(levels, CV_8U, 255);
    cv::applyColorMap(levels, out, cv::COLORMAP_TURBO);
    out.setTo(kUnknown, known == 0);
    return out;
}

cv::Mat depthColours(const cv::Mat& inverseDepth, const Range& range) {
    return colours((inverseDepth - range.far) / (range.near - range.far), inverseDepth > 0);
}

cv::Mat errorColours(const cv::Mat& inverseDepth, const cv::Mat& truth) {
    const cv::Mat known = (inverseDepth > 0) & (truth > 0);
    return colours(cv::abs(truth / inverseDepth - 1) / kMostError, known);
}

void addScale(cv::Mat& canvas, cv::Point corner, const std::string& from, const std::string& to) {
    constexpr int kLabel = 90;
    cv::Mat ramp(kMargin, 256, CV_32F);
    for (int x = 0; x < ramp.cols; ++x)
        ramp.col(x).setTo(x / 255.0);
    write(canvas, from, {corner.x, corner.y + 18});
    place(canvas, colours(ramp, ramp >= 0), {corner.x + kLabel, corner.y});
    write(canvas, to, {corner.x + kLabel + ramp.cols + 12, corner.y + 18});
}

/// Returns a window of detailSize() in which much of the virtual object is hidden and much is
/// visible: the window with the largest min(number of hidden pixels, number of visible pixels).
cv::Rect mostHidden(const OcclusionShown& shown) {
    const cv::Size window = detailSize(shown.composite.size());
    cv::Mat hidden, visible, both;
    cv::boxFilter(shown.hidden, hidden, CV_32F, window);
    cv::boxFilter(shown.visible, visible, CV_32F, window);
    cv::min(hidden, visible, both);
    const cv::Rect centres(window.width / 2 + 1, window.height / 2 + 1,
                           both.cols - window.width - 2, both.rows - window.height - 2);
    cv::Point best;
    cv::minMaxLoc(both(centres), nullptr, nullptr, nullptr, &best);
    return {best, window};
}

}  // namespace

cv::Mat depthPicture(const OcclusionRun& run) {
    const OcclusionShown& shown = run.last;
    const Range range = rangeOf(shown.trueDepth);
    const OcclusionQuality& q = run.quality;
    const std::array<Column, 3> columns{
        Column{fmt::format("mfar: {:.0f} % known, AbsRel {:.2f} %", 100 * q.completeness,
                           100 * q.absrel),
               depthColours(shown.depth, range)},
        Column{"Truth", depthColours(shown.trueDepth, range)},
        Column{"Error", errorColours(shown.depth, shown.trueDepth)}};
    const cv::Size panel = shown.depth.size();
    cv::Mat canvas = sheet({3 * panel.width + 4 * kMargin, 2 * kCaption + panel.height + kMargin});
    int x = kMargin;
    const int below = kMargin + kCaption - 12 + panel.height + 12;
    for (const Column& column : columns) {
        write(canvas, column.title, {x, kMargin + 16});
        place(canvas, column.picture, {x, kMargin + kCaption - 12});
        if (&column != &columns.back())
            addScale(canvas, {x, below}, fmt::format("{:.2f} m", 1 / range.far),
                     fmt::format("{:.2f} m", 1 / range.near));
        else
            addScale(canvas, {x, below}, "0 %",
                     fmt::format("{:.0f} % of the depth", 100 * kMostError));
        x += panel.width + kMargin;
    }
    return canvas;
}

cv::Mat occlusionPicture(const OcclusionRun& run) {
    const std::array<Column, 3> columns{
        Column{"Object drawn over everything", run.last.overlaid},
        Column{fmt::format("mfar: IoU {:.3f}, boundary {:.2f} px", run.quality.overlap,
                           run.quality.boundary),
               run.last.composite},
        Column{"Truth", run.last.trueComposite}};
    return columnsWithDetail(columns, mostHidden(run.last));
}

}  // namespace mfar::demo
