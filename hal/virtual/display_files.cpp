#include "hal/virtual/display_files.h"

#include "hal/virtual/background_writer.h"
#include "hal/virtual/image_files.h"
#include "hal/virtual/y4m.h"

#include <GLES3/gl31.h>
#include <fmt/format.h>

#include <unistd.h>

#include <filesystem>
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
    // Without this a renderer may queue frames without end, and no frame rate would be true.
    void show(const Picture& picture, Timestamp) override {
        if (!picture.isOnHost()) glFinish();
    }
    void finish() override {}
    [[nodiscard]] std::string name() const override { return "none"; }
};

/// Copies pictures into a few buffers and hands them to a writer.
class FileDisplay : public Display {
public:
    explicit FileDisplay(int threads) : writer_(threads) {}

    void show(const Picture& picture, Timestamp time) final {
        if (!pool_ || pool_->size() != picture.size()) {
            checkSize(picture.size());
            pool_.emplace(picture.size(), PixelFormat::Rgba8, kBuffers);
        }
        const FramePool::Slot slot = waitForBuffer();
        const auto loan = std::make_shared<Frame>(pool_->lend(slot, time));
        copyPicture(picture, slot.data, slot.stride);
        writer_.post([this, loan] { write(*loan); });
    }
    void finish() final { writer_.drain(); }

protected:
    /// Called on the thread of show() before the first picture of a size. Throws when it cannot be
    /// taken.
    virtual void checkSize(Size size) = 0;
    /// Called on a writer thread.
    virtual void write(const Frame& picture) = 0;
    /// Destructors of derived classes call this: the writer uses them.
    void finishQuietly() noexcept {
        try {
            writer_.drain();
        } catch (const std::exception&) {
            // finish() reports errors; here nobody is left to hear of one.
        }
    }

private:
    FramePool::Slot waitForBuffer() {
        for (;;) {
            if (const std::optional<std::string> error = writer_.error())
                throw std::runtime_error(*error);
            if (const auto slot = pool_->acquire(kErrorPoll)) return *slot;
        }
    }

    std::optional<FramePool> pool_;
    BackgroundWriter writer_;
};

class PngDisplay final : public FileDisplay {
public:
    explicit PngDisplay(fs::path folder) : FileDisplay(2), folder_(std::move(folder)) {
        if (folder_.empty()) throw std::runtime_error("png: needs a folder, png:DIR");
        std::error_code error;
        fs::create_directories(folder_, error);
        if (error)
            throw std::runtime_error(fmt::format("{}: {}", folder_.string(), error.message()));
        if (access(folder_.c_str(), W_OK | X_OK) != 0)
            throw std::runtime_error(folder_.string() + ": folder is not writable");
    }
    ~PngDisplay() override { finishQuietly(); }
    [[nodiscard]] std::string name() const override { return "png:" + folder_.string(); }

protected:
    void checkSize(Size) override {}
    void write(const Frame& picture) override {
        savePng(folder_ / fmt::format("{}.png", picture.time().ns), picture.view());
    }

private:
    fs::path folder_;
};

class Y4mDisplay final : public FileDisplay {
public:
    Y4mDisplay(std::string_view target, double rateHz, std::stop_token cancel)
        : FileDisplay(1), sink_(target, std::move(cancel)), rateHz_(rateHz) {}
    ~Y4mDisplay() override { finishQuietly(); }
    [[nodiscard]] std::string name() const override { return "y4m:" + sink_.name(); }

protected:
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
                                         std::stop_token cancel) {
    if (spec == "none") return std::make_unique<NoDisplay>();
    if (spec.starts_with("png:")) return std::make_unique<PngDisplay>(spec.substr(4));
    if (spec.starts_with("y4m:")) {
        if (!(rateHz >= 0.001 && rateHz < 1e6))
            throw std::runtime_error(
                fmt::format("y4m: a frame rate of {} Hz is impossible", rateHz));
        return std::make_unique<Y4mDisplay>(spec.substr(4), rateHz, std::move(cancel));
    }
    throw std::runtime_error(
        fmt::format("display '{}' is unknown: png:DIR, y4m:FILE, y4m:- or none", spec));
}

}  // namespace mfar
