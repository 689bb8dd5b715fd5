#include "daemon/gpu_watch.h"

#include "daemon/gpu_failures.h"

namespace mfar {
namespace {

// Largest number of unfinished pictures on the GPU. A screen into whose memory the GPU draws has
// the same number of buffers.
constexpr std::size_t kMostInWork = 3;
constexpr const char* kLate = "the GPU does not finish a picture";

}  // namespace

bool GpuWatch::isReady() {
    if (!context_) return true;
    requireSound();
    while (!inWork_.empty() && inWork_.front().fence.passed())
        inWork_.pop_front();
    isLate_ = isOldestDue() && !inWork_.front().fence.passed(gpu::kLongestGpuWait);
    if (isLate_ && !context_->isSoftware()) throw GpuLost(kLate);
    return !isLate_;
}

bool GpuWatch::isOldestDue() const {
    return inWork_.size() >= kMostInWork ||
           (!inWork_.empty() && Timestamp::now() - inWork_.front().since > gpu::kLongestGpuWait);
}

void GpuWatch::requireSound() const {
    if (!context_) return;
    if (const auto fault = context_->takeFault()) throw GpuLost(*fault);
}

void GpuWatch::drawn() {
    requireSound();
    if (context_) inWork_.push_back({gpu::Fence(), Timestamp::now()});
}

// A lost GPU may cause exceptions of any type. So the type of `error` does not show whether the GPU
// was lost, and the context is asked as well.
std::optional<std::string> GpuWatch::lossBehind(const std::exception& error) const {
    if (!context_) return std::nullopt;
    if (const auto* lost = dynamic_cast<const GpuLost*>(&error)) return lost->what();
    if (auto fault = context_->takeFault()) return fault;
    if (const auto* ofGl = dynamic_cast<const gpu::GlError*>(&error)) return ofGl->what();
    return std::nullopt;
}

std::optional<std::string> GpuWatch::fault() const {
    if (!isLate_) return std::nullopt;
    return kLate;
}

}  // namespace mfar
