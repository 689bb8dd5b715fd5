#pragma once

#include <memory>

struct fftw_plan_s;

namespace mfar::eval {

struct FftwPlanDelete {
    void operator()(fftw_plan_s* plan) const;
};
/// A plan of FFTW for a transform. FFTW makes plans on one thread at a time; any thread may execute
/// them.
using FftwPlan = std::unique_ptr<fftw_plan_s, FftwPlanDelete>;

}  // namespace mfar::eval
