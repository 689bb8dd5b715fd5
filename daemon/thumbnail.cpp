#include "daemon/thumbnail.h"

#include "base/image_layout.h"
#include "hal/bgr_picture.h"
#include "hal/image_codec.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace mfar {

std::vector<std::uint8_t> thumbnail(const ImageView& picture) {
    constexpr double kWidth = 640, kHeight = 480;
    constexpr int kQuality = 85;
    requireSound(picture, "picture of the report");
    cv::Mat small = bgrPicture(picture);
    const double scale = std::min({kWidth / small.cols, kHeight / small.rows, 1.0});
    const cv::Size size(std::max(cvRound(small.cols * scale), 1),
                        std::max(cvRound(small.rows * scale), 1));
    if (size != small.size()) cv::resize(small, small, size, 0, 0, cv::INTER_AREA);
    return encodeJpeg(small.ptr(), small.step, {small.cols, small.rows},
                      small.channels() == 1 ? PixelBytes::Grey : PixelBytes::Bgr, kQuality);
}

}  // namespace mfar
