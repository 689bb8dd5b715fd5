#include "daemon/tools/control_client.h"
#include "tests/faults/board.h"
#include "tests/faults/judge.h"
#include "tests/faults/plan.h"
#include "tests/faults/real_calls.h"

#include <fmt/format.h>

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace mfar::faults {
namespace {

constexpr Ns kUs = 1000;
constexpr Ns kEndTime = 3 * kSecond;  ///< longest time from SIGTERM to the end
/// Longest time from the start to READY, whatever the devices do.
constexpr Ns kReadyTime = 5 * kSecond;
/// Pause that lets late effects of faults end. After it, mfard is checked while no fault is
/// injected.
constexpr Ns kQuiet = 4500 * kMs;

long numberOf(const char* variable, long otherwise) {
    const char* text = std::getenv(variable);
    return text != nullptr ? std::strtol(text, nullptr, 10) : otherwise;
}

void sleepFor(Ns time) {
    std::this_thread::sleep_for(std::chrono::nanoseconds(std::max<Ns>(time, 0)));
}

void sleepUntil(Ns time) {
    sleepFor(time - Scheduler::get().now());
}

void askAlways() {
    for (;;) {
        sleepFor(static_cast<Ns>(50 + Scheduler::get().random() % 300) * kMs);
        const Ns asked = Scheduler::get().now();
        if (!Judge::get().isReady()) continue;
        try {
            Judge::get().status(ask(Board::kSocket, {{"command", "status"}}).body, asked);
        } catch (const std::exception& error) {
            Judge::get().answersNot(error.what(), asked);
        }
    }
}

struct Step {
    Ns at;
    const Fault* fault;
    bool begins;
};

std::vector<Step> stepsOf(const Episode& episode) {
    std::vector<Step> steps;
    for (const Fault& fault : episode) {
        const int times = fault.kind->name.ends_with("loose plug") ? 5 : 1;
        for (int i = 0; i < times; ++i) {
            const Ns part = fault.length / (2 * times - 1);
            const Ns begin = fault.begin + 2 * i * part;
            steps.push_back({begin, &fault, true});
            steps.push_back({begin + part, &fault, false});
        }
    }
    std::ranges::sort(steps, {}, [](const Step& step) { return std::pair(step.at, !step.begins); });
    return steps;
}

void request(nlohmann::json what) {  // NOLINT(performance-unnecessary-value-param)
    try {
        static_cast<void>(ask(Board::kSocket, what));
    } catch (const std::exception& error) {
        Judge::get().note(error.what());
    }
}

// Before a fault of the disk begins, this starts a recording, if mfard is ready.
void apply(const Step& step) {
    static int recordings = 0;
    const bool ofDisk = step.fault->kind->where == Where::Disk;
    if (step.begins) {
        if (ofDisk && Judge::get().isReady()) {
            const std::string name = Board::kRecording + std::to_string(++recordings);
            request({{"command", "record"}, {"name", name}});
            sleepFor(300 * kMs);
        }
        Judge::get().begins(*step.fault);
        Board::get().begin(*step.fault);
    } else {
        Board::get().end(*step.fault);
        // The request runs in its own thread, because stopping a recording waits for the disk,
        // which another fault may block.
        if (ofDisk)
            std::thread([] {
                sleepFor(300 * kMs);  // the fault may have delayed the start of the recording
                request({{"command", "record"}, {"stop", true}});
            }).detach();
        Judge::get().ends(*step.fault);
    }
}

void checkRecordings() {
    namespace fs = std::filesystem;
    for (const auto& folder : fs::directory_iterator(".")) {
        if (!folder.path().filename().string().starts_with(Board::kRecording)) continue;
        for (const auto& inner : fs::recursive_directory_iterator(folder))
            if (inner.path().filename() == "cam0")
                Judge::get().recording(inner.path().parent_path().string());
        fs::remove_all(folder.path());
    }
}

const Plan& plan();

std::uint64_t grows() {
    const bool mayTurnOn = std::getenv("MFAR_FAULTY_GL") != nullptr && plan().mode != "detail";
    return (mayTurnOn ? 20U : 8U) << 20U;
}

void checkGrowth(std::uint64_t moreBytes = grows()) {
    for (int i = 0; i < 5; ++i) {
        if (Judge::get().holdsNoMore(moreBytes)) return;
        sleepFor(70 * kMs);
    }
    Judge::get().fail("mfard uses more descriptors, threads or memory than at the first check");
}

void checkLine() {
    for (int i = 0; i < 5; ++i) {
        if (Board::get().lineRests()) return;
        sleepFor(70 * kMs);  // waits for the end of a trigger pulse
    }
    Judge::get().fail("the trigger line is still active");
}

void checkInQuiet() {
    if (Judge::get().frames() == 0)
        Judge::get().fail("the screen has not shown a single intact picture");
    checkGrowth();
    checkRecordings();
    checkLine();
    try {
        Judge::get().stats(ask(Board::kSocket, {{"command", "stats"}}).body);
    } catch (const std::exception& error) {
        Judge::get().fail(std::string("stats: ") + error.what());
    }
}

/// True once begin() has restored the first thread's signal mask. Before that, all signals are
/// blocked, and a blocked SIGTERM does not show that mfard handles it.
std::atomic<bool> hasItsMask = false;

/// True if the first thread blocks SIGTERM. If not, SIGTERM ends the process at once.
bool blocksSigterm() {
    if (!hasItsMask) return false;
    std::ifstream status("/proc/self/status");
    for (std::string key; status >> key;) {
        std::uint64_t mask = 0;
        if (key == "SigBlk:" && status >> std::hex >> mask)
            return (mask >> (SIGTERM - 1) & 1U) != 0;
    }
    return false;
}

[[noreturn]] void terminate() {
    while (!blocksSigterm())
        sleepFor(kUs);
    if (!Judge::get().isReady()) Judge::get().count("SIGTERM before READY", 1);
    Judge::get().terminated();
    kill(getpid(), SIGTERM);
    sleepFor(kEndTime);
    Judge::get().ended(0, false);
    real().exitNow(1);
    __builtin_unreachable();
}

void runEpisode(const Episode& episode, Ns begin) {
    Judge::get().count("episodes", 1);
    for (const Fault& fault : episode)
        Judge::get().note("episode: " + fault.text());
    for (const Step& step : stepsOf(episode)) {
        sleepUntil(begin + step.at);
        apply(step);
    }
    sleepFor(kQuiet);
}

void runLast(const Plan& plan) {
    const Ns begin = Scheduler::get().now();
    std::thread([at = begin + plan.endAfter, isKilled = plan.isKilled] {
        sleepUntil(at);
        if (!isKilled) terminate();
        Judge::get().note("KILLED");
        kill(getpid(), SIGKILL);
    }).detach();
    runEpisode(plan.episodes.back(), begin);
    sleepFor(kSecond * 3600);
}

void run(const Plan& plan) {
    for (std::size_t i = plan.beginsBroken ? 1 : 0; i + 1 < plan.episodes.size(); ++i) {
        runEpisode(plan.episodes[i], Scheduler::get().now());
        checkInQuiet();
    }
    runLast(plan);
}

[[noreturn]] void soak(std::uint64_t frames) {
    constexpr std::uint64_t kMoreBytes = 1U << 20U;
    sleepFor(120 * kSecond);
    while (Judge::get().frames() < frames) {
        checkGrowth(kMoreBytes);
        sleepFor(60 * kSecond);
    }
    checkGrowth(kMoreBytes);
    terminate();
}

const Plan& plan() {
    static const Plan drawn = Plan::drawn(
        static_cast<std::uint64_t>(numberOf("MFAR_FAULTS_SEED", 1)),
        static_cast<int>(numberOf("MFAR_FAULTS_EPISODES", 10)),
        std::getenv("MFAR_FAULTS_ONLY") != nullptr ? std::getenv("MFAR_FAULTS_ONLY") : "",
        std::getenv("MFAR_FAULTY_GL") != nullptr);
    return drawn;
}

void awaitReady() {
    const Ns begin = Scheduler::get().now();
    while (!Judge::get().isReady())
        sleepFor(10 * kMs);
    if (Scheduler::get().now() - begin > kReadyTime)
        Judge::get().fail("mfard became ready later than 5 s after its start");
}

[[noreturn]] void runAfterKill() {
    awaitReady();
    sleepFor(kQuiet);
    if (Judge::get().frames() == 0)
        Judge::get().fail("mfard has shown no picture after the start that follows a kill");
    checkInQuiet();
    terminate();
}

void direct() {
    if (std::getenv("MFAR_FAULTS_AFTER_KILL") != nullptr) runAfterKill();
    const long frames = numberOf("MFAR_FAULTS_SOAK", 0);
    const bool endsAtOnce = plan().episodes.size() == 1;
    if (frames == 0 && plan().beginsBroken && !endsAtOnce) {
        std::thread(awaitReady).detach();
        runEpisode(plan().episodes.front(), Scheduler::get().now());
    } else if (!plan().endsBeforeReady) {
        awaitReady();
        if (!endsAtOnce) sleepFor(kQuiet);
    }
    if (frames > 0) soak(static_cast<std::uint64_t>(frames));
    if (!endsAtOnce) checkGrowth();
    run(plan());
}

__attribute__((constructor)) void begin() {
    Judge::get();
    Board::get().setUp(plan());
    // The threads that start here inherit this mask, because only mfard's own threads may handle
    // signals.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    std::thread(direct).detach();
    // The director starts first, because some faults must begin before everything else.
    Scheduler::get().yield();
    for (void (*work)() : {&runScreen, &askAlways})
        std::thread(work).detach();
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    hasItsMask = true;
}

}  // namespace
}  // namespace mfar::faults
