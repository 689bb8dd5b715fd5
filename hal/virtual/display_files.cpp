#include "hal/virtual/display_files.h"

#include "base/gl/fence.h"
#include "hal/virtual/background_writer.h"
#include "hal/virtual/image_files.h"
#include "hal/virtual/y4m.h"

#include <fmt/format.h>

#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mfar {
namespace {

namespace fs = std::filesystem;

constexpr int kBuffers = 4;
constexpr std::chrono::milliseconds kErrorPoll{100};

class NoDisplay final : public Display {
public:
    // Waits for the GPU. Otherwise, the CPU could queue any number of frames for it, and the
    // measured frame rate would be wrong.
    void show(const Picture& picture, Timestamp) override {
        // The result is ignored, because a hanging GPU is detected before the next picture.
        if (!picture.isOnHost()) (void)gpu::finishWithin();
    }
    void finish() override {}
    [[nodiscard]] std::string name() const override { return "none"; }
};

class FileDisplay : public Display {
public:
    FileDisplay(int threads, std::stop_token cancel, FileDisplayPolicy policy)
        : policy_(std::move(policy)),
          onCancel_(std::move(cancel), [this] { cancel_.request_stop(); }),
          writer_(threads, policy_.writer) {}

    void show(const Picture& picture, Timestamp time) final {
        if (!pool_ || pool_->size() != picture.size()) {
            checkSize(picture.size());
            pool_.emplace(picture.size(), PixelFormat::Rgba8, kBuffers);
        }
        const std::optional<FramePool::Slot> slot = policy_.isLive ? freeBuffer() : waitForBuffer();
        if (!slot) return;
        auto loan = std::make_shared<Frame>(pool_->lend(*slot, time));
        copyPicture(picture, slot->data, slot->stride);
        // If the GL context is lost, reading leaves the pixels unchanged.
        if (!picture.isOnHost() && gpu::takeError() != GL_NO_ERROR)
            throw gpu::GlError("the picture cannot be read back from GL");
        {
            const std::lock_guard lock(mutex_);
            waiting_.push_back(std::move(loan));
            // If an older picture was skipped, its job is still in the writer's queue and writes
            // this one.
            if (jobs_ == waiting_.size()) return;
            ++jobs_;
        }
        writer_.post([this] { writeOldest(); });
    }
    void finish() final {
        const Waits waits(*this);
        if (!policy_.isLive) return writer_.drain();
        if (drainWhileWriting()) return;
        cancel_.request_stop();
        throw std::runtime_error(takesNothing());
    }
    [[nodiscard]] std::uint64_t leftOut() const final { return leftOut_; }
    [[nodiscard]] std::optional<std::string> fault() const final {
        if (!writesFor(policy_.stalled)) return std::nullopt;
        return takesNothing();
    }

protected:
    /// Throws if pictures of this size cannot be written. The thread of show() calls it before the
    /// first picture of a size.
    virtual void checkSize(Size size) = 0;
    virtual void write(const Frame& picture) = 0;
    /// Returns the name of the device or program that show() may wait for, e.g. "the disk".
    [[nodiscard]] virtual const char* consumer() const = 0;
    [[nodiscard]] std::stop_token cancelled() const { return cancel_.get_token(); }
    /// Waits until all pictures are written. Destructors of derived classes must call it, because
    /// the writer's jobs call functions of these classes.
    void finishQuietly() noexcept {
        try {
            // A live source must not wait without a limit for a pipe's reader. If writing one
            // picture takes longer than policy_.finish, writing is cancelled.
            if (policy_.isLive && !drainWhileWriting()) cancel_.request_stop();
            writer_.drain();
        } catch (const std::exception&) {
            // A destructor cannot report errors; finish() reports them.
        }
    }

private:
    class Waits {
    public:
        explicit Waits(const FileDisplay& of) : of_(of) {
            if (of_.policy_.waiting) of_.policy_.waiting(of_.consumer());
        }
        Waits(const Waits&) = delete;
        Waits& operator=(const Waits&) = delete;
        ~Waits() {
            if (of_.policy_.waiting) of_.policy_.waiting(nullptr);
        }

    private:
        const FileDisplay& of_;
    };

    [[nodiscard]] std::string takesNothing() const {
        return fmt::format("{}: {} accepts no data", name(), consumer());
    }

    [[nodiscard]] bool writesFor(std::chrono::milliseconds time) const {
        const std::lock_guard lock(mutex_);
        return !writing_.empty() && Timestamp::now() - *writing_.begin() > time;
    }

    [[nodiscard]] bool drainWhileWriting() {
        while (!writer_.drainWithin(kErrorPoll))
            if (writesFor(policy_.finish)) return false;
        return true;
    }

    void throwError() const {
        if (const std::optional<std::string> error = writer_.error())
            throw std::runtime_error(*error);
    }

    FramePool::Slot waitForBuffer() {
        throwError();
        if (const auto slot = pool_->acquire(std::chrono::milliseconds(0))) return *slot;
        const Waits waits(*this);
        for (;;) {
            throwError();
            if (const auto slot = pool_->acquire(kErrorPoll)) return *slot;
        }
    }

    // Returns a free buffer. If there is none, skips the oldest picture that is not being written
    // and returns its buffer. Returns nothing if all pictures are being written.
    std::optional<FramePool::Slot> freeBuffer() {
        throwError();
        if (const auto slot = pool_->acquire(std::chrono::milliseconds(0))) return slot;
        ++leftOut_;
        std::shared_ptr<Frame> oldest;
        {
            const std::lock_guard lock(mutex_);
            if (waiting_.empty()) return std::nullopt;
            oldest = std::move(waiting_.front());
            waiting_.pop_front();
        }
        oldest.reset();
        return pool_->acquire(std::chrono::milliseconds(0));
    }

    void writeOldest() {
        const Timestamp begun = Timestamp::now();
        std::shared_ptr<Frame> picture;
        {
            const std::lock_guard lock(mutex_);
            --jobs_;
            if (waiting_.empty()) return;  // the picture was skipped
            picture = std::move(waiting_.front());
            waiting_.pop_front();
            writing_.insert(begun);
        }
        const std::shared_ptr<void> atEnd(nullptr, [&](void*) {
            const std::lock_guard lock(mutex_);
            writing_.erase(writing_.find(begun));
        });
        write(*picture);
    }

    const FileDisplayPolicy policy_;
    std::stop_source cancel_;
    std::optional<FramePool> pool_;
    std::atomic<std::uint64_t> leftOut_{0};
    mutable std::mutex mutex_;
    std::deque<std::shared_ptr<Frame>> waiting_;
    std::size_t jobs_ = 0;  // number of jobs that the writer has not begun
    std::multiset<Timestamp> writing_;
    std::stop_callback<std::function<void()>> onCancel_;
    BackgroundWriter writer_;  // must be the last member, because its threads use the members above
};

class PngDisplay final : public FileDisplay {
public:
    PngDisplay(fs::path folder, std::stop_token cancel, const FileDisplayPolicy& policy)
        : FileDisplay(2, std::move(cancel), policy), folder_(std::move(folder)) {
        if (folder_.empty())
            throw std::runtime_error("png: no folder is given; expected png:FOLDER");
        std::error_code error;
        fs::create_directories(folder_, error);
        if (error)
            throw std::runtime_error(fmt::format("{}: the folder cannot be created: {}",
                                                 folder_.string(), error.message()));
        if (access(folder_.c_str(), W_OK | X_OK) != 0)
            throw std::runtime_error(folder_.string() + ": the folder is not writable");
    }
    ~PngDisplay() override { finishQuietly(); }
    [[nodiscard]] std::string name() const override { return "png:" + folder_.string(); }

protected:
    void checkSize(Size) override {}
    [[nodiscard]] const char* consumer() const override { return "the disk"; }
    void write(const Frame& picture) override {
        savePng(folder_ / fmt::format("{}.png", picture.time().ns), picture.view());
    }

private:
    fs::path folder_;
};

class Y4mDisplay final : public FileDisplay {
public:
    Y4mDisplay(std::string_view target, double rateHz, std::stop_token cancel,
               const FileDisplayPolicy& policy)
        : FileDisplay(1, std::move(cancel), policy), sink_(target, cancelled()), rateHz_(rateHz) {}
    ~Y4mDisplay() override { finishQuietly(); }
    [[nodiscard]] std::string name() const override { return "y4m:" + sink_.name(); }

protected:
    [[nodiscard]] const char* consumer() const override {
        return sink_.isPipe() ? "the reader of the pipe" : "the disk";
    }
    void checkSize(Size size) override {
        if (size_ != Size{} && size != size_)
            throw std::runtime_error(sink_.name() + ": the size of a Y4M video cannot change");
        size_ = size;
    }
    void write(const Frame& picture) override {
        bytes_.clear();
        if (!headerWritten_) {
            const std::string header = y4mHeader(picture.view().size, rateHz_);
            bytes_.assign(header.begin(), header.end());
            headerWritten_ = true;
        }
        appendY4mFrame(picture.view(), bytes_);
        sink_.write(bytes_);
    }

private:
    ByteSink sink_;
    double rateHz_;
    Size size_;
    bool headerWritten_ = false;
    std::vector<std::uint8_t> bytes_;
};

}  // namespace

std::unique_ptr<Display> openFileDisplay(std::string_view spec, double rateHz,
                                         std::stop_token cancel, const FileDisplayPolicy& policy) {
    if (spec == "none") return std::make_unique<NoDisplay>();
    if (spec.starts_with("png:"))
        return std::make_unique<PngDisplay>(spec.substr(4), std::move(cancel), policy);
    if (spec.starts_with("y4m:")) {
        if (!(rateHz >= 0.001 && rateHz <= 1e6))
            throw std::runtime_error(fmt::format(
                "y4m: the frame rate must be from 0.001 to 1000000 Hz, not {} Hz", rateHz));
        return std::make_unique<Y4mDisplay>(spec.substr(4), rateHz, std::move(cancel), policy);
    }
    throw std::runtime_error(
        fmt::format("unknown display '{}'; expected png:FOLDER, y4m:FILE, y4m:- or none", spec));
}

}  // namespace mfar
