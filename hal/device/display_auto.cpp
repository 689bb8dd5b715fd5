#include "hal/device/display_auto.h"

#include "base/gl/fence.h"
#include "hal/device/display_fbdev.h"
#include "hal/device/display_kms.h"
#include "hal/device/display_spec.h"
#include "hal/device/display_uevents.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace mfar {
namespace {

constexpr std::chrono::milliseconds kLookEvery{500};
constexpr std::chrono::seconds kRetryPreferred{5};
// Number of pictures after which a screen counts as working. The first picture sets the mode. The
// third waits until the second is on the screen, which proves that the screen shows new pictures.
constexpr int kProven = 3;

}  // namespace

ScreenDisplay::ScreenDisplay(std::unique_ptr<ScreenScaler> scaler,
                             std::vector<std::unique_ptr<Screen>> screens, Clock clock,
                             Events changed)
    : scaler_(std::move(scaler)), screens_(std::move(screens)), clock_(std::move(clock)),
      changed_(std::move(changed)) {}

ScreenDisplay::~ScreenDisplay() = default;

void ScreenDisplay::refresh() {
    const bool changed = changed_();
    const Timestamp now = clock_();
    if (!changed && lookedAt_ && now - *lookedAt_ < kLookEvery) return;
    lookedAt_ = now;
    Screen* found = look(changed);
    if (found != active_) shown_ = 0;
    active_ = found;
}

std::optional<Size> ScreenDisplay::screenSize() {
    refresh();
    if (active_ == nullptr) return std::nullopt;
    return active_->size();
}

void ScreenDisplay::show(const Picture& picture, Timestamp) {
    refresh();
    if (active_ == nullptr) {
        if (picture.isOnHost()) return;
        if (scaler_) scaler_->warmUp(picture.image());
        // Without a screen, only this wait limits the number of frames that are queued for the GPU.
        (void)gpu::finishWithin();
        return;
    }
    try {
        active_->show(picture);
        shown_ = std::min(shown_ + 1, kProven);
        if (active_ == failed_) failed_ = nullptr;
        if (shown_ == kProven) fault_.clear();
    } catch (const gpu::GlError&) {
        throw;
    } catch (const std::runtime_error& error) {
        lose(error.what());
    }
}

void ScreenDisplay::showAgain(const Picture& picture, Timestamp time) {
    refresh();
    if (active_ == nullptr || shown_ < kProven) show(picture, time);
}

void ScreenDisplay::releaseGl() {
    for (const auto& screen : screens_)
        screen->releaseGl();
    if (scaler_) scaler_->releaseGl();
    shown_ = 0;
}

void ScreenDisplay::lose(const std::string& why) {
    fault_ = why;
    failed_ = shown_ == kProven ? nullptr : active_;
    active_->close();
    active_ = nullptr;
}

// Returns true every few seconds while the most preferred device is not in use, e.g. because a boot
// screen or a desktop controls it. No event reports that such a program has ended.
bool ScreenDisplay::retriesPreferred() {
    const Timestamp now = clock_();
    if (active_ == screens_.front().get() || (retriedAt_ && now - *retriedAt_ < kRetryPreferred))
        return false;
    retriedAt_ = now;
    return true;
}

// Checking a screen opens its device. So while a screen works and no device has changed, no other
// screen is checked, unless retriesPreferred() returns true.
Screen* ScreenDisplay::look(bool changed) {
    if (active_ != nullptr && !changed && !retriesPreferred() &&
        active_->look(false) == Screen::Presence::Ready)
        return active_;
    if (changed) failed_ = nullptr;
    Screen* holder = nullptr;
    Screen* ready = nullptr;
    const auto ask = [&](Screen& screen) {
        const Screen::Presence presence = screen.look(true);
        if (presence != Screen::Presence::Absent) holder = &screen;
        if (presence == Screen::Presence::Ready) ready = &screen;
    };
    // A device without a connected monitor is held open until a monitor is connected. The later
    // devices in the list are not used meanwhile: they usually drive the same missing monitor.
    for (const auto& screen : screens_)
        if (holder == nullptr && screen.get() != failed_) ask(*screen);
    if (holder == nullptr && failed_ != nullptr) ask(*failed_);
    for (const auto& screen : screens_)
        if (screen.get() != holder) screen->close();
    return ready;
}

std::string ScreenDisplay::name() const {
    if (active_ != nullptr) {
        std::string preferred;
        for (const auto& screen : screens_) {
            if (screen.get() == active_) break;
            preferred += (preferred.empty() ? " (" : "; ") + screen->status();
        }
        return active_->status() + (preferred.empty() ? "" : preferred + ")");
    }
    std::string text = "no screen yet (" + fault_;
    for (const auto& screen : screens_)
        text += (text.ends_with('(') ? "" : "; ") + screen->status();
    return text + ")";
}

std::optional<std::string> ScreenDisplay::fault() const {
    if (active_ == nullptr) return name();
    if (!fault_.empty()) return fault_;
    return std::nullopt;
}

std::optional<ScreenPicture> ScreenDisplay::lastShown() const {
    if (active_ == nullptr) return std::nullopt;
    return active_->lastShown();
}

std::unique_ptr<ScreenDisplay> openScreen(std::string_view spec) {
    const ScreenSpec words = parseScreenSpec(spec);
    auto scaler = std::make_unique<ScreenScaler>();
    std::vector<std::unique_ptr<Screen>> screens;
    if (words.kind != ScreenSpec::Kind::Fbdev)
        screens.push_back(std::make_unique<KmsScreen>(words, *scaler));
    if (words.kind != ScreenSpec::Kind::Kms)
        screens.push_back(std::make_unique<FbdevScreen>(words.device, *scaler));
    return std::make_unique<ScreenDisplay>(
        std::move(scaler), std::move(screens), &Timestamp::now,
        [events = std::make_shared<DisplayEvents>()] { return events->changed(); });
}

}  // namespace mfar
