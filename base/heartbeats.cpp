#include "base/heartbeats.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace mfar {

std::vector<Heartbeats::Late> Heartbeats::late(int patience) const {
    std::vector<Late> out;
    {
        const std::lock_guard lock(mutex_);
        const Timestamp now = clock_();
        for (const Slot& slot : slots_) {
            if (slot.waitsFor.load(std::memory_order_acquire) != nullptr) continue;
            const auto since = now - Timestamp{slot.at.load(std::memory_order_relaxed)};
            if (since > patience * slot.budget) out.push_back({slot.thread, slot.role, since});
        }
    }
    std::ranges::sort(out, std::greater(), &Late::since);
    return out;
}

std::optional<Heartbeats::Waiting> Heartbeats::waiting() const {
    const std::lock_guard lock(mutex_);
    const Timestamp now = clock_();
    std::optional<Waiting> longest;
    for (const Slot& slot : slots_) {
        const char* what = slot.waitsFor.load(std::memory_order_acquire);
        if (what == nullptr || *what == '\0') continue;
        const auto since = now - Timestamp{slot.at.load(std::memory_order_relaxed)};
        if (!longest || since > longest->since)
            longest = Waiting{slot.thread, slot.role, what, since};
    }
    return longest;
}

Heartbeat::Heartbeat(Heartbeats& all, std::string thread, std::chrono::nanoseconds budget,
                     ThreadRole role)
    : Heartbeat(WatchedThread{&all, std::move(thread), budget, role}) {}

Heartbeat::Heartbeat(const WatchedThread& as) : all_(as.all) {
    if (all_ == nullptr) return;
    const std::lock_guard lock(all_->mutex_);
    slot_ =
        all_->slots_.emplace(all_->slots_.end(), as.name, as.budget, as.role, all_->clock_().ns);
}

Heartbeat::~Heartbeat() {
    if (all_ == nullptr) return;
    const std::lock_guard lock(all_->mutex_);
    all_->slots_.erase(slot_);
}

// The time is stored before the state: a reader that sees the new state must see the new time, too.
void Heartbeat::beat() {
    if (all_ == nullptr) return;
    slot_->at.store(all_->clock_().ns, std::memory_order_relaxed);
    slot_->waitsFor.store(nullptr, std::memory_order_release);
}

void Heartbeat::restFor(const char* what) {
    if (all_ == nullptr) return;
    slot_->at.store(all_->clock_().ns, std::memory_order_relaxed);
    slot_->waitsFor.store(what, std::memory_order_release);
}

}  // namespace mfar
