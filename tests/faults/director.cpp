// Runs a schedule of faults within mfard's process, and asks it all the time how it is. Part of the
// library that is preloaded: it begins before main() and ends with the process.

#include "daemon/tools/control_client.h"
#include "tests/faults/board.h"
#include "tests/faults/judge.h"
#include "tests/faults/plan.h"
#include "tests/faults/real_calls.h"

#include <fmt/format.h>

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace mfar::faults {
namespace {

constexpr Ns kEndTime = 3 * kSecond;  ///< from SIGTERM to the end
/// Between episodes: what may be late has come, and mfard is watched while all is well.
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
        // A loose plug is in and out.
        const int times = fault.kind->name.ends_with("loose plug") ? 5 : 1;
        for (int i = 0; i < times; ++i) {
            const Ns part = fault.length / (2 * times - 1);
            const Ns begin = fault.begin + 2 * i * part;
            steps.push_back({begin, &fault, true});
            steps.push_back({begin + part, &fault, false});
        }
    }
    std::ranges::stable_sort(steps, {}, &Step::at);
    return steps;
}

/// Asks for what may be refused, as another fault may be in the way.
void request(const nlohmann::json& what) {
    try {
        static_cast<void>(ask(Board::kSocket, what));
    } catch (const std::exception& error) {
        Judge::get().note(error.what());
    }
}

// A disk that fails does so under a recording.
void apply(const Step& step) {
    static int recordings = 0;
    const bool ofDisk = step.fault->kind->where == Where::Disk;
    if (step.begins) {
        if (ofDisk) {
            const std::string name = Board::kRecording + std::to_string(++recordings);
            request({{"command", "record"}, {"name", name}});
            sleepFor(300 * kMs);
        }
        Judge::get().begins(*step.fault);
        Board::get().begin(*step.fault);
    } else {
        Board::get().end(*step.fault);
        if (ofDisk) request({{"command", "record"}, {"stop", true}});
        Judge::get().ends(*step.fault);
    }
}

void checkRecordings() {
    for (const auto& folder : std::filesystem::directory_iterator(".")) {
        if (!folder.path().filename().string().starts_with(Board::kRecording)) continue;
        Judge::get().recording(folder.path().string());
        std::filesystem::remove_all(folder.path());
    }
}

void checkInQuiet() {
    Judge::get().measure();
    checkRecordings();
    try {
        Judge::get().stats(ask(Board::kSocket, {{"command", "stats"}}).body);
    } catch (const std::exception& error) {
        Judge::get().fail(std::string("stats: ") + error.what());
    }
}

void terminate() {
    Judge::get().terminated();
    kill(getpid(), SIGTERM);
    sleepFor(kEndTime);
    Judge::get().ended(0, false);
    real().exitNow(1);
}

void run(const Plan& plan) {
    std::thread killer;
    for (std::size_t i = 0; i < plan.episodes.size(); ++i) {
        const bool isLast = i + 1 == plan.episodes.size();
        const Ns begin = Scheduler::get().now();
        for (const Fault& fault : plan.episodes[i])
            Judge::get().note(fmt::format("episode {}: {}", i, fault.text()));
        if (isLast)
            killer = std::thread([at = begin + plan.termAfter] {
                sleepUntil(at);
                terminate();
            });
        for (const Step& step : stepsOf(plan.episodes[i])) {
            sleepUntil(begin + step.at);
            apply(step);
        }
        sleepFor(kQuiet);
        if (!isLast) checkInQuiet();
    }
    killer.join();
}

/// Without faults, for as many pictures.
void soak(std::uint64_t frames) {
    while (Judge::get().frames() < frames) {
        sleepFor(600 * kSecond);
        Judge::get().measure();
    }
    terminate();
}

void direct() {
    static const Plan plan =
        Plan::drawn(static_cast<std::uint64_t>(numberOf("MFAR_FAULTS_SEED", 1)),
                    static_cast<int>(numberOf("MFAR_FAULTS_EPISODES", 10)));
    while (!Judge::get().isReady())
        sleepFor(10 * kMs);
    sleepFor(kQuiet);
    Judge::get().measure();
    if (const long frames = numberOf("MFAR_FAULTS_SOAK", 0); frames > 0)
        soak(static_cast<std::uint64_t>(frames));
    run(plan);
}

__attribute__((constructor)) void begin() {
    Judge::get();
    Board::get().setUp();
    // Signals are for mfard's own threads.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    for (void (*work)() : {&runScreen, &askAlways, &direct})
        std::thread(work).detach();
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

}  // namespace
}  // namespace mfar::faults
