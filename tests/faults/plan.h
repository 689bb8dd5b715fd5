#pragma once

#include "tests/faults/scheduler.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mfar::faults {

enum class Where {
    Video,
    Still,
    Line,
    Reader,
    Clients,
    Configuration,
    Wall,
    Disk,
    Descriptors,
    Machine,
    Gpu
};

/// The observable effect of a fault. The judge derives its rules from it.
enum class Effect {
    None,         ///< pictures continue
    StopsDevice,  ///< the camera sends no new picture; this must be reported
    HangsDriver,  ///< like StopsDevice; a thread of mfard hangs too
    Repeats,      ///< a camera sends the same picture again and again
    StopsReader,  ///< the screen does not read
    StopsGpu,     ///< no picture is finished; must be reported, but not as a camera's fault
    HangsGpu,     ///< like StopsGpu; the drawing thread hangs too
    Slows,        ///< everything is slow, so times cannot be judged
};

struct Kind {
    std::string_view name;
    Where where;
    Effect effect;
    std::string_view words;   ///< words for the file of the camera or GPU; a number replaces *
    int least = 0, most = 0;  ///< range of the number that replaces *
};

struct Fault {
    const Kind* kind = nullptr;
    Ns begin = 0, length = 0;  ///< relative to the start of its episode
    int number = 0;
    [[nodiscard]] std::string text() const;
};

/// One fault, or two that overlap, followed by time to recover.
using Episode = std::vector<Fault>;

struct Plan {
    bool beginsBroken = false;                  ///< the first episode begins before mfard starts
    std::string_view mode;                      ///< super-resolution mode
    [[nodiscard]] bool recordsAtStart() const;  ///< true if the disk is also faulty at the start
    std::vector<Episode> episodes;
    Ns endAfter = 0;               ///< time from the start of the last episode to the end signal
    bool hasTrigger = false;       ///< the still camera waits for trigger pulses
    bool endsBeforeReady = false;  ///< mfard ends before or soon after READY
    bool isKilled = false;         ///< ended with SIGKILL instead of SIGTERM, then started again

    /// Chooses random faults of the kinds whose names contain `only`. Throws std::runtime_error if
    /// no name does.
    [[nodiscard]] static Plan drawn(std::uint64_t seed, int episodes, std::string_view only,
                                    bool hasGpu);
};

}  // namespace mfar::faults
