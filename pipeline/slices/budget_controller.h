#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar {

/// Permission to trace samples. The caller must return it with BudgetController::spent().
struct BudgetGrant {
    std::int64_t samples = 0;  ///< samples to trace; 0: the time budget of this frame is used up
    double reservedMs = 0;
};

/// How exactly the time budget was kept in the last frames. `deviation` counts only frames that had
/// work all the time and used up or exceeded the budget. In other frames the low-priority threads
/// got too little processor time, which is not the controller's fault.
struct BudgetKept {
    int frames = 0;        ///< frames that `deviation` counts; at most BudgetController::kFrames
    double mean = 0;       ///< mean of used time / budget; also counts frames whose threads got too
                           ///< little processor time
    double deviation = 0;  ///< 95th percentile of |used / budget - 1| over the frames that could
                           ///< use up the budget
};

/// Limits the path tracer's work to a number of milliseconds per frame, the budget.
/// The time per sample is estimated as the median over the last few portions of work. A single
/// outlier does not change the estimate, and a lasting change is noticed after a few portions. A
/// portion takes at most a sixteenth of the budget; the last portion of a frame is made smaller to
/// fit. An overrun is subtracted from the next frame's budget. Work that was reported to
/// spentElsewhere() and did not fit into its frame is repaid in small parts over many frames.
/// One thread at a time may call it. It allocates no memory.
class BudgetController {
public:
    static constexpr int kFrames = 300;

    /// Throws std::invalid_argument if the budget is not finite or not above 0.
    explicit BudgetController(double msPerFrame);

    /// Begins a frame. `workWaits` is true if there was more work during the last frame than was
    /// done. Only then a small part of the last frame's unused time is added to the new frame, and
    /// the last frame counts for kept().
    /// `extraMs` is added to the budget of this frame alone.
    void beginFrame(bool workWaits, double extraMs = 0);

    /// Returns a grant for the next portion. Several grants may be outstanding.
    [[nodiscard]] BudgetGrant grant();
    /// Returns a grant for work that traces no samples and is expected to take this time [ms]. Its
    /// `samples` is 1; 0 if the budget of this frame is used up.
    [[nodiscard]] BudgetGrant grant(double expectedMs);
    /// Target duration of a portion [ms]. It is short, so that the last portion of a frame fits.
    [[nodiscard]] double portionMs() const;
    /// Reports the time that a granted portion took. Negative and non-finite values count as 0.
    void spent(const BudgetGrant& grant, std::int64_t samples, double ms);
    /// Reports other work that belongs to the budget. It does not change the estimated time per
    /// sample.
    void spentElsewhere(double ms);

    /// Estimated time per sample [ms]; 0 before the first portion.
    [[nodiscard]] double msPerSample() const { return msPerSample_; }
    [[nodiscard]] double msPerFrame() const { return budget_; }
    /// Time used in the current frame [ms].
    [[nodiscard]] double used() const { return used_; }
    [[nodiscard]] BudgetKept kept() const;

private:
    void learn(double msPerSample);
    /// Part of debt_ that a new frame repays [ms].
    [[nodiscard]] double repayment(bool workWaits) const;

    static constexpr std::size_t kCosts = 9;

    const double budget_;
    double allowed_;  // the budget of the current frame with its extra time [ms]
    double balance_, reserved_ = 0, used_ = 0;  // [ms]
    double debt_ = 0;                           // [ms], still to be repaid; not part of balance_
    bool usedUp_ = false;                       // whether grant() refused work in this frame
    double msPerSample_ = 0;
    std::array<double, kCosts> costs_{};  // ring buffer: time per sample in the last portions [ms]
    std::size_t learned_ = 0;
    /// Ring buffers of (used time / budget). shares_ has the frames that could use up the budget;
    /// waited_ has all frames in which work waited.
    std::array<float, kFrames> shares_{}, waited_{};
    std::size_t frames_ = 0, framesWaited_ = 0;
};

}  // namespace mfar
