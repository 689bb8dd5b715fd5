#pragma once

#include "base/image_view.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <turbojpeg.h>
#include <vector>

namespace mfar::test {

/// Encodes packed RGB pixels. `subsampling` is a TJSAMP of TurboJPEG.
inline std::vector<std::uint8_t> jpegOf(const std::vector<std::uint8_t>& rgb, Size size,
                                        int subsampling) {
    tjhandle handle = tjInitCompress();
    unsigned char* jpeg = nullptr;
    unsigned long bytes = 0;
    EXPECT_EQ(tjCompress2(handle, rgb.data(), size.width, 0, size.height, TJPF_RGB, &jpeg, &bytes,
                          subsampling, 95, 0),
              0);
    std::vector<std::uint8_t> out(jpeg, jpeg + bytes);
    tjFree(jpeg);
    tjDestroy(handle);
    return out;
}

}  // namespace mfar::test
