#pragma once

#include <memory>

struct fftw_plan_s;

namespace mfar::eval {

struct FftwPlanDelete {
    void operator()(fftw_plan_s* plan) const;
};
/// A plan of FFTW. Only one thread at a time may make plans. Any thread may execute them.
using FftwPlan = std::unique_ptr<fftw_plan_s, FftwPlanDelete>;

}  // namespace mfar::eval
