#include "tests/measure/eval/picture.h"

#include "hal/virtual/image_files.h"

#include <opencv2/imgproc.hpp>

namespace mfar::eval {

cv::Mat loadPicture(const std::filesystem::path& file) {
    const StoredImage image = loadImage(file);
    return fromRgba(image.pixels, image.size);
}

void savePicture(const std::filesystem::path& file, const cv::Mat& picture) {
    const cv::Mat rgba = toRgba(picture);
    savePng(file, viewOf(rgba));
}

cv::Mat toRgba(const cv::Mat& bgr) {
    cv::Mat out;
    cv::cvtColor(bgr, out, cv::COLOR_BGR2RGBA);
    return out;
}

ImageView viewOf(const cv::Mat& picture) {
    CV_Assert(picture.type() == CV_8UC4 || picture.type() == CV_8UC1);
    return {picture.data,
            {picture.cols, picture.rows},
            picture.step,
            picture.channels() == 1 ? PixelFormat::Gray8 : PixelFormat::Rgba8};
}

cv::Mat fromRgba(const std::vector<std::uint8_t>& rgba, Size size) {
    cv::Mat rgbaView(size.height, size.width, CV_8UC4, const_cast<std::uint8_t*>(rgba.data()));
    cv::Mat out;
    cv::cvtColor(rgbaView, out, cv::COLOR_RGBA2BGR);
    return out;
}

}  // namespace mfar::eval
