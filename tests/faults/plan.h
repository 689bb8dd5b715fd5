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

/// A fault's observable effect, from which the judge derives its rules.
enum class Effect {
    None,         ///< pictures continue
    StopsDevice,  ///< no new picture comes from the camera, which must be reported
    HangsDriver,  ///< as StopsDevice, and a thread of mfard hangs
    Repeats,      ///< a camera repeats one picture
    StopsReader,  ///< the screen reads nothing
    StopsGpu,     ///< no picture is finished, which must be reported, but not as a camera's fault
    HangsGpu,     ///< as StopsGpu, and the drawing thread hangs
    Slows,        ///< times cannot be judged
};

struct Kind {
    std::string_view name;
    Where where;
    Effect effect;
    std::string_view words;   ///< for the file of the camera or GPU; * is replaced by a number
    int least = 0, most = 0;  ///< range of this number
};

struct Fault {
    const Kind* kind = nullptr;
    Ns begin = 0, length = 0;  ///< relative to the start of its episode
    int number = 0;
    [[nodiscard]] std::string text() const;
};

/// One fault, or two that overlap, and time to recover.
using Episode = std::vector<Fault>;

struct Plan {
    bool beginsBroken = false;                  ///< the first episode begins before the program
    std::string_view mode;                      ///< super-resolution mode
    [[nodiscard]] bool recordsAtStart() const;  ///< to a disk that is faulty at the start
    std::vector<Episode> episodes;
    Ns endAfter = 0;               ///< time of the signal, from the start of the last episode
    bool hasTrigger = false;       ///< the still camera waits for the trigger
    bool endsBeforeReady = false;  ///< or soon after; nobody waits for READY
    bool isKilled = false;         ///< with SIGKILL instead of SIGTERM; then it is started again

    /// Draws from the kinds whose names contain `only`. Throws std::runtime_error if there is none.
    [[nodiscard]] static Plan drawn(std::uint64_t seed, int episodes, std::string_view only,
                                    bool hasGpu);
};

}  // namespace mfar::faults
