#include "tests/measure/eval/metrics/luma.h"

#include <stdexcept>

namespace mfar::eval {

cv::Mat luma(const cv::Mat& picture) {
    cv::Mat out;
    if (picture.type() == CV_8UC1) {
        picture.convertTo(out, CV_64F);
    } else if (picture.type() == CV_8UC3) {
        cv::Mat wide;
        picture.convertTo(wide, CV_64F);
        cv::transform(wide, out, cv::Matx13d(0.114, 0.587, 0.299));
    } else {
        throw std::invalid_argument("luma: picture must have 8 bits and one or three channels");
    }
    return out;
}

}  // namespace mfar::eval
