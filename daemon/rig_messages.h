#pragma once

#include "daemon/log.h"
#include "hal/device/libcamera_log.h"

namespace mfar {

/// Logs libcamera's errors as warnings that begin with "libcamera:", as long as the returned object
/// lives. `log` must outlive it.
[[nodiscard]] inline LibcameraLog libcameraLogIn(Log& log) {
    return LibcameraLog([&log](const LibcameraMessage& message) {
        log.warning("libcamera: " + message.text, message.event);
    });
}

}  // namespace mfar
