#include "base/workers.h"

#include <algorithm>

namespace mfar {
namespace {

constexpr int kMostThreads = 4;
// Number of parts of a loop per thread. If a thread is interrupted, the other threads execute the
// remaining parts.
constexpr int kPartsPerThread = 4;

}  // namespace

Workers::Workers(int threads) {
    if (threads <= 0)
        threads =
            std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostThreads);
    for (int i = 1; i < threads; ++i)
        threads_.emplace_back([this](const std::stop_token& stop) { work(stop); });
}

Workers::~Workers() {
    for (std::jthread& thread : threads_)
        thread.request_stop();
}

void Workers::forRange(int end, int grain, const std::function<void(int, int)>& body) {
    if (end <= 0) return;
    std::unique_lock lock(mutex_);
    const int parts = kPartsPerThread * count();
    step_ = std::max(grain, (end + parts - 1) / parts);
    next_ = 0;
    end_ = end;
    body_ = &body;
    begun_.notify_all();
    while (takePart(lock)) {
    }
    done_.wait(lock, [&] { return running_ == 0; });
    body_ = nullptr;
}

bool Workers::takePart(std::unique_lock<std::mutex>& lock) {
    if (body_ == nullptr || next_ >= end_) return false;
    const int first = next_;
    const int last = std::min(first + step_, end_);
    next_ = last;
    ++running_;
    const auto& body = *body_;
    lock.unlock();
    body(first, last);
    lock.lock();
    if (--running_ == 0) done_.notify_all();
    return true;
}

void Workers::work(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (begun_.wait(lock, stop, [&] { return body_ != nullptr && next_ < end_; }))
        while (takePart(lock)) {
        }
}

}  // namespace mfar
