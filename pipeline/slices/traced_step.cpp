#include "pipeline/slices/traced_step.h"

namespace mfar {
namespace {

// While the next picture is traced, the camera may return towards the view of the shown picture.
// The next picture is discarded if the change of the view falls below kBack times the change that
// started it.
constexpr double kBack = 0.5;

}  // namespace

TracedStep nextStep(std::optional<double> sinceShown, std::optional<double> sinceNext,
                    double renewed) {
    if (!sinceNext)
        return sinceShown && *sinceShown < renewed ? TracedStep::Refine : TracedStep::Start;
    // The first picture is finished even if the camera moves away.
    if (!sinceShown) return TracedStep::Continue;
    if (*sinceShown < kBack * renewed) return TracedStep::Drop;
    return *sinceNext >= 1 && *sinceNext > *sinceShown ? TracedStep::Start : TracedStep::Continue;
}

}  // namespace mfar
