#pragma once

#include <memory>

struct fftw_plan_s;

namespace mfar::eval {

struct FftwPlanDelete {
    void operator()(fftw_plan_s* plan) const;
};
/// A transform that FFTW has thought about. FFTW makes plans on one thread at a time; any may carry
/// them out.
using FftwPlan = std::unique_ptr<fftw_plan_s, FftwPlanDelete>;

}  // namespace mfar::eval
