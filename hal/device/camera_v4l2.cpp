#include "hal/device/camera_v4l2.h"

#include "base/image_layout.h"
#include "hal/device/v4l2_selection.h"

#include <fmt/format.h>

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <stdexcept>
#include <thread>

namespace mfar {
namespace {

using std::chrono::nanoseconds;
using std::chrono::steady_clock;

// A frame's timestamp may be up to kAhead in the future, because the clocks of CPU cores differ. It
// may be up to kOldest in the past, because a frame waits in the driver until next() is called.
constexpr nanoseconds kAhead = std::chrono::milliseconds(50), kOldest = std::chrono::seconds(10);
constexpr std::chrono::milliseconds kTroublePause{5};

/// If the driver grants fewer buffers than this and fewer than requested, every picture is copied,
/// and its buffer is given back at once. Without the copy, users could hold all buffers, and the
/// driver would have none to fill.
constexpr int kEnoughBuffers = 4;

class Loan {
public:
    Loan(std::shared_ptr<V4l2Stream> stream, int index)
        : stream_(std::move(stream)), index_(index) {}
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    ~Loan() { stream_->giveBack(index_); }

private:
    std::shared_ptr<V4l2Stream> stream_;
    int index_;
};

V4l2Layout negotiated(const V4l2Device& device, const V4l2Wish& wish) {
    if (wish.size.width < 1 || wish.size.height < 1)
        throw std::runtime_error(device.path() + ": the picture size must be at least 1x1");
    if (!(wish.rateHz >= 0 && wish.rateHz <= 1e4))
        throw std::runtime_error(
            fmt::format("{}: the frame rate must be from 0 to 10000 Hz, not {} Hz", device.path(),
                        wish.rateHz));
    return setFormat(device, chooseFormat(device, wish), wish.size);
}

std::string nameOf(const V4l2Device& device) {
    return fmt::format("{} ({})", device.card(), device.path());
}

}  // namespace

CameraV4l2::CameraV4l2(const CameraV4l2Options& options, V4l2Api& api) : options_(options) {
    V4l2Device device = openCapture(api, options.device);
    layout_ = negotiated(device, options.wish);
    const double rate = setRate(device, options.wish.rateHz);
    info_ = {nameOf(device), layout_.size, layout_.format.picture,
             rate > 0 ? rate : options.wish.rateHz};
    stream_ = std::make_shared<V4l2Stream>(std::move(device), layout_, options.buffers);
    controls_ = std::make_unique<V4l2Controls>(stream_->device());
    for (const auto& [name, value] : options.controls)
        controls_->set(name, value);
    if (layout_.format.jpeg)
        decoder_ = std::make_unique<JpegDecoder>(layout_.size, options.buffers);
    if (!decoder_ && stream_->buffers() < std::min(options.buffers, kEnoughBuffers)) {
        copies_.emplace(layout_.size, layout_.format.picture, options.buffers);
        warnings_.push_back(fmt::format(
            "{}: the driver allocated only {} of {} buffers, so every picture is copied",
            stream_->device().path(), stream_->buffers(), options.buffers));
    }
    wake_ = OwnedFd(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
    if (wake_.get() < 0)
        throw std::runtime_error("eventfd() failed: too many open files or no memory");
}

CameraV4l2::~CameraV4l2() {
    stop();
    stream_->close();
}

void CameraV4l2::start() {
    if (running_) return;
    std::uint64_t drained = 0;
    static_cast<void>(!read(wake_.get(), &drained, sizeof drained));
    exposure_ = manualExposure();
    drops_.pause();
    stream_->start();
    running_ = true;
}

void CameraV4l2::stop() {
    running_ = false;
    constexpr std::uint64_t kOne = 1;
    // wake_ is written before the stream stops, because wait() must find wake_ readable when the
    // stopped device reports an error.
    static_cast<void>(!write(wake_.get(), &kOne, sizeof kOne));
    stream_->stop();
}

std::optional<Frame> CameraV4l2::next(std::chrono::milliseconds timeout) {
    const auto until = steady_clock::now() + timeout;
    int broken = 0;
    while (running_) {
        stream_->takeBack();
        const Wait waited = wait(until);
        if (waited == Wait::Nothing) return std::nullopt;
        if (waited == Wait::Buffer) continue;
        const auto filled = stream_->take();
        if (filled) {
            if (auto frame = frameOf(*filled)) return frame;
            // After a broken picture, further filled buffers are taken even if the timeout has
            // passed, because they may hold whole pictures. After as many broken pictures as there
            // are buffers, the timeout ends the search, because the driver may never deliver whole
            // pictures.
            if (++broken >= stream_->buffers() && steady_clock::now() >= until) return std::nullopt;
        } else if (waited == Wait::Trouble) {
            // The device is not lost; otherwise take() would have thrown. Drivers also set POLLERR
            // if no buffer is queued, which happens while users hold all pictures.
            if (steady_clock::now() >= until) return std::nullopt;
            std::this_thread::sleep_for(kTroublePause);
        }
    }
    return std::nullopt;
}

CameraV4l2::Wait CameraV4l2::wait(steady_clock::time_point until) const {
    // wake_ is checked first, because the device also reports an error after stop().
    std::array<pollfd, 3> fds{pollfd{stream_->device().fd(), POLLIN, 0},
                              pollfd{wake_.get(), POLLIN, 0},
                              pollfd{stream_->givenBack(), POLLIN, 0}};
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - steady_clock::now());
    const int ready =
        poll(fds.data(), fds.size(), static_cast<int>(std::max<std::int64_t>(left.count(), 0)));
    if (ready < 0 && errno == EINTR) return Wait::Picture;
    if (ready <= 0 || fds[1].revents != 0) return Wait::Nothing;
    if (fds[0].revents == 0) return Wait::Buffer;
    return (fds[0].revents & (POLLERR | POLLHUP | POLLNVAL)) != 0 ? Wait::Trouble : Wait::Picture;
}

std::optional<Frame> CameraV4l2::frameOf(const V4l2Filled& filled) {
    const auto loan = std::make_shared<Loan>(stream_, filled.index);
    const bool whole = isWhole(filled);
    const auto time = timeOf(filled);
    // A triggered camera has no frame rate, so the times of its frames do not show drops.
    if (whole && time && options_.wish.rateHz > 0)
        drops_.add(*time, filled.sequence);
    else
        drops_.addUntimed(filled.sequence);
    if (!whole) return refuse(&CameraCounters::broken);
    if (!time) return refuse(&CameraCounters::badTimes);
    auto memory = stream_->memory(filled.index);
    for (std::size_t i = 0; i < memory.size(); ++i)
        if (memory[i] != nullptr) memory[i] += filled.offset[i];
    std::optional<Frame> out;
    if (decoder_) {
        out = decoder_->decode({memory[0], filled.bytes[0] - filled.offset[0]}, *time);
    } else {
        ImageView view = layout_.view(memory);
        const bool atBegin = filled.offset == decltype(filled.offset){};
        view.shared = atBegin ? stream_->shared(filled.index) : nullptr;
        if (copies_)
            out = copyOf(view, *time);
        else
            out.emplace(view, *time, [loan] {});
    }
    if (!out && (copies_ || (decoder_ && decoder_->isFull()))) {
        drops_.lose();
        return refuse(nullptr);
    }
    if (!out) return refuse(&CameraCounters::broken);
    out->exposure = exposure_;
    last_ = time;
    count(&CameraCounters::delivered);
    return out;
}

std::optional<Frame> CameraV4l2::copyOf(const ImageView& view, Timestamp time) {
    const auto slot = copies_->acquire(std::chrono::milliseconds(0));
    if (!slot) return std::nullopt;
    ImageView copy = packInto(slot->data, view);
    copy.shared = nullptr;
    return copies_->lend(*slot, copy, time);
}

bool CameraV4l2::isWhole(const V4l2Filled& filled) const {
    if ((filled.flags & V4L2_BUF_FLAG_ERROR) != 0) return false;
    for (int p = 0; p < layout_.memoryPlanes; ++p) {
        const auto i = static_cast<std::size_t>(p);
        // `bytes` (V4L2's bytesused) includes the data offset.
        const std::size_t room = stream_->memoryBytes(filled.index, p);
        if (filled.bytes[i] > room || filled.offset[i] >= filled.bytes[i] ||
            filled.bytes[i] - filled.offset[i] < layout_.bytes[i])
            return false;
    }
    return true;
}

std::optional<Timestamp> CameraV4l2::timeOf(const V4l2Filled& filled) {
    constexpr std::int64_t kMostSeconds = 1'000'000'000;
    if (filled.seconds < 0 || filled.seconds > kMostSeconds || filled.microseconds < 0 ||
        filled.microseconds >= 1'000'000)
        return std::nullopt;
    const Timestamp stamp{filled.seconds * 1'000'000'000 + filled.microseconds * 1000};
    const nanoseconds age = Timestamp::now() - stamp;
    if (age < -kAhead || age > kOldest) return std::nullopt;
    const bool begin =
        (filled.flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
    const Timestamp out = stamp + (begin ? exposure_ / 2 : -exposure_ / 2) + options_.timeOffset;
    if (last_ && out <= *last_) return std::nullopt;
    return out;
}

// Returns the exposure time, or 0 if it is automatic or unknown.
nanoseconds CameraV4l2::manualExposure() const {
    try {
        return readExposure();
    } catch (const DeviceLost&) {
        throw;
    } catch (const std::runtime_error&) {
        // Some cameras list a control that cannot be read. Their pictures can be used all the same.
        return nanoseconds(0);
    }
}

// Drivers use different names for the controls of the exposure. V4L2's unit of exposure is 100 us.
nanoseconds CameraV4l2::readExposure() const {
    constexpr std::int64_t kMost = 100'000;
    for (const char* name : {"auto_exposure", "exposure_auto"}) {
        if (controls_->find(name) == nullptr) continue;
        // At shutter priority, only the iris is automatic.
        const std::int64_t mode = controls_->get(name);
        if (mode != V4L2_EXPOSURE_MANUAL && mode != V4L2_EXPOSURE_SHUTTER_PRIORITY)
            return nanoseconds(0);
    }
    for (const char* name : {"exposure_time_absolute", "exposure_absolute"})
        if (controls_->find(name) != nullptr)
            return std::chrono::microseconds(
                100 * std::clamp<std::int64_t>(controls_->get(name), 0, kMost));
    return nanoseconds(0);
}

std::nullopt_t CameraV4l2::refuse(std::uint64_t CameraCounters::* why) {
    count(why);
    return std::nullopt;
}

void CameraV4l2::count(std::uint64_t CameraCounters::* what) {
    const std::lock_guard lock(countsMutex_);
    if (what != nullptr) ++(counts_.*what);
    counts_.missed = drops_.dropped();
}

CameraCounters CameraV4l2::cameraCounters() const {
    const std::lock_guard lock(countsMutex_);
    return counts_;
}

std::vector<std::string> CameraV4l2::takeWarnings() {
    const std::lock_guard lock(countsMutex_);
    return std::exchange(warnings_, {});
}

std::string chosenV4l2(const CameraWish& wish, V4l2Api& api) {
    return nameOf(openCapture(api, wish));
}

}  // namespace mfar
