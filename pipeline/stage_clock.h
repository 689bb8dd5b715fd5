#pragma once

#include <chrono>
#include <vector>

namespace mfar {

struct StageTime {
    const char* stage;
    double ms;
};

class StageClock {
public:
    StageClock() { times_.reserve(kMostStages); }

    void start() {
        times_.clear();
        last_ = Clock::now();
    }
    /// Ends a stage that began with the last call of start() or lap(), and begins the next one.
    void lap(const char* stage) {
        const auto now = Clock::now();
        times_.push_back({stage, std::chrono::duration<double, std::milli>(now - last_).count()});
        last_ = now;
    }
    [[nodiscard]] const std::vector<StageTime>& times() const { return times_; }

    bool measures = false;  ///< true if each stage waits until its work is done

private:
    using Clock = std::chrono::steady_clock;
    // The constructor allocates memory for this number of stages, so that frames allocate none.
    static constexpr std::size_t kMostStages = 12;

    std::vector<StageTime> times_;
    Clock::time_point last_;
};

}  // namespace mfar
