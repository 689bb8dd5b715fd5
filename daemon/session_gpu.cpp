#include "base/image_layout.h"
#include "daemon/exit_code.h"
#include "daemon/filter_learning.h"
#include "daemon/session.h"

#include <fmt/format.h>

#include <malloc.h>
#include <stdexcept>
#include <utility>

namespace mfar {

void Session::makeDrawing() {
    drawing_ = std::make_unique<Drawing>(config_, rig_.geometry(), output_, gl_.context);
    Pipeline& pipeline = drawing_->pipeline;
    if (quality_) pipeline.setQuality(*quality_);
    pipeline.setMatchListener(learning_.get());
    pipeline.setFilters(filters_);
    for (const std::optional<UsedStill>* still : {&secondStill_, &usedStill_})
        if (*still) pipeline.setStill((*still)->view, (*still)->time, (*still)->pose);
    placeObjects();
}

void Session::makeDrawingAnew(std::string why) {
    for (bool isMade = false; !isMade;) {
        const Timestamp begun = Timestamp::now();
        const bool isLast = failures_.add(begun, why);
        if (isLast && (config_.validate || device_ == GlDevice::Software))
            throw Failure(ExitCode::Internal, why);
        if (heart_ != nullptr) heart_->beat();
        drawing_.reset();
        display_->releaseGl();
        gl_ = {};
        // Gives free memory of the heap back to the system, because glibc would keep it: 45 of 157
        // MB in a measurement.
        malloc_trim(0);
        if (isLast) {
            config_.engine = {.use = EngineWish::Simd};
            device_ = GlDevice::Software;
        }
        stats_.gpuFailed(gpuFault());
        try {
            gl_ = openGl(config_, device_);
            if (!isLast && !gl_.without.empty()) throw std::runtime_error(gl_.without);
            makeDrawing();
            isMade = true;
        } catch (const std::runtime_error& error) {
            if (isLast) throw;
            why = error.what();
            continue;
        }
        const double ms = static_cast<double>((Timestamp::now() - begun).count()) * 1e-6;
        stats_.warn(fmt::format("{}; the restart took {:.0f} ms", *gpuFault(), ms),
                    {message::kGpu});
        stats_.rendering(rendering());
    }
}

std::optional<std::string> Session::gpuFault() {
    const auto now = drawing_ ? drawing_->gpu.fault() : std::nullopt;
    return now ? now : failures_.fault(Timestamp::now());
}

// Returns the text of the banner. A fault of a device is more important than a loss of the GPU.
std::string Session::bannerText() {
    if (const std::optional<std::string> fault = rig_.fault()) return *fault;
    return failures_.banner(Timestamp::now()).value_or("");
}

Rendering Session::rendering() const {
    Rendering out{describe(drawing_->engines),
                  gl_.context ? gl_.context->description() : "without OpenGL ES",
                  rig_.description()};
    const bool isRead = drawing_->engines.uses(EngineKind::Gles) && gl_.context->planeImporter();
    if (out.source.starts_with("cameras"))
        out.source += isRead ? ", read in place by the GPU" : ", copied";
    return out;
}

// Keeps a copy of the still for the report, and for a loss of the GPU. After a loss, the still is
// restored from this copy, because the next still may come late or never.
void Session::keepUsedStill(const CapturedStill& still) {
    const bool mayBeLost = gl_.context != nullptr;
    if (!mayBeLost && !stats_.keepsHistory()) return;
    std::swap(usedStill_, formerStill_);
    if (!usedStill_) usedStill_.emplace();
    const ImageView& view = still.frame.view();
    usedStill_->pixels.resize(packedBytes(view.format, view.size));
    usedStill_->view = packInto(usedStill_->pixels.data(), view);
    usedStill_->time = still.frame.time();
    usedStill_->pose = still.pose;
}

void Session::keepSecondStill() {
    const std::optional<Timestamp> second = drawing_->pipeline.secondStill();
    if (!second)
        secondStill_.reset();
    else if (formerStill_ && formerStill_->time == *second)
        std::swap(secondStill_, formerStill_);
}

}  // namespace mfar
