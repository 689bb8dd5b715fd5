#include "daemon/gpu_failures.h"

#include <fmt/format.h>

#include <utility>

namespace mfar {

bool GpuFailures::add(Timestamp now, std::string why) {
    forgetOld(now);
    times_.push_back(now);
    why_ = std::move(why);
    if (!givenUp_ && times_.size() >= kMost) givenUp_ = now;
    return givenUp_.has_value();
}

void GpuFailures::forgetOld(Timestamp now) {
    while (!times_.empty() && now - times_.front() > kWindow)
        times_.pop_front();
}

std::optional<std::string> GpuFailures::fault(Timestamp now) {
    if (givenUp_)
        return fmt::format("the GPU failed {} times within a minute, so the CPU draws now ({})",
                           kMost, why_);
    forgetOld(now);
    if (times_.empty()) return std::nullopt;
    return fmt::format("the GPU failed and was restarted ({})", why_);
}

std::optional<std::string> GpuFailures::banner(Timestamp now) {
    if (!givenUp_ || now - *givenUp_ > kWindow) return std::nullopt;
    return fault(now);
}

}  // namespace mfar
