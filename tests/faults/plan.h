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

/// What a fault does to what is seen, which the judge goes by.
enum class Effect {
    None,         ///< pictures go on
    StopsDevice,  ///< no new picture comes from the camera, and that is to be said
    HangsDriver,  ///< the same, and a thread of mfard's hangs
    Repeats,      ///< a camera sends one picture for ever
    StopsReader,  ///< the screen takes nothing
    StopsGpu,     ///< no picture is finished, and that is to be said, of no camera
    HangsGpu,     ///< the same, and the thread that draws hangs
    Slows,        ///< nothing can be said of times
};

struct Kind {
    std::string_view name;
    Where where;
    Effect effect;
    std::string_view words;   ///< of a camera's file or the GPU's; * is a number
    int least = 0, most = 0;  ///< that number
};

struct Fault {
    const Kind* kind = nullptr;
    Ns begin = 0, length = 0;  ///< after the begin of its episode
    int number = 0;
    [[nodiscard]] std::string text() const;
};

/// One fault or two that overlap, and time to recover.
using Episode = std::vector<Fault>;

struct Plan {
    bool beginsBroken = false;                  ///< the first episode begins before the program
    std::string_view mode;                      ///< of super-resolution
    [[nodiscard]] bool recordsAtStart() const;  ///< into a disk that is broken then
    std::vector<Episode> episodes;
    Ns endAfter = 0;               ///< the signal, so long after the begin of the last episode
    bool hasTrigger = false;       ///< which the still camera waits for
    bool endsBeforeReady = false;  ///< or soon after: nobody waits for that
    bool isKilled = false;  ///< with SIGKILL instead of SIGTERM; then it is started once more

    /// Of the kinds whose names contain `only`. Throws std::runtime_error where there is none.
    [[nodiscard]] static Plan drawn(std::uint64_t seed, int episodes, std::string_view only,
                                    bool hasGpu);
};

}  // namespace mfar::faults
