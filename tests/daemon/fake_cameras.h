#pragma once

#include "daemon/rig_source.h"
#include "hal/camera.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace mfar::test {

/// A camera that delivers the pictures that the test sends. Thread-safe.
class FakeCamera final : public Camera {
public:
    FakeCamera(std::string name, Size size, double rateHz)
        : info_{std::move(name), size, PixelFormat::Gray8, rateHz} {}

    [[nodiscard]] CameraInfo info() const override { return info_; }
    void start() override {}
    [[nodiscard]] std::optional<Frame> next(std::chrono::milliseconds timeout) override {
        std::unique_lock lock(mutex_);
        askers_.insert(std::this_thread::get_id());
        changed_.wait_for(lock, timeout, [&] { return stopped_ || !waiting_.empty() || broken_; });
        hung_ = hangs_;
        changed_.notify_all();
        changed_.wait(lock, [&] { return !hangs_; });
        hung_ = false;
        if (broken_) throw std::runtime_error(*broken_);
        if (stopped_ || waiting_.empty()) return std::nullopt;
        std::optional<Frame> out = std::move(waiting_.front());
        waiting_.pop_front();
        return out;
    }
    void stop() override {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
        changed_.notify_all();
    }
    [[nodiscard]] bool ended() const override {
        const std::lock_guard lock(mutex_);
        return ends_ && waiting_.empty();
    }

    [[nodiscard]] CameraCounters cameraCounters() const override {
        const std::lock_guard lock(mutex_);
        return counters_;
    }
    [[nodiscard]] std::vector<std::string> takeWarnings() override {
        const std::lock_guard lock(mutex_);
        return std::exchange(warnings_, {});
    }

    void count(const CameraCounters& counters) {
        const std::lock_guard lock(mutex_);
        counters_ = counters;
    }
    void warn(const std::string& text) {
        const std::lock_guard lock(mutex_);
        warnings_.push_back(text);
    }
    /// Delivers a picture of grey level `level`, exposed at time `seconds`.
    void send(double seconds, std::uint8_t level = 0, std::optional<Size> size = std::nullopt) {
        const Size picture = size.value_or(info_.size);
        auto pixels = std::make_shared<std::vector<std::uint8_t>>(
            static_cast<std::size_t>(picture.width) * picture.height, level);
        const ImageView view{pixels->data(), picture, static_cast<std::size_t>(picture.width),
                             PixelFormat::Gray8};
        const std::lock_guard lock(mutex_);
        waiting_.emplace_back(view, Timestamp::fromSeconds(seconds), [pixels] {});
        changed_.notify_all();
    }
    void end() {
        const std::lock_guard lock(mutex_);
        ends_ = true;
        changed_.notify_all();
    }
    void fail(const std::string& why) {
        const std::lock_guard lock(mutex_);
        broken_ = why;
        changed_.notify_all();
    }
    void hang(bool wanted) {
        const std::lock_guard lock(mutex_);
        hangs_ = wanted;
        changed_.notify_all();
    }
    /// Waits until hang(true) holds a thread in next(). Returns false if none is held after 20 s.
    [[nodiscard]] bool isHung() {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, std::chrono::seconds(20), [&] { return hung_; });
    }
    [[nodiscard]] bool isEmpty() const {
        const std::lock_guard lock(mutex_);
        return waiting_.empty();
    }
    [[nodiscard]] std::set<std::thread::id> askers() const {
        const std::lock_guard lock(mutex_);
        return askers_;
    }

private:
    const CameraInfo info_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Frame> waiting_;
    std::set<std::thread::id> askers_;
    CameraCounters counters_;
    std::vector<std::string> warnings_;
    std::optional<std::string> broken_;
    bool stopped_ = false, ends_ = false, hangs_ = false, hung_ = false;
};

inline constexpr Size kFakeVideo{8, 6}, kFakeStill{16, 12};

class FakeSource final : public RigSource {
public:
    explicit FakeSource(HandOver mode, bool sensors = false) {
        handOver = mode;
        hasSensors = sensors;
        geometry_.video.size = kFakeVideo;
        geometry_.still.size = kFakeStill;
    }
    [[nodiscard]] const StereoRig& geometry() const override { return geometry_; }
    [[nodiscard]] Camera& video() override { return videoCamera; }
    [[nodiscard]] Camera& still() override { return stillCamera; }
    [[nodiscard]] Trigger* trigger() override { return nullptr; }
    [[nodiscard]] std::string name() const override { return "fake"; }

    FakeCamera videoCamera{"fake video", kFakeVideo, 30};
    FakeCamera stillCamera{"fake still", kFakeStill, 0};

private:
    StereoRig geometry_;
};

}  // namespace mfar::test
