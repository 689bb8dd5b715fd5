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

/// Compares mfard's reports with the facts. Adds a line to its own report for each of the first 20
/// violations of a rule. Only one thread at a time calls it, see Scheduler.
class Judge {
public:
    /// The only judge of the process. It writes to the file MFAR_FAULTS_REPORT.
    static Judge& get();

    void begins(const Fault& fault);
    void ends(const Fault& fault);
    /// To be called when the screen shows a picture that was exposed at `taken`.
    void shows(Ns taken);

    void serviceHears(std::string_view text);
    void logSays(std::string_view text);
    void status(const nlohmann::ordered_json& said, Ns asked);
    void answersNot(const std::string& why, Ns asked);
    void terminated();
    void ended(int code, bool inTime);
    /// To be called while there are no faults. Compares the counts of invalid pictures in `said`
    /// with those that the cameras sent.
    void stats(const nlohmann::ordered_json& said);
    void recording(const std::string& folder);
    /// Checks memory, descriptors and threads while there are no faults. Returns false if the
    /// process uses more of them than at the first call; for memory, `moreBytes` more are allowed.
    /// The caller can then retry, because requests in progress may still use some of them.
    [[nodiscard]] bool holdsNoMore(std::uint64_t moreBytes = 8U << 20U);

    void note(const std::string& text);
    void fail(const std::string& text);
    void count(const std::string& what, std::uint64_t number);

    [[nodiscard]] bool isReady() const { return ready_.has_value(); }
    [[nodiscard]] bool isEnding() const { return terminated_.has_value(); }
    [[nodiscard]] std::uint64_t frames() const { return frames_; }

private:
    /// Number of active faults of one group (see Watched). `since`: time of the last change of this
    /// number, or time of the service's READY if that is later.
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
    void judgeWatchdog(Ns at);
    void fed();
    void change(const Fault& fault, int by);

    int report_ = 2;
    std::array<Calm, WatchedCount> calm_{};
    std::optional<Ns> ready_, terminated_, shown_, fed_;
    std::optional<Ns> hangs_;  ///< start of a hang of the video driver
    std::uint64_t frames_ = 0, asked_ = 0, meals_ = 0, failures_ = 0;
    std::map<std::string, Ns> logged_;
    std::uint64_t logBytes_ = 0;
    bool hadGpuFaults_ = false, isGpuGivenUp_ = false;
    struct Held {
        std::multiset<std::string> files;  ///< names of the files of open descriptors
        std::uint64_t threads = 0, bytes = 0;
    };
    std::optional<Held> first_;
};

}  // namespace mfar::faults
