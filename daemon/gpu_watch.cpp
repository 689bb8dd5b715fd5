#include "daemon/gpu_watch.h"

#include "daemon/exit_code.h"

#include <fmt/format.h>

namespace mfar {
namespace {

// As many as a display has buffers: the processor may be so far ahead.
constexpr std::size_t kMostInWork = 3;

}  // namespace

bool GpuWatch::isReady() {
    if (!context_) return true;
    if (const auto fault = context_->takeFault()) throw Failure(ExitCode::Internal, *fault);
    while (!inWork_.empty() && inWork_.front().fence.passed())
        inWork_.pop_front();
    isLate_ = isOldestDue() && !inWork_.front().fence.passed(gpu::kLongestGpuWait);
    if (!isLate_) return true;
    const auto since = Timestamp::now() - inWork_.front().since;
    if (since > kGivenUp && !context_->isSoftware())
        throw Failure(ExitCode::Internal,
                      fmt::format("the GPU has not finished a picture for {:.1f} s",
                                  std::chrono::duration<double>(since).count()));
    return false;
}

bool GpuWatch::isOldestDue() const {
    return inWork_.size() >= kMostInWork ||
           (!inWork_.empty() && Timestamp::now() - inWork_.front().since > gpu::kLongestGpuWait);
}

void GpuWatch::drawn() {
    if (context_) inWork_.push_back({gpu::Fence(), Timestamp::now()});
}

std::optional<std::string> GpuWatch::fault() const {
    if (!isLate_) return std::nullopt;
    return "the GPU does not finish a picture";
}

}  // namespace mfar
