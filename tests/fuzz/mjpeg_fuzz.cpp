#include "base/image_layout.h"
#include "hal/device/jpeg_decoder.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mfar;
    static JpegDecoder decoder({32, 16}, 2);
    const std::optional<Frame> frame = decoder.decode({data, size}, Timestamp{1});
    if (frame) requireSound(frame->view(), "a decoded picture");
    return 0;
}
