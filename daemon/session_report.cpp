
#include "daemon/session.h"
#include "daemon/thumbnail.h"

#include <stdexcept>

namespace mfar {

// If a picture cannot be read from the GPU, mfard only warns, so that the run still succeeds.
void Session::leavePictures() {
    if (!stats_.keepsHistory()) return;
    RunPictures pictures;
    try {
        if (drawing_->shown) pictures.frame = thumbnail(copyOf(*drawing_->shown).view());
        if (usedStill_) pictures.still = thumbnail(usedStill_->view);
    } catch (const std::runtime_error& error) {
        stats_.warn(std::string("the report has no picture: ") + error.what());
    }
    stats_.pictures(std::move(pictures));
}

}  // namespace mfar
