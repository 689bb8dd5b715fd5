#include "tests/demo/demo_pictures.h"

#include "tests/demo/picture_layout.h"
#include "tests/measure/eval/metrics/luma.h"
#include "tests/measure/eval/metrics/psnr.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <array>

namespace mfar::demo {
namespace {

const std::array<cv::Scalar, kTileClasses> kClassColours{
    cv::Scalar(170, 170, 170), cv::Scalar(200, 130, 60), cv::Scalar(100, 180, 80),
    cv::Scalar(60, 170, 240)};

cv::Rect mostDetailed(const Shown& shown, cv::Size window) {
    cv::Mat lacking, energy;
    cv::subtract(eval::luma(shown.truth), eval::luma(shown.enlarged), lacking);
    cv::boxFilter(lacking.mul(lacking), energy, CV_64F, window);
    const cv::Rect centres(window.width / 2 + 1, window.height / 2 + 1,
                           shown.truth.cols - window.width - 2,
                           shown.truth.rows - window.height - 2);
    cv::Point best;
    cv::minMaxLoc(energy(centres), nullptr, nullptr, nullptr, &best);
    return {best, window};
}

std::string withPsnr(const char* what, const cv::Mat& picture, const cv::Mat& truth) {
    return fmt::format("{}: {:.1f} dB", what, eval::psnr(eval::luma(picture), eval::luma(truth)));
}

cv::Mat classColours(const Shown& shown) {
    const int columns = tilesOf(shown.video).width;
    cv::Mat colours(shown.video.height, shown.video.width, CV_8UC3);
    for (std::size_t i = 0; i < shown.classes.size(); ++i) {
        const int x = static_cast<int>(i) % columns * kTileSize;
        const int y = static_cast<int>(i) / columns * kTileSize;
        cv::rectangle(colours, cv::Rect(x, y, kTileSize, kTileSize),
                      kClassColours[static_cast<std::size_t>(shown.classes[i])], cv::FILLED);
    }
    return colours;
}

}  // namespace

std::string_view name(TileClass tileClass) {
    switch (tileClass) {
    case TileClass::Unchanged: return "unchanged";
    case TileClass::Enlarged: return "enlarged";
    case TileClass::Trusted: return "trusted";
    case TileClass::Blended: return "blended";
    }
    return "unknown";
}

cv::Mat comparisonPicture(const Shown& shown) {
    const std::array<Column, 3> columns{
        Column{withPsnr("Enlarged video", shown.enlarged, shown.truth), shown.enlarged},
        Column{withPsnr("mfar", shown.result, shown.truth), shown.result},
        Column{"Truth", shown.truth}};
    return columnsWithDetail(columns, mostDetailed(shown, detailSize(shown.truth.size())));
}

cv::Mat confidencePicture(const Shown& shown) {
    const cv::Mat values(shown.video.height, shown.video.width, CV_32F,
                         const_cast<float*>(shown.confidence.data()));
    cv::Mat levels, map, scale, canvas;
    values.convertTo(levels, CV_8U, 255);
    cv::applyColorMap(levels, map, cv::COLORMAP_VIRIDIS);
    cv::Mat ramp(kMargin, 256, CV_8U);
    for (int x = 0; x < ramp.cols; ++x)
        ramp.col(x).setTo(x);
    cv::applyColorMap(ramp, scale, cv::COLORMAP_VIRIDIS);
    map = resized(map, map.size() * 2, cv::INTER_NEAREST);
    canvas = sheet({map.cols + 2 * kMargin, map.rows + kCaption + 2 * kMargin});
    write(canvas, "Confidence", {kMargin, kMargin + 18});
    const int right = canvas.cols - kMargin - 24;
    place(canvas, scale, {right - scale.cols, kMargin});
    write(canvas, "0", {right - scale.cols - 24, kMargin + 18});
    write(canvas, "1", {right + 10, kMargin + 18});
    place(canvas, map, {kMargin, kMargin + kCaption});
    return canvas;
}

cv::Mat tileClassPicture(const Shown& shown) {
    cv::Mat colours = classColours(shown), gray, mixed;
    const cv::Size size = colours.size() * 2;
    cv::cvtColor(resized(shown.result, size, cv::INTER_AREA), gray, cv::COLOR_BGR2GRAY);
    cv::cvtColor(gray, gray, cv::COLOR_GRAY2BGR);
    cv::addWeighted(gray, 0.5, resized(colours, size, cv::INTER_NEAREST), 0.5, 0, mixed);
    cv::Mat canvas = sheet({size.width + 2 * kMargin, size.height + kCaption + 2 * kMargin});
    int x = kMargin;
    for (std::size_t i = 0; i < kTileClasses; ++i) {
        cv::rectangle(canvas, cv::Rect(x, kMargin, kMargin, kMargin), kClassColours[i], cv::FILLED);
        write(canvas, std::string(name(static_cast<TileClass>(i))),
              {x + kMargin + 10, kMargin + 18});
        x += 190;
    }
    place(canvas, mixed, {kMargin, kMargin + kCaption});
    return canvas;
}

}  // namespace mfar::demo
