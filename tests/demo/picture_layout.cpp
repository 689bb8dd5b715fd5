#include "tests/demo/picture_layout.h"

#include <opencv2/imgproc.hpp>

namespace mfar::demo {
namespace {

const cv::Scalar kPaper(250, 250, 250);
const cv::Scalar kInk(40, 40, 40);
const cv::Scalar kFrame(60, 160, 255);

cv::Size panelOf(cv::Size picture) {
    return {kPanelWidth, kPanelWidth * picture.height / picture.width};
}

}  // namespace

cv::Mat sheet(cv::Size size) {
    return {size, CV_8UC3, kPaper};
}

void write(cv::Mat& canvas, const std::string& text, cv::Point leftBase) {
    cv::putText(canvas, text, leftBase, cv::FONT_HERSHEY_SIMPLEX, 0.7, kInk, 1, cv::LINE_AA);
}

void place(cv::Mat& canvas, const cv::Mat& picture, cv::Point corner) {
    picture.copyTo(canvas(cv::Rect(corner, picture.size())));
}

cv::Mat resized(const cv::Mat& picture, cv::Size size, int how) {
    cv::Mat out;
    cv::resize(picture, out, size, 0, 0, how);
    return out;
}

cv::Size detailSize(cv::Size picture) {
    const cv::Size panel = panelOf(picture);
    return {panel.width / kMagnification, panel.height / kMagnification};
}

cv::Mat columnsWithDetail(std::span<const Column> columns, const cv::Rect& detail) {
    const cv::Size whole = columns.front().picture.size(), panel = panelOf(whole);
    const double toPanel = static_cast<double>(panel.width) / whole.width;
    const cv::Rect mark(cv::Point(detail.tl() * toPanel), cv::Point(detail.br() * toPanel));
    const int count = static_cast<int>(columns.size());
    cv::Mat canvas = sheet(
        {count * panel.width + (count + 1) * kMargin, kCaption + 2 * panel.height + 3 * kMargin});
    int x = kMargin;
    for (const Column& column : columns) {
        write(canvas, column.title, {x, kMargin + 16});
        cv::Mat shown = resized(column.picture, panel, cv::INTER_AREA);
        cv::rectangle(shown, mark, kFrame, 2, cv::LINE_AA);
        place(canvas, shown, {x, kMargin + kCaption - 12});
        place(canvas, resized(column.picture(detail), panel, cv::INTER_NEAREST),
              {x, kMargin + kCaption - 12 + panel.height + kMargin});
        x += panel.width + kMargin;
    }
    return canvas;
}

}  // namespace mfar::demo
