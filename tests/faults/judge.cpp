#include "tests/faults/judge.h"

#include "tests/faults/board.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <utility>

namespace mfar::faults {
namespace {

using nlohmann::ordered_json;

// Limits that mfard promises, see daemon/budgets.h, hal/reopening_camera.h and
// systemd/mfard.service.in: age of a stale picture (kStale), time to report a silent camera
// (kMarked), time to recover from a fault (kBack).
constexpr Ns kStale = 3 * kSecond, kMarked = 250 * kMs, kBack = 3 * kSecond;
constexpr Ns kVideoBudget = 1500 * kMs, kWriter = 2500 * kMs;
constexpr Ns kPicture = 2000 * kMs;
constexpr Ns kRepeats = 200 * kMs;  ///< time in which mfard recognises a repeated picture
constexpr Ns kLookTime = kSecond;
constexpr Ns kSameLine = 10 * kSecond;
constexpr std::uint64_t kProvenFrames = 10;
/// Tolerance, because pictures come periodically and answers take time.
constexpr Ns kSlack = 100 * kMs;
constexpr Ns kOnScreen = 500 * kMs;  ///< greatest age of the screen's picture without a fault
constexpr Ns kAnswer = kSecond;

std::string seconds(Ns time) {
    return fmt::format("{:.3f} s", static_cast<double>(time) * 1e-9);
}

Ns now() {
    return Scheduler::get().now();
}

std::uint64_t entries(const char* folder) {
    return static_cast<std::uint64_t>(
        std::distance(std::filesystem::directory_iterator(folder), {}));
}

std::multiset<std::string> openFiles() {
    std::multiset<std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
        std::error_code error;  // ignored: the iterator's own descriptor can be closed by now
        out.insert(std::filesystem::read_symlink(entry.path(), error).string());
    }
    return out;
}

std::uint64_t residentBytes() {
    std::uint64_t all = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> all >> resident;
    return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::string textOf(const ordered_json& said, const char* key) {
    const auto found = said.find(key);
    return found != said.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

Judge& Judge::get() {
    static auto* judge = new Judge;  // never destroyed: threads outlive main()
    return *judge;
}

Judge::Judge() {
    if (const char* file = std::getenv("MFAR_FAULTS_REPORT"))
        report_ = open(file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
}

void Judge::note(const std::string& text) {
    const Ns time = now() - 1000 * kSecond;
    dprintf(report_, "%s\n",
            fmt::format("{:12.6f} {}", static_cast<double>(time) * 1e-9, text).c_str());
}

void Judge::fail(const std::string& text) {
    if (++failures_ <= 20) note("FAILED: " + text);
}

void Judge::count(const std::string& what, std::uint64_t number) {
    dprintf(report_, "COUNT %s %llu\n", what.c_str(), static_cast<unsigned long long>(number));
}

void Judge::change(const Fault& fault, int by) {
    const Kind& kind = *fault.kind;
    const bool stops = kind.effect == Effect::StopsDevice || kind.effect == Effect::HangsDriver ||
                       kind.effect == Effect::Repeats;
    const auto touch = [&](Watched which, bool does) {
        if (does) calm_[which].add(by, now());
    };
    touch(All, true);
    touch(Video, kind.where == Where::Video && stops);
    touch(Still, kind.where == Where::Still && stops);
    touch(Screen, kind.effect == Effect::StopsReader);
    touch(Slow, kind.effect == Effect::Slows);
    touch(Gpu, kind.where == Where::Gpu);
    hadGpuFaults_ = hadGpuFaults_ || kind.where == Where::Gpu;
    touch(Drawing, kind.effect == Effect::HangsGpu);
    touch(VideoDevice, kind.where == Where::Video && stops && kind.effect != Effect::Repeats);
}

void Judge::begins(const Fault& fault) {
    // mfard may wait far longer for opening a device than for reading from it. So a hang is timed
    // only if the camera worked before: then mfard has the device open and hangs while it reads.
    const bool wasSound = calm_[VideoDevice].lasts(kBack, now());
    const int before = calm_[VideoDevice].active;
    change(fault, 1);
    if (calm_[VideoDevice].active > before) hangs_.reset();
    if (fault.kind->where == Where::Video && fault.kind->effect == Effect::HangsDriver && wasSound)
        hangs_ = now();
    note("fault begins: " + std::string(fault.kind->name));
}

void Judge::ends(const Fault& fault) {
    change(fault, -1);
    if (calm_[VideoDevice].active == 0) hangs_.reset();
    note("fault ends: " + std::string(fault.kind->name));
}

void Judge::shows(Ns taken) {
    ++frames_;
    if (shown_ && taken < *shown_) fail("an older picture follows a newer one on the screen");
    shown_ = taken;
}

Ns Judge::age(Ns at) const {
    return shown_ ? at - *shown_ : 0;
}

Ns Judge::missing(Ns at) const {
    const Calm& device = calm_[VideoDevice];
    return device.active > 0 ? std::min(age(at), at - device.since) : 0;
}

/// Time for which the GPU has finished no picture because of a fault. It is 0 while a missing
/// picture is not the GPU's fault: while the camera fails, during the first pictures (which may
/// take longer), and after mfard stopped using the GPU.
Ns Judge::unfinished(Watched gpu, Ns at) const {
    if (calm_[gpu].active == 0 || calm_[Video].active > 0) return 0;
    if (frames_ < kProvenFrames || isGpuGivenUp_) return 0;
    return std::min(age(at), at - std::max(calm_[gpu].since, calm_[Video].since));
}

void Judge::status(const ordered_json& said, Ns asked) {
    ++asked_;
    if (now() - asked > kAnswer && calm_[Slow].lasts(kBack, now()))
        fail("an answer took " + seconds(now() - asked));
    if (isEnding() || !isReady()) return;
    judgeState(said, asked);
    judgeBlame(textOf(said, "fault"), asked);
    judgeWatchdog(asked);
}

void Judge::judgeState(const ordered_json& said, Ns asked) {
    const ordered_json health = said.value("health", ordered_json::object());
    const std::string state = textOf(health, "state"), cause = textOf(health, "cause");
    isGpuGivenUp_ = isGpuGivenUp_ || cause.find("the CPU draws") != cause.npos;
    const std::string fault = textOf(said, "fault");
    const bool isFine = state == "ok" && fault.empty();
    // If the screen's reader stalls, the pipe still takes some pictures. Then the writing thread
    // waits. Status reports this wait only after budget::kTaken.
    const Ns stalled = asked - std::max(calm_[Screen].since, calm_[Video].since);
    // mfard recognises a repeated picture only after several pictures.
    const bool repeats = calm_[Video].active > calm_[VideoDevice].active;
    const bool isKnown = (calm_[Screen].active == 0 || stalled > kWriter) &&
                         (!repeats || calm_[VideoDevice].lasts(kRepeats, asked));
    // For kBack after the video camera has returned, the screen may still show the old picture.
    // This is not a fault. Later, judgeBlame() expects new pictures.
    const bool isDue = calm_[Video].active > 0 || calm_[Video].lasts(kBack, asked);
    if (age(asked) > kStale + kSlack && isFine && isKnown && isDue)
        fail("the screen's picture is " + seconds(age(asked)) + " old, but status says ok");
    // While drawing hangs, mfard does not check its cameras: it checks them between pictures.
    if (missing(asked) > kMarked + kSlack && isFine && calm_[Drawing].lasts(kMarked, asked))
        fail("the video camera has sent nothing for " + seconds(missing(asked)) +
             ", but status says ok");
    if (unfinished(Gpu, asked) > kPicture + kSlack && isFine)
        fail("the GPU has finished no picture for " + seconds(unfinished(Gpu, asked)) +
             ", but status says ok");
    if (!calm_[All].lasts(kBack + kSlack, asked) || frames_ < kProvenFrames) return;
    // The status reports a failed GPU for a minute or permanently.
    const bool namesGpu = hadGpuFaults_ && cause.find("the GPU failed") != cause.npos;
    if (!isFine && !namesGpu)
        fail(fmt::format("no fault has been active for {}, but status says {}: {} {}",
                         seconds(asked - calm_[All].since), state, fault,
                         said.value("health", ordered_json::object()).dump()));
    if (age(asked) > kOnScreen)
        fail("no fault has been active for " + seconds(asked - calm_[All].since) +
             ", but the screen's picture is " + seconds(age(asked)) + " old");
}

void Judge::judgeBlame(const std::string& fault, Ns asked) {
    if (!calm_[Slow].lasts(kBack, asked)) return;
    const bool video = calm_[Video].lasts(kBack + kSlack, asked);
    const bool still = calm_[Still].lasts(kBack + kSlack, asked);
    if (video && fault.find("video camera") != fault.npos)
        fail("status reports a fault of the video camera, which has none: " + fault);
    if (still && fault.find("still camera") != fault.npos)
        fail("status reports a fault of the still camera, which has none: " + fault);
    if (video && calm_[Screen].lasts(kBack, asked) && calm_[Gpu].lasts(kBack, asked) && shown_ &&
        age(asked) > kOnScreen)
        fail("the video camera has no fault, but the screen's picture is " + seconds(age(asked)) +
             " old");
}

/// Called at each notification of the watchdog, and also at each status, because the notifications
/// may stop or never begin.
void Judge::judgeWatchdog(Ns at) {
    if (!isReady() || frames_ < kProvenFrames) return;
    const Ns unfed = at - std::max(fed_.value_or(0), *ready_);
    if (unfed > kLookTime + kSlack && calm_[All].lasts(kBack + kSlack + kLookTime, at))
        fail("no fault is active, but mfard has not notified the watchdog for " + seconds(unfed));
}

void Judge::answersNot(const std::string& why, Ns asked) {
    if (isEnding() || !isReady() || !calm_[Slow].lasts(kBack, now())) return;
    fail(fmt::format("mfard gave no answer within {}: {}", seconds(now() - asked), why));
}

void Judge::serviceHears(std::string_view text) {
    if (text.starts_with("READY=1") && !ready_) {
        ready_ = now();
        for (Calm& calm : calm_)
            calm.since = now();
        note("READY");
    }
    if (text.starts_with("WATCHDOG=1")) fed();
}

void Judge::fed() {
    ++meals_;
    if (isEnding()) return;
    judgeWatchdog(now());
    fed_ = now();
    if (frames_ < kProvenFrames || !calm_[Slow].lasts(kBack, now())) return;
    if (hangs_ && missing(now()) > kVideoBudget + kSlack)
        fail("mfard notifies the watchdog although the video driver has hung for " +
             seconds(missing(now())));
    if (unfinished(Drawing, now()) > kPicture + kSlack)
        fail("mfard notifies the watchdog although drawing has hung for " +
             seconds(unfinished(Drawing, now())));
    const bool isNamed = !calm_[Video].lasts(kBack, now()) || !calm_[Screen].lasts(kBack, now()) ||
                         !calm_[Gpu].lasts(kBack, now());
    if (age(now()) > kStale + kSlack && !isNamed)
        fail("mfard notifies the watchdog although the picture is " + seconds(age(now())) + " old");
}

void Judge::logSays(std::string_view text) {
    logBytes_ += text.size();
    std::string all(text.substr(0, text.find_last_not_of('\n') + 1));
    note("log: " + std::regex_replace(all, std::regex("\n"), "\n             log: "));
    // While mfard ends, it logs the repetitions that it held back. This is not a fault.
    if (isEnding() || all.find("mfard.toml") != all.npos) return;
    // The message without its duration and without the number of repetitions.
    const std::string event =
        std::regex_replace(all, std::regex(R"( \((degraded|stalled|repeated)[^)]*\))"), "");
    const auto before = logged_.find(event);
    if (before != logged_.end() && now() - before->second < kSameLine - kSlack)
        fail("the log repeats the same message after " + seconds(now() - before->second));
    logged_[event] = now();
}

void Judge::terminated() {
    terminated_ = now();
    note("SIGTERM");
}

void Judge::ended(int code, bool inTime) {
    if (!inTime) fail("mfard did not end within 3 s after SIGTERM");
    if (code != 0) fail(fmt::format("mfard ends with exit code {}", code));
    if (terminated_)
        count("ms from SIGTERM to the end",
              static_cast<std::uint64_t>((now() - *terminated_) / kMs));
    count("frames", frames_);
    count("answers", asked_);
    count("watchdog notifications", meals_);
    count("turns", Scheduler::get().turns());
    count("log bytes", logBytes_);
    count("simulated ms", static_cast<std::uint64_t>(now() / kMs - 1'000'000));
    note(fmt::format("ENDED with {}", code));
}

void Judge::stats(const ordered_json& said) {
    using Known =
        void (*)(const char*, std::uint64_t*, std::uint64_t*, std::int64_t*, std::uint64_t*);
    const auto known = reinterpret_cast<Known>(dlsym(RTLD_DEFAULT, "mfar_pretended_known"));
    for (const auto& [camera, device] : {std::pair("video", "video90"), {"still", "video91"}}) {
        std::uint64_t broken = 0, badTimes = 0, ungained = 0;
        std::int64_t gain = 0;
        known(device, &broken, &badTimes, &gain, &ungained);
        if (gain != Board::kGain || ungained > 0)
            fail(fmt::format("the {} camera's gain is {}, but {} is configured; {} pictures were "
                             "taken before it was set",
                             camera, gain, Board::kGain, ungained));
        const ordered_json& counted = said.at("cameras").at(camera);
        if (counted.at("broken") != broken || counted.at("bad_times") != badTimes)
            fail(fmt::format("the {} camera has sent {} broken pictures and {} bad times, but "
                             "mfard counted {} and {}",
                             camera, broken, badTimes, counted.at("broken").dump(),
                             counted.at("bad_times").dump()));
    }
}

void Judge::recording(const std::string& folder) {
    const std::filesystem::path camera = std::filesystem::path(folder) / "cam0";
    std::ifstream list(camera / "data.csv");
    std::uint64_t pictures = 0;
    std::string line;
    while (std::getline(list, line)) {
        if (line.starts_with("#")) continue;
        const std::string name = line.substr(line.find(',') + 1);
        std::error_code error;
        if (std::filesystem::file_size(camera / "data" / name, error) == 0 || error)
            fail("a recording lists " + name + ", which is missing or empty");
        ++pictures;
    }
    note(fmt::format("the recording {} has {} pictures", folder, pictures));
}

bool Judge::holdsNoMore(std::uint64_t moreBytes) {
    const Held is{openFiles(), entries("/proc/self/task"), residentBytes()};
    if (!first_) first_ = is;
    const Held& first = *first_;
    note(fmt::format("mfard has {} descriptors, {} threads, {} KB; at the first check {}, {}, {}",
                     is.files.size(), is.threads, is.bytes >> 10U, first.files.size(),
                     first.threads, first.bytes >> 10U));
    const bool moreFiles = is.files.size() > first.files.size();
    if (moreFiles) {
        std::vector<std::string> added;
        std::ranges::set_difference(is.files, first.files, std::back_inserter(added));
        note(fmt::format("new descriptors: {}", fmt::join(added, ", ")));
    }
    return !moreFiles && is.threads <= first.threads && is.bytes <= first.bytes + moreBytes;
}

}  // namespace mfar::faults
