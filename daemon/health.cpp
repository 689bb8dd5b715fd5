#include "daemon/health.h"

#include "daemon/budgets.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace mfar {
namespace {

constexpr std::chrono::seconds kWorthTelling{1};
constexpr double kStalePeriods = 5;

struct Judged {
    HealthState state = HealthState::Ok;
    std::string cause{};
    std::optional<Timestamp> since{};
    std::string thread{};
    bool isDevice = false;
};

double inSeconds(std::chrono::nanoseconds d) {
    return std::chrono::duration<double>(d).count();
}

std::optional<Judged> hanging(const Observed& seen, ThreadRole role, HealthState state) {
    for (const Heartbeats::Late& late : seen.late)
        if (late.role == role)
            return Judged{state, fmt::format("the {} thread hangs", late.thread),
                          seen.now - late.since, late.thread};
    return std::nullopt;
}

// Returns true if the last picture is recent. The limit grows with the camera's frame period,
// because a low frame rate is not a fault.
bool isFresh(std::optional<Timestamp> shown, const Observed& seen) {
    if (!shown) return false;
    const double period = seen.rateHz > 0 ? 1 / seen.rateHz : 0;
    const double limit = std::max(inSeconds(kStalePicture), kStalePeriods * period);
    return inSeconds(seen.now - *shown) <= seen.patience * limit;
}

// Returns the state Stalled if recently there was neither a new picture nor a known reason for
// none, although mfard became ready long enough ago. Otherwise returns nothing. Must be called only
// if no vital thread hangs.
std::optional<Judged> standingStill(const Observed& seen) {
    // A recent reason is enough: after a device has returned, its first picture is not shown at
    // once.
    if (isFresh(seen.lastPicture, seen) || isFresh(seen.lastExcuse, seen)) return std::nullopt;
    const std::optional<Timestamp> begin = std::max(seen.lastPicture, seen.started);
    if (!begin || isFresh(begin, seen)) return std::nullopt;
    std::string cause = seen.gpu.value_or("no new picture");
    if (seen.waiting && seen.waiting->role == ThreadRole::Vital)
        cause = fmt::format("waiting for {}", seen.waiting->what);
    return Judged{HealthState::Stalled, std::move(cause), *begin};
}

// Returns the state Degraded with the causes of all current faults. Without a fault, returns Ok.
Judged missing(const Observed& seen) {
    std::vector<Judged> all;
    if (seen.fault) all.push_back({HealthState::Degraded, *seen.fault, std::nullopt, "", true});
    if (seen.repeats)
        all.push_back(
            {HealthState::Degraded, "video camera: repeats the same picture", seen.repeats});
    if (seen.gpu) all.push_back({HealthState::Degraded, *seen.gpu});
    if (seen.waiting && seen.waiting->since > kWorthTelling)
        all.push_back({HealthState::Degraded, fmt::format("waiting for {}", seen.waiting->what),
                       seen.now - seen.waiting->since});
    if (seen.display) all.push_back({HealthState::Degraded, *seen.display});
    if (auto found = hanging(seen, ThreadRole::Helper, HealthState::Degraded))
        all.push_back(*std::move(found));
    if (all.empty()) return {};
    Judged out = std::move(all.front());
    for (auto one = all.begin() + 1; one != all.end(); ++one) {
        out.cause += "; " + one->cause;
        out.since.reset();
        if (out.thread.empty()) out.thread = one->thread;
    }
    return out;
}

Judged judged(const Observed& seen) {
    if (auto found = hanging(seen, ThreadRole::Vital, HealthState::Stalled)) return *found;
    if (auto found = standingStill(seen)) return *found;
    return missing(seen);
}

}  // namespace

std::string_view name(HealthState state) {
    if (state == HealthState::Stalled) return "stalled";
    return state == HealthState::Degraded ? "degraded" : "ok";
}

std::string sentence(const Health& health) {
    if (health.state == HealthState::Ok) return "ok";
    std::string out =
        fmt::format("{} ({} for {:.1f} s", health.cause, name(health.state), health.sinceS);
    if (health.pictureAgeS) out += fmt::format(", last picture {:.1f} s ago", *health.pictureAgeS);
    return out + ")";
}

Subject subjectOf(const Health& health) {
    Subject out{health.isAlive() ? message::kDegraded : message::kStalled, "", health.thread};
    for (const std::string_view camera : {"video", "still"})
        if (health.cause.find(fmt::format("{} camera", camera)) != std::string::npos)
            out.camera += (out.camera.empty() ? "" : " ") + std::string(camera);
    return out;
}

nlohmann::ordered_json healthJson(const Health& health) {
    nlohmann::ordered_json out = {{"state", name(health.state)},
                                  {"cause", nullptr},
                                  {"since_s", health.sinceS},
                                  {"picture_age_s", nullptr},
                                  {"thread", nullptr}};
    if (!health.cause.empty()) out["cause"] = health.cause;
    if (health.pictureAgeS) out["picture_age_s"] = *health.pictureAgeS;
    if (!health.thread.empty()) out["thread"] = health.thread;
    return out;
}

Health HealthRecord::judge(const Observed& seen) {
    Judged now = judged(seen);
    const bool isNew = now.state != last_.state || now.cause != last_.cause;
    if (now.since)
        since_ = *now.since;
    else if (isNew || since_ == Timestamp{})
        since_ = seen.now;
    last_ = {now.state,    std::move(now.cause),  inSeconds(seen.now - since_),
             std::nullopt, std::move(now.thread), now.isDevice};
    if (seen.lastPicture) last_.pictureAgeS = inSeconds(seen.now - *seen.lastPicture);
    return last_;
}

}  // namespace mfar
