#pragma once

#include "tests/faults/plan.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace mfar::faults {

/// Compares mfard's own reports with the actual state. Each violated rule is a line of the report.
/// Its functions are called by one thread at a time, see Scheduler.
class Judge {
public:
    /// The judge of the process; writes to the file that MFAR_FAULTS_REPORT names.
    static Judge& get();

    // The actual state.
    void begins(const Fault& fault);
    void ends(const Fault& fault);
    /// The screen shows a picture that was taken at this time.
    void shows(Ns taken);

    // mfard's actions and reports.
    void serviceHears(std::string_view text);
    void logSays(std::string_view text);
    void status(const nlohmann::ordered_json& said, Ns asked);
    void answersNot(const std::string& why, Ns asked);
    void terminated();  ///< mfard has got SIGTERM
    void ended(int code, bool inTime);
    /// Counters of refused frames, checked while there is no fault.
    void stats(const nlohmann::ordered_json& said);
    /// Checks that a finished recording can be read.
    void recording(const std::string& folder);
    /// Checks memory, descriptors and threads while there is no fault, relative to the first call.
    /// False when there are more: an answer in progress may end soon.
    [[nodiscard]] bool holdsNoMore(std::uint64_t moreBytes = 8U << 20U);

    void note(const std::string& text);
    void fail(const std::string& text);
    void count(const std::string& what, std::uint64_t number);

    [[nodiscard]] bool isReady() const { return ready_.has_value(); }
    [[nodiscard]] bool isEnding() const { return terminated_.has_value(); }
    [[nodiscard]] std::uint64_t frames() const { return frames_; }

private:
    /// `since`: when faults of this kind last changed.
    struct Calm {
        int active = 0;
        Ns since = 0;
        void add(int by, Ns now) {
            active += by;
            since = now;
        }
        [[nodiscard]] bool lasts(Ns time, Ns now) const {
            return active == 0 && now - since > time;
        }
    };
    enum Watched { All, Video, VideoDevice, Still, Screen, Slow, Gpu, Drawing, WatchedCount };

    Judge();
    [[nodiscard]] Ns age(Ns now) const;
    [[nodiscard]] Ns missing(Ns now) const;
    [[nodiscard]] Ns unfinished(Watched gpu, Ns now) const;
    void judgeState(const nlohmann::ordered_json& said, Ns asked);
    void judgeBlame(const std::string& fault, Ns asked);
    void fed();
    void change(const Fault& fault, int by);

    int report_ = 2;
    std::array<Calm, WatchedCount> calm_{};
    std::optional<Ns> ready_, terminated_, shown_, fed_;
    std::optional<Ns>
        hangs_;  ///< begin of a hang of the video driver, while the camera has no other fault
    std::uint64_t frames_ = 0, asked_ = 0, meals_ = 0, failures_ = 0;
    std::map<std::string, Ns> logged_;
    std::uint64_t logBytes_ = 0;
    bool hadGpuFaults_ = false, isGpuGivenUp_ = false;
    struct Held {
        std::multiset<std::string> files;  ///< files of all descriptors
        std::uint64_t threads = 0, bytes = 0;
    };
    std::optional<Held> first_;
};

}  // namespace mfar::faults
