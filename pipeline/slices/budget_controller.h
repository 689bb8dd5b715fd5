#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar {

/// Permission to trace; return it with BudgetController::spent().
struct BudgetGrant {
    std::int64_t samples = 0;  ///< 0: the frame's budget is used up
    double reservedMs = 0;
};

/// How well the budget was kept in the last frames. Only frames count that had work from begin to
/// end and either used the budget up or exceeded it: if the low-priority threads got no processor
/// time, the controller is not at fault.
struct BudgetKept {
    int frames = 0;        ///< at most BudgetController::kFrames
    double mean = 0;       ///< mean of used time / budget, including frames whose threads got too
                           ///< little processor time
    double deviation = 0;  ///< 95th percentile of |used / budget - 1| over the frames that could
                           ///< use the budget up
};

/// Keeps work to a number of milliseconds per frame. The cost of a sample is estimated as the
/// median of the last few portions: no single outlier moves it, and a lasting change does within a
/// few portions. A portion is at most a sixteenth of the budget; the last one of a frame is cut to
/// fit. An overrun is subtracted from the next frame's budget; other work that did not fit into its
/// frame is repaid in small parts by many frames. One caller at a time; no allocation.
class BudgetController {
public:
    static constexpr int kFrames = 300;

    /// Throws std::invalid_argument unless the budget is finite and above 0.
    explicit BudgetController(double msPerFrame);

    /// Begins a frame. `workWaits`: the last frame had more work than it did. Only then is a little
    /// of the time that it left unused added to this one, and does it count for kept().
    void beginFrame(bool workWaits);

    /// A grant for the next portion. Several may be outstanding.
    [[nodiscard]] BudgetGrant grant();
    /// As grant(), for work with an expected duration.
    [[nodiscard]] BudgetGrant grant(double expectedMs);
    /// Target duration of a portion, short enough for the last one of a frame to fit [ms].
    [[nodiscard]] double portionMs() const;
    /// Reports the time that a granted portion took. Values that are negative or not finite count
    /// as 0.
    void spent(const BudgetGrant& grant, std::int64_t samples, double ms);
    /// Reports other work within the budget; it does not change the estimated cost of a sample.
    void spentElsewhere(double ms);

    /// 0 before the first portion.
    [[nodiscard]] double msPerSample() const { return msPerSample_; }
    [[nodiscard]] double msPerFrame() const { return budget_; }
    /// Time used in the current frame [ms].
    [[nodiscard]] double used() const { return used_; }
    [[nodiscard]] BudgetKept kept() const;

private:
    void learn(double msPerSample);
    /// Part of the debt that a beginning frame repays [ms].
    [[nodiscard]] double repayment(bool workWaits) const;

    static constexpr std::size_t kCosts = 9;

    const double budget_;
    double balance_, reserved_ = 0, used_ = 0;  // [ms]
    double debt_ = 0;                           // [ms], not included in the balance
    bool usedUp_ = false;                       // work was refused in this frame
    double msPerSample_ = 0;
    std::array<double, kCosts> costs_{};  // ring: cost of a sample in the last portions
    std::size_t learned_ = 0;
    /// Rings of used / budget: of the frames that could use the budget up, and of those in which
    /// work waited.
    std::array<float, kFrames> shares_{}, waited_{};
    std::size_t frames_ = 0, framesWaited_ = 0;
};

}  // namespace mfar
