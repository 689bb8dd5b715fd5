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

/// Compares what mfard reports with the facts. The report gets a line for each violated rule. Only
/// one thread at a time calls this, see Scheduler.
class Judge {
public:
    /// The judge of this process. It writes to the file that MFAR_FAULTS_REPORT names.
    static Judge& get();

    // Facts that the surroundings report.
    void begins(const Fault& fault);
    void ends(const Fault& fault);
    /// The screen shows a picture that was taken at this time.
    void shows(Ns taken);

    // What mfard does and says.
    void serviceHears(std::string_view text);
    void logSays(std::string_view text);
    void status(const nlohmann::ordered_json& said, Ns asked);
    void answersNot(const std::string& why, Ns asked);
    void terminated();  ///< mfard got the request to end
    void ended(int code, bool inTime);
    /// Called without faults: compares the counts of invalid pictures in `stats` with those that
    /// the cameras sent.
    void stats(const nlohmann::ordered_json& said);
    /// Checks that a finished recording can be read.
    void recording(const std::string& folder);
    /// Checks memory, descriptors and threads while there are no faults. The first call sets the
    /// reference. Returns false if the process holds more; the caller may try again, because
    /// requests in progress may end soon.
    [[nodiscard]] bool holdsNoMore(std::uint64_t moreBytes = 8U << 20U);

    void note(const std::string& text);
    void fail(const std::string& text);
    void count(const std::string& what, std::uint64_t number);

    [[nodiscard]] bool isReady() const { return ready_.has_value(); }
    [[nodiscard]] bool isEnding() const { return terminated_.has_value(); }
    [[nodiscard]] std::uint64_t frames() const { return frames_; }

private:
    /// Time since the last fault of a kind ended.
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
    std::optional<Ns> hangs_;  ///< since when the video driver hangs, if the camera worked before
    std::uint64_t frames_ = 0, asked_ = 0, meals_ = 0, failures_ = 0;
    std::map<std::string, Ns> logged_;
    std::uint64_t logBytes_ = 0;
    bool hadGpuFaults_ = false, isGpuGivenUp_ = false;
    struct Held {
        std::multiset<std::string> files;  ///< files that open descriptors refer to
        std::uint64_t threads = 0, bytes = 0;
    };
    std::optional<Held> first_;
};

}  // namespace mfar::faults
