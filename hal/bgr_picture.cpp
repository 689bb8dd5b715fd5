#include "hal/bgr_picture.h"

#include "base/image_layout.h"

#include <opencv2/imgproc.hpp>

#include <vector>

namespace mfar {
namespace {

cv::Mat matOf(const PlaneView& plane, Size size, int type) {
    return {size.height, size.width, type, const_cast<std::uint8_t*>(plane.data), plane.stride};
}

cv::Mat channelOf(const cv::Mat& picture, int channel) {
    cv::Mat out;
    cv::extractChannel(picture, out, channel);
    return out;
}

std::vector<cv::Mat> planesOf(const ImageView& picture) {
    const PlaneView first{picture.data, picture.stride};
    const Size size = picture.size, half{size.width / 2, size.height / 2};
    if (picture.format == PixelFormat::Yuyv) {
        const cv::Mat pairs = matOf(first, {half.width, size.height}, CV_8UC4);
        return {channelOf(matOf(first, size, CV_8UC2), 0), channelOf(pairs, 1),
                channelOf(pairs, 3)};
    }
    const cv::Mat luma = matOf(first, size, CV_8UC1);
    if (picture.format == PixelFormat::Nv12) {
        const cv::Mat pairs = matOf(picture.chroma[0], half, CV_8UC2);
        return {luma, channelOf(pairs, 0), channelOf(pairs, 1)};
    }
    return {luma, matOf(picture.chroma[0], half, CV_8UC1), matOf(picture.chroma[1], half, CV_8UC1)};
}

cv::Mat bgrOfYuv(const ImageView& picture) {
    std::vector<cv::Mat> planes = planesOf(picture);
    for (std::size_t i = 1; i < planes.size(); ++i)
        cv::resize(planes[i], planes[i], planes[0].size(), 0, 0, cv::INTER_LINEAR);
    cv::Mat out;
    cv::merge(planes, out);
    const YuvToRgb rgb = yuvToRgb(picture.matrix, picture.range);
    cv::Matx34f rows;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j)
            rows(i, j) = rgb[2 - static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    cv::transform(out, out, rows);
    return out;
}

}  // namespace

cv::Mat bgrPicture(const ImageView& picture) {
    const PlaneView first{picture.data, picture.stride};
    cv::Mat out;
    switch (picture.format) {
    case PixelFormat::Gray8: return matOf(first, picture.size, CV_8UC1);
    case PixelFormat::Rgba8:
        cv::cvtColor(matOf(first, picture.size, CV_8UC4), out, cv::COLOR_RGBA2BGR);
        return out;
    case PixelFormat::Bgra8:
        cv::cvtColor(matOf(first, picture.size, CV_8UC4), out, cv::COLOR_BGRA2BGR);
        return out;
    case PixelFormat::Yuyv:
    case PixelFormat::Nv12:
    case PixelFormat::Yuv420: break;
    }
    return bgrOfYuv(picture);
}

}  // namespace mfar
