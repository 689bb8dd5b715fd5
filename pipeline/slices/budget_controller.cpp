#include "pipeline/slices/budget_controller.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace mfar {
namespace {

// Number of samples in the first portion of work, when the time per sample is still unknown. It is
// small, so that the portion takes little time in any scene.
constexpr std::int64_t kFirstSamples = 64;
// Least number of samples in a portion; fewer are not worth a call of the path tracer. If they take
// longer than the rest of the budget, the next frame repays the excess.
constexpr std::int64_t kLeastSamples = 16;
constexpr double kPortionsPerFrame = 16;
// Upper limit of unused time carried over to the next frame, as a share of the budget. Time remains
// unused if the threads get too little processor time.
constexpr double kMostSaved = 0.08;
// Work reported to spentElsewhere() may exceed the budget of a frame. The excess becomes a debt of
// at most kMostDebt budgets. A frame with waiting work repays kRepaid times the budget, or kRepaid
// times the debt if the debt is larger. A frame without waiting work repays up to the whole budget.
constexpr double kMostDebt = 10, kRepaid = 0.08;

double valid(double ms) {
    return std::isfinite(ms) && ms > 0 ? ms : 0;
}

}  // namespace

BudgetController::BudgetController(double msPerFrame)
    : budget_(msPerFrame), allowed_(msPerFrame), balance_(msPerFrame) {
    if (!(std::isfinite(msPerFrame) && msPerFrame > 0))
        throw std::invalid_argument(
            "path tracer: the time budget per frame must be finite and above 0 ms");
}

void BudgetController::beginFrame(bool workWaits, double extraMs) {
    const auto share = static_cast<float>(used_ / allowed_);
    if (workWaits) waited_[framesWaited_++ % kFrames] = share;
    if (workWaits && (usedUp_ || share > 1)) shares_[frames_++ % kFrames] = share;
    const double most = workWaits ? kMostSaved * budget_ : 0;
    const double repaid = repayment(workWaits);
    allowed_ = budget_ + valid(extraMs);
    balance_ = allowed_ - repaid + std::clamp(balance_, -kMostDebt * budget_, most);
    debt_ = std::min(debt_ - repaid, kMostDebt * budget_);
    used_ = 0;
    usedUp_ = false;
}

double BudgetController::repayment(bool workWaits) const {
    return std::min(debt_, workWaits ? kRepaid * std::max(budget_, debt_) : budget_);
}

BudgetGrant BudgetController::grant() {
    const double left = balance_ - reserved_;
    if (!(left > 0)) {
        usedUp_ = true;
        return {};
    }
    BudgetGrant out{kFirstSamples, 0};
    if (msPerSample_ > 0) {
        const double ms = std::min(left, portionMs());
        out.samples = static_cast<std::int64_t>(std::min(ms / msPerSample_, 1e9));
        out.samples = std::max(out.samples, kLeastSamples);
    }
    out.reservedMs = static_cast<double>(out.samples) * msPerSample_;
    reserved_ += out.reservedMs;
    return out;
}

BudgetGrant BudgetController::grant(double expectedMs) {
    if (!(balance_ - reserved_ > 0)) {
        usedUp_ = true;
        return {};
    }
    reserved_ += valid(expectedMs);
    return {1, valid(expectedMs)};
}

double BudgetController::portionMs() const {
    return budget_ / kPortionsPerFrame;
}

void BudgetController::spent(const BudgetGrant& grant, std::int64_t samples, double ms) {
    reserved_ = std::max(0.0, reserved_ - grant.reservedMs);
    used_ += valid(ms);
    balance_ -= valid(ms);
    if (samples > 0 && valid(ms) > 0) learn(ms / static_cast<double>(samples));
}

void BudgetController::spentElsewhere(double ms) {
    const double left = std::clamp(balance_ - reserved_, 0.0, valid(ms));
    used_ += valid(ms);
    balance_ -= left;
    debt_ += valid(ms) - left;
}

void BudgetController::learn(double msPerSample) {
    costs_[learned_++ % kCosts] = msPerSample;
    std::array<double, kCosts> sorted = costs_;
    const std::size_t known = std::min(learned_, kCosts);
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(known / 2);
    std::nth_element(sorted.begin(), middle, sorted.begin() + static_cast<std::ptrdiff_t>(known));
    msPerSample_ = *middle;
}

BudgetKept BudgetController::kept() const {
    BudgetKept out;
    const std::size_t all = std::min<std::size_t>(framesWaited_, kFrames);
    if (all == 0) return out;
    const auto last = waited_.begin() + static_cast<std::ptrdiff_t>(all);
    out.mean = std::accumulate(waited_.begin(), last, 0.0) / static_cast<double>(all);
    const std::size_t known = std::min<std::size_t>(frames_, kFrames);
    if (known == 0) return out;
    std::array<float, kFrames> off{};
    for (std::size_t i = 0; i < known; ++i)
        off[i] = std::abs(shares_[i] - 1);
    const auto end = off.begin() + static_cast<std::ptrdiff_t>(known);
    const auto p95 = off.begin() + static_cast<std::ptrdiff_t>(known * 95 / 100);
    std::nth_element(off.begin(), p95, end);
    out.frames = static_cast<int>(known);
    out.deviation = static_cast<double>(*p95);
    return out;
}

}  // namespace mfar
