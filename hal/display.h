#pragma once

#include "hal/frame.h"
#include "hal/time.h"

#include <string>

namespace mfar {

/// A finished picture in the current GL context: RGBA8 2-D texture, row 0 = top row of the picture.
struct GlImage {
    unsigned texture = 0;
    Size size;
};

/// Where finished pictures go. Called on the GL thread with the pipeline's context current.
class Display {
public:
    virtual ~Display() = default;

    /// Shows the picture (or queues it for that). May wait for the device's pace; must not keep the
    /// texture after returning. Throws std::runtime_error when the device is lost.
    virtual void show(const GlImage& image, Timestamp time) = 0;
    /// Blocks until everything shown is out (files written). Throws like show().
    virtual void finish() = 0;
    [[nodiscard]] virtual std::string name() const = 0;
};

}  // namespace mfar
