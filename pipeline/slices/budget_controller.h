#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar {

/// Permission to trace, to be given back with BudgetController::spent().
struct BudgetGrant {
    std::int64_t samples = 0;  ///< 0: the frame's budget is used up
    double reservedMs = 0;
};

/// How well a budget was kept in the last frames that had work from begin to end and either used it
/// up or more: one that threads of low priority got no processor time for is no fault of it.
struct BudgetKept {
    int frames = 0;        ///< at most BudgetController::kFrames
    double mean = 0;       ///< time used by budget, also of frames that got too little of it
    double deviation = 0;  ///< 95th percentile of |used / budget - 1| of those that could use it up
};

/// Keeps work to a number of milliseconds a frame. It knows the cost of a sample as the median of
/// the last few portions, which no single outlier moves and a lasting change does within a few
/// portions, and hands out portions of at most a sixteenth of the budget, the last of a frame so
/// that it fits. What a frame took too much, the next one has less; other work that a frame had no
/// room for is paid back in small parts by many. One caller at a time; no allocation.
class BudgetController {
public:
    static constexpr int kFrames = 300;

    /// Throws std::invalid_argument unless the budget is finite and above 0.
    explicit BudgetController(double msPerFrame);

    /// A frame begins. `workWaits`: in the one before there was more work than it did; only then a
    /// little of what it left unused is added, and it counts for kept().
    void beginFrame(bool workWaits);

    /// What may be begun now. Several may be out.
    [[nodiscard]] BudgetGrant grant();
    /// The same of work that is expected to take so long.
    [[nodiscard]] BudgetGrant grant(double expectedMs);
    /// What a portion should take, so that a frame's last one still fits [ms].
    [[nodiscard]] double portionMs() const;
    /// A granted portion took so long. Numbers that are not finite or negative count as nothing.
    void spent(const BudgetGrant& grant, std::int64_t samples, double ms);
    /// Other work that belongs to the budget, which does not tell what a sample costs.
    void spentElsewhere(double ms);

    /// 0 before the first portion.
    [[nodiscard]] double msPerSample() const { return msPerSample_; }
    [[nodiscard]] double msPerFrame() const { return budget_; }
    /// In the current frame [ms].
    [[nodiscard]] double used() const { return used_; }
    [[nodiscard]] BudgetKept kept() const;

private:
    void learn(double msPerSample);
    /// Of the debt, in a frame that begins.
    [[nodiscard]] double repayment(bool workWaits) const;

    static constexpr std::size_t kCosts = 9;

    const double budget_;
    double balance_, reserved_ = 0, used_ = 0;  // [ms]
    double debt_ = 0;                           // [ms], not in the balance
    bool usedUp_ = false;                       // work was refused in this frame
    double msPerSample_ = 0;
    std::array<double, kCosts> costs_{};  // of the last portions, a ring
    std::size_t learned_ = 0;
    /// used / budget of the last frames, a ring: of those that could use it up, and in which work
    /// waited.
    std::array<float, kFrames> shares_{}, waited_{};
    std::size_t frames_ = 0, framesWaited_ = 0;
};

}  // namespace mfar
