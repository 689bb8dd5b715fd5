#include "tests/measure/eval/metrics/complex_fft.h"

#include <fftw3.h>

namespace mfar::eval {
namespace {

fftw_complex* complexOf(cv::Mat& values) {
    return reinterpret_cast<fftw_complex*>(values.ptr<double>());
}

}  // namespace

void FftwPlanDelete::operator()(fftw_plan_s* plan) const {
    fftw_destroy_plan(plan);
}

ComplexFft::ComplexFft(cv::Size size, Direction direction) : size_(size) {
    cv::Mat buffer(size, CV_64FC2);
    plan_.reset(fftw_plan_dft_2d(size.height, size.width, complexOf(buffer), complexOf(buffer),
                                 direction == Direction::Forward ? FFTW_FORWARD : FFTW_BACKWARD,
                                 FFTW_ESTIMATE));
}

void ComplexFft::run(cv::Mat& values) const {
    CV_Assert(values.type() == CV_64FC2 && values.size() == size_ && values.isContinuous());
    fftw_execute_dft(plan_.get(), complexOf(values), complexOf(values));
}

}  // namespace mfar::eval
