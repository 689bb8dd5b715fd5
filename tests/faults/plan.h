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

/// The observable effect of a fault, from which the judge derives its rules.
enum class Effect {
    None,
    StopsDevice,  ///< the camera sends no new picture, which mfard must report
    HangsDriver,  ///< like StopsDevice; a thread of mfard also hangs
    Repeats,      ///< a camera sends the same picture again and again
    StopsReader,
    StopsGpu,  ///< no picture is finished; mfard must report this, but not as a camera's fault
    HangsGpu,  ///< like StopsGpu; the drawing thread also hangs
    Slows,     ///< everything is slow, so that times cannot be judged
};

struct Kind {
    std::string_view name;
    Where where;
    Effect effect;
    /// Text for the file that controls the pretended device (see Board::writeDevice());
    /// Fault::number replaces *. Empty: no camera, trigger line or GPU has this fault.
    std::string_view words;
    int least = 0, most = 0;
};

struct Fault {
    const Kind* kind = nullptr;
    Ns begin = 0, length = 0;  ///< time since the episode's start; duration
    int number = 0;
    [[nodiscard]] std::string text() const;
};

/// One fault, or two that may overlap. A pause for recovery follows.
using Episode = std::vector<Fault>;

struct Plan {
    bool beginsBroken = false;  ///< the first episode begins before mfard starts
    std::string_view mode;
    /// True if a fault of the disk begins before mfard starts. mfard is then configured to record
    /// from its start.
    [[nodiscard]] bool recordsAtStart() const;
    std::vector<Episode> episodes;
    Ns endAfter = 0;
    bool hasTrigger = false;
    bool endsBeforeReady = false;  ///< mfard is ended before READY or soon after it
    bool isKilled = false;         ///< mfard is ended with SIGKILL and started again

    /// Chooses random faults of the kinds whose names contain `only`. Throws std::runtime_error if
    /// there is no such kind.
    [[nodiscard]] static Plan drawn(std::uint64_t seed, int episodes, std::string_view only,
                                    bool hasGpu);
};

}  // namespace mfar::faults
