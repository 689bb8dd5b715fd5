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

/// Visible effect of a fault, which the judge relies on.
enum class Effect {
    None,         ///< pictures go on
    StopsDevice,  ///< no new picture comes from the camera, which has to be reported
    HangsDriver,  ///< as StopsDevice, and a thread of mfard hangs
    Repeats,      ///< a camera repeats one picture
    StopsReader,  ///< the screen takes nothing
    StopsGpu,     ///< no picture is finished, which has to be reported, but not as a camera's fault
    HangsGpu,     ///< as StopsGpu, and the thread that draws hangs
    Slows,        ///< times cannot be judged
};

struct Kind {
    std::string_view name;
    Where where;
    Effect effect;
    std::string_view words;   ///< content of the camera's or the GPU's file; * is a number
    int least = 0, most = 0;  ///< range of that number
};

struct Fault {
    const Kind* kind = nullptr;
    Ns begin = 0, length = 0;  ///< `begin`: relative to the episode's
    int number = 0;
    [[nodiscard]] std::string text() const;
};

/// One fault, or two that overlap, and time to recover.
using Episode = std::vector<Fault>;

struct Plan {
    bool beginsBroken = false;                  ///< the first episode begins before the program
    std::string_view mode;                      ///< of super-resolution
    [[nodiscard]] bool recordsAtStart() const;  ///< the disk has a fault at the start
    std::vector<Episode> episodes;
    Ns endAfter = 0;               ///< time of the signal, after the begin of the last episode
    bool hasTrigger = false;       ///< the still camera is triggered
    bool endsBeforeReady = false;  ///< SIGTERM comes before READY or soon after
    bool isKilled = false;         ///< SIGKILL instead of SIGTERM; then mfard is started again

    /// Draws only kinds whose names contain `only`. Throws std::runtime_error when there is none.
    [[nodiscard]] static Plan drawn(std::uint64_t seed, int episodes, std::string_view only,
                                    bool hasGpu);
};

}  // namespace mfar::faults
