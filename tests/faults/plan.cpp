#include "tests/faults/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <span>
#include <stdexcept>

namespace mfar::faults {
namespace {

using enum Where;
using enum Effect;

constexpr std::array kKinds = {
    Kind{"video camera silent", Video, StopsDevice, "silent"},
    Kind{"video camera hangs", Video, HangsDriver, "hang"},
    Kind{"video camera repeats", Video, Repeats, "repeat"},
    Kind{"video camera unplugged", Video, StopsDevice, "gone"},
    Kind{"video camera loose plug", Video, StopsDevice, "gone"},
    Kind{"video camera i/o error", Video, StopsDevice, "eio"},
    Kind{"video camera never closes", Video, StopsDevice, "gone hang-close"},
    Kind{"video camera never opens", Video, StopsDevice, "gone hang-open"},
    Kind{"video camera opens slowly", Video, StopsDevice, "gone slow *", 100, 1500},
    Kind{"video camera few buffers", Video, StopsDevice, "gone buffers *", 1, 4},
    Kind{"video camera control refused", Video, StopsDevice, "unplug refuse *", 3, 6},
    Kind{"video camera broken frames", Video, None, "error *", 2, 9},
    Kind{"video camera short frames", Video, None, "short *", 2, 9},
    Kind{"video camera times go backwards", Video, None, "backward *", 2, 9},
    Kind{"video camera times in the future", Video, None, "future *", 2, 9},
    Kind{"video camera frame numbers skip", Video, None, "skip *", 1, 100},
    Kind{"video camera frame numbers restart", Video, None, "restart"},
    Kind{"video camera wrong rate", Video, None, "rate *", 10, 60},
    Kind{"still camera silent", Still, StopsDevice, "silent"},
    Kind{"still camera hangs", Still, HangsDriver, "hang"},
    Kind{"still camera repeats", Still, Repeats, "repeat"},
    Kind{"still camera unplugged", Still, StopsDevice, "gone"},
    Kind{"still camera loose plug", Still, StopsDevice, "gone"},
    Kind{"still camera i/o error", Still, StopsDevice, "eio"},
    Kind{"still camera never closes", Still, StopsDevice, "gone hang-close"},
    Kind{"still camera never opens", Still, StopsDevice, "gone hang-open"},
    Kind{"still camera opens slowly", Still, StopsDevice, "gone slow *", 100, 1500},
    Kind{"still camera few buffers", Still, StopsDevice, "gone buffers *", 1, 4},
    Kind{"still camera control refused", Still, StopsDevice, "unplug refuse *", 3, 6},
    Kind{"still camera broken frames", Still, None, "error *", 2, 9},
    Kind{"still camera short frames", Still, None, "short *", 2, 9},
    Kind{"still camera times go backwards", Still, None, "backward *", 2, 9},
    Kind{"still camera times in the future", Still, None, "future *", 2, 9},
    Kind{"still camera frame numbers skip", Still, None, "skip *", 1, 100},
    Kind{"trigger line unplugged", Line, None, "gone"},
    Kind{"trigger line i/o error", Line, None, "eio"},
    Kind{"trigger line busy", Line, None, "eio busy"},
    Kind{"screen reader stalls", Reader, StopsReader, ""},
    Kind{"idle clients", Clients, None, "", 1, 20},
    Kind{"bad configuration", Configuration, None, "", 0, 5},
    Kind{"configuration loaded again", Configuration, None, "", 100, 101},
    Kind{"wall clock steps", Wall, None, "", 0, 3},
    Kind{"disk full", Disk, None, "", 0, 0},
    Kind{"disk hangs", Disk, None, "", 1, 1},
    Kind{"no free descriptors", Descriptors, Slows, "", 0, 3},
    Kind{"slow machine", Machine, Slows, "", 10, 200},
    // The following faults need a GPU.
    Kind{"GPU late", Gpu, StopsGpu, "never"},
    Kind{"GPU lost", Gpu, None, "lost"},
    Kind{"GPU hangs", Gpu, HangsGpu, "hang"},
};
constexpr std::size_t kOfGpu = 3;

/// Longest duration of a fault of the GPU. Even two such faults that overlap end before the
/// watchdog stops mfard.
constexpr Ns kLongestOfGpu = 3300 * kMs;

/// Longest time from the start to READY if mfard does not wait [ns on the simulated clock]. Each
/// reading advances this clock by half a microsecond.
constexpr std::uint64_t kStartTime = 40'000;

/// Draws a kind of fault. Kinds that can stop pictures are three times as likely as the others.
const Kind& drawnKind(std::mt19937_64& random, std::string_view only, bool hasGpu) {
    const auto isMeant = [&](const Kind& kind) { return kind.name.find(only) != only.npos; };
    const auto kinds = std::span(kKinds).first(kKinds.size() - (hasGpu ? 0 : kOfGpu));
    if (std::ranges::none_of(kinds, isMeant))
        throw std::runtime_error(fmt::format("no kind of fault has '{}' in its name", only));
    for (;;) {
        const Kind& kind = kinds[random() % kinds.size()];
        if (!isMeant(kind)) continue;
        const bool canStop = (kind.where == Video && kind.effect != None) || kind.where == Gpu;
        if (canStop || random() % 3 == 0) return kind;
    }
}

Fault drawnFault(std::mt19937_64& random, std::string_view only, bool hasGpu) {
    const auto below = [&](std::uint64_t end) { return random() % end; };
    Fault out;
    out.kind = &drawnKind(random, only, hasGpu);
    out.begin = static_cast<Ns>(below(1500)) * kMs;
    // A duration between 30 ms and 10 s. Half of the durations are above 1.8 s.
    const double octave = static_cast<double>(std::max(below(1000), below(1000))) / 1000;
    out.length = static_cast<Ns>(30e6 * std::pow(333.0, octave));
    if (out.kind->where == Gpu) out.length = std::min(out.length, kLongestOfGpu);
    out.number =
        out.kind->least +
        static_cast<int>(below(static_cast<std::uint64_t>(out.kind->most - out.kind->least) + 1));
    return out;
}

}  // namespace

std::string Fault::text() const {
    std::string out =
        fmt::format("{} from {:.3f} s for {:.3f} s", kind->name, static_cast<double>(begin) * 1e-9,
                    static_cast<double>(length) * 1e-9);
    if (kind->most > 0) out += fmt::format(" ({})", number);
    return out;
}

bool Plan::recordsAtStart() const {
    const auto isOfDisk = [](const Fault& fault) { return fault.kind->where == Disk; };
    return beginsBroken && std::ranges::any_of(episodes.front(), isOfDisk);
}

Plan Plan::drawn(std::uint64_t seed, int episodes, std::string_view only, bool hasGpu) {
    std::mt19937_64 random(seed);
    Plan out;
    constexpr std::array<std::string_view, 3> kModes = {"off", "detail", "blend"};
    out.beginsBroken = random() % 4 == 0;
    out.hasTrigger = random() % 2 == 0 && MFAR_FAULTS_HAS_LINE;
    out.mode = kModes[random() % kModes.size()];
    const bool endsEarly = random() % 8 == 0;
    out.endsBeforeReady = endsEarly && random() % 2 == 0;
    if (endsEarly) episodes = 1;
    for (int i = 0; i < episodes; ++i) {
        Episode episode{drawnFault(random, only, hasGpu)};
        if (random() % 2 == 0) episode.push_back(drawnFault(random, only, hasGpu));
        out.episodes.push_back(std::move(episode));
    }
    out.endAfter = static_cast<Ns>(random() % (endsEarly ? 300 : 6000)) * kMs;
    if (out.endsBeforeReady) out.endAfter = static_cast<Ns>(random() % kStartTime);
    out.isKilled = random() % 6 == 0;
    for (const Fault& fault : out.episodes.front())
        if (fault.kind->where == Descriptors) out.beginsBroken = false;
    if (out.beginsBroken)
        for (Fault& fault : out.episodes.front())
            fault.begin = 0;
    return out;
}

}  // namespace mfar::faults
