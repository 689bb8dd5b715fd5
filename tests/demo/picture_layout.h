#pragma once

#include <opencv2/core.hpp>

#include <span>
#include <string>

namespace mfar::demo {

inline constexpr int kMargin = 24;   ///< around and between panels [px]
inline constexpr int kCaption = 44;  ///< height of a line of text above a panel [px]
inline constexpr int kPanelWidth = 640;
inline constexpr int kMagnification = 3;

/// An empty sheet, CV_8UC3.
[[nodiscard]] cv::Mat sheet(cv::Size size);
void write(cv::Mat& canvas, const std::string& text, cv::Point leftBase);
void place(cv::Mat& canvas, const cv::Mat& picture, cv::Point corner);
[[nodiscard]] cv::Mat resized(const cv::Mat& picture, cv::Size size, int how);

/// A picture and the caption above it. B G R; all panels have the same size.
struct Column {
    std::string title;
    cv::Mat picture;
};

/// Size of the part of a picture that fills a panel when it is magnified.
[[nodiscard]] cv::Size detailSize(cv::Size picture);
/// Panels side by side. Below each, the same detail is magnified.
[[nodiscard]] cv::Mat columnsWithDetail(std::span<const Column> columns, const cv::Rect& detail);

}  // namespace mfar::demo
