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

// Interval of the checks for added and removed devices. A new device is used at most this time and
// one frame later.
constexpr std::chrono::milliseconds kLookEvery{500};
// A screen counts as working after it has shown this number of pictures. The first picture sets the
// mode. The third waits until the second is on the screen, which proves that the screen shows new
// pictures.
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
        // Without a screen, only this wait limits how many frames are queued for the GPU.
        (void)gpu::finishWithin();
        return;
    }
    try {
        active_->show(picture);
        shown_ = std::min(shown_ + 1, kProven);
        failed_ = nullptr;
        if (shown_ == kProven) fault_.clear();
    } catch (const gpu::GlError&) {
        throw;  // the GPU is at fault, not the screen
    } catch (const std::runtime_error& error) {
        lose(error.what());
    }
}

// While a screen has shown fewer than kProven pictures, an unchanged picture is shown again, so
// that the screen comes to count as working.
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

// While a screen works and no device has changed, only that screen is checked. The check of another
// screen would open its device.
Screen* ScreenDisplay::look(bool changed) {
    if (active_ != nullptr && !changed && active_->look(false) == Screen::Presence::Ready)
        return active_;
    if (changed) failed_ = nullptr;
    Screen* holder = nullptr;
    Screen* ready = nullptr;
    const auto ask = [&](Screen& screen) {
        const Screen::Presence presence = screen.look(true);
        if (presence != Screen::Presence::Absent) holder = &screen;
        if (presence == Screen::Presence::Ready) ready = &screen;
    };
    // If a device has no connected monitor, it is held open until a monitor is connected. The
    // devices after it in the list are not checked, because nobody would notice pictures there.
    for (const auto& screen : screens_)
        if (holder == nullptr && screen.get() != failed_) ask(*screen);
    if (holder == nullptr && failed_ != nullptr) ask(*failed_);
    for (const auto& screen : screens_)
        if (screen.get() != holder) screen->close();
    return ready;
}

std::string ScreenDisplay::name() const {
    if (active_ != nullptr) return active_->status();
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
    // All screens share one scaler, because compiling its shader is slow and a new screen should
    // show a picture at once.
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
