#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar {

/// Permission to trace samples. If `samples` is above 0, it must be returned with
/// BudgetController::spent().
struct BudgetGrant {
    std::int64_t samples = 0;  ///< number of samples; 0: this frame's budget is used up
    double reservedMs = 0;
};

/// Accuracy with which the last frames kept the time budget. `deviation` leaves out two kinds of
/// frames: frames without enough work, and frames that did not use up the budget although work was
/// left. In frames of the second kind, the threads got too little processor time, because their
/// priority is low.
struct BudgetKept {
    int frames = 0;  ///< number of frames that `deviation` counts
    /// Mean of used time / budget. It also counts frames whose threads got too little processor
    /// time.
    double mean = 0;
    double deviation = 0;  ///< 95th percentile of |used / budget - 1|
};

/// Limits the path tracer's work to a time budget per frame [ms].
/// The time per sample is estimated as the median of the last few portions, so that one outlier
/// does not change it. A portion takes about a sixteenth of the budget. The last portion of a frame
/// is smaller, so that it fits, but it has at least 16 samples. An overrun is subtracted from the
/// next frame's budget. Time reported to spentElsewhere() that did not fit into its frame is repaid
/// over many frames.
/// One thread at a time may call this class. It allocates no memory.
class BudgetController {
public:
    static constexpr int kFrames = 300;

    /// Throws std::invalid_argument if the budget is not a finite number above 0.
    explicit BudgetController(double msPerFrame);

    /// Begins a frame. `workWaits` must be true if work was left over in the last frame. If it is
    /// true, kept() counts the last frame, and the last frame's unused time, up to 8 % of the
    /// budget, is added to the new frame. `extraMs` is added to the budget of the new frame alone.
    void beginFrame(bool workWaits, double extraMs = 0);

    [[nodiscard]] BudgetGrant grant();
    /// Returns a grant for work that traces no samples and is expected to take `expectedMs`. In
    /// this grant, `samples` only tells if the work may run: 1, or 0 if this frame's budget is used
    /// up.
    [[nodiscard]] BudgetGrant grant(double expectedMs);
    [[nodiscard]] double portionMs() const;
    /// Reports a granted portion's processor time. Negative and non-finite values count as 0.
    void spent(const BudgetGrant& grant, std::int64_t samples, double ms);
    /// Reports other work that counts in the budget. It does not affect msPerSample().
    void spentElsewhere(double ms);

    [[nodiscard]] double msPerSample() const { return msPerSample_; }
    [[nodiscard]] double msPerFrame() const { return budget_; }
    [[nodiscard]] double used() const { return used_; }
    [[nodiscard]] BudgetKept kept() const;

private:
    void learn(double msPerSample);
    [[nodiscard]] double repayment(bool workWaits) const;

    static constexpr std::size_t kCosts = 9;

    const double budget_;
    double allowed_;  // the budget of the current frame with its extra time [ms]
    double balance_, reserved_ = 0, used_ = 0;
    double debt_ = 0;  // [ms] that later frames repay; not part of balance_
    bool usedUp_ = false;
    double msPerSample_ = 0;
    std::array<double, kCosts> costs_{};
    std::size_t learned_ = 0;
    /// Ring buffers of used time / budget. `shares_` has only the frames that used up the budget.
    /// `waited_` has all frames with waiting work.
    std::array<float, kFrames> shares_{}, waited_{};
    std::size_t frames_ = 0, framesWaited_ = 0;
};

}  // namespace mfar
