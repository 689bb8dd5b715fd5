#pragma once

#include <opencv2/core.hpp>

#include <span>
#include <string>

namespace mfar::demo {

inline constexpr int kMargin = 24;
inline constexpr int kCaption = 44;
inline constexpr int kPanelWidth = 640;
inline constexpr int kMagnification = 3;

[[nodiscard]] cv::Mat sheet(cv::Size size);
void write(cv::Mat& canvas, const std::string& text, cv::Point leftBase);
void place(cv::Mat& canvas, const cv::Mat& picture, cv::Point corner);
[[nodiscard]] cv::Mat resized(const cv::Mat& picture, cv::Size size, int how);

/// A picture (B G R) with the caption that is written above it.
struct Column {
    std::string title;
    cv::Mat picture;
};

[[nodiscard]] cv::Size detailSize(cv::Size picture);
[[nodiscard]] cv::Mat columnsWithDetail(std::span<const Column> columns, const cv::Rect& detail);

}  // namespace mfar::demo
