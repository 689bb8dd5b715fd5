#include "tests/measure/eval/dnn_peer.h"
#include "tests/measure/eval/report.h"

namespace mfar::eval {

std::function<cv::Mat(const cv::Mat&)> dnnEnlarger(const std::filesystem::path& file,
                                                   Size /*output*/) {
    (void)dnnModelNamed(file);
    throw EvalError("--dnn-model: this program was built without OpenCV's dnn_superres "
                    "(Debian: libopencv-contrib-dev)");
}

}  // namespace mfar::eval
