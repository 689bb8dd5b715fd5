#include "hal/device/jpeg_decoder.h"

#include "base/image_layout.h"

#include <stdexcept>
#include <string_view>
#include <turbojpeg.h>

namespace mfar {
namespace {

/// Replaces each pair of rows of a plane by the mean of the two. `rows` is the number of pairs.
void halveRows(std::uint8_t* plane, std::size_t rowBytes, int rows) {
    for (int y = 0; y < rows; ++y) {
        std::uint8_t* to = plane + y * rowBytes;
        const std::uint8_t* a = plane + 2UL * y * rowBytes;
        for (std::size_t x = 0; x < rowBytes; ++x)
            to[x] = static_cast<std::uint8_t>((a[x] + a[x + rowBytes] + 1) / 2);
    }
}

// Returns true if the decoder's last message only reports extra bytes before the end marker of a
// picture. Many cameras add such padding, and the picture is complete.
bool harmless(void* handle) {
    return std::string_view(tjGetErrorStr2(handle)).find("before marker 0xd9") !=
           std::string_view::npos;
}

bool known(int subsampling) {
    return subsampling == TJSAMP_420 || subsampling == TJSAMP_422 || subsampling == TJSAMP_GRAY;
}

}  // namespace

void JpegDecoder::Close::operator()(void* handle) const {
    tjDestroy(handle);
}

JpegDecoder::JpegDecoder(Size size, int buffers) : pool_(size, PixelFormat::Yuyv, buffers) {
    if (size.width % 2 != 0 || size.height % 2 != 0 || size.width <= 0 || size.height <= 0)
        throw std::invalid_argument("width and height of JPEG pictures must be even");
    renew();
}

// Creates the library's decoder anew, because after an error it may be in the middle of a picture.
void JpegDecoder::renew() {
    handle_.reset(tjInitDecompress());
    if (!handle_) throw std::runtime_error("the JPEG decoder cannot be set up");
}

std::optional<int> JpegDecoder::subsamplingOf(std::span<const std::uint8_t> jpeg) {
    Size size;
    int subsampling = 0, colours = 0;
    if (tjDecompressHeader3(handle_.get(), jpeg.data(), jpeg.size(), &size.width, &size.height,
                            &subsampling, &colours) != 0) {
        renew();
        return std::nullopt;
    }
    if (size != pool_.size() || !known(subsampling)) return std::nullopt;
    return subsampling;
}

bool JpegDecoder::decodeInto(std::span<const std::uint8_t> jpeg,
                             std::array<std::uint8_t*, 3> planes) {
    const Size size = pool_.size();
    std::array<int, 3> strides{size.width, size.width / 2, size.width / 2};
    if (tjDecompressToYUVPlanes(handle_.get(), jpeg.data(), jpeg.size(), planes.data(), size.width,
                                strides.data(), size.height,
                                TJFLAG_FASTDCT | TJFLAG_LIMITSCANS) == 0 ||
        harmless(handle_.get()))
        return true;
    renew();
    return false;
}

std::optional<Frame> JpegDecoder::decode(std::span<const std::uint8_t> jpeg, Timestamp time) {
    isFull_ = false;
    const auto subsampling = subsamplingOf(jpeg);
    if (!subsampling) return std::nullopt;
    const auto slot = pool_.acquire(std::chrono::milliseconds(0));
    isFull_ = !slot;
    if (isFull_) return std::nullopt;
    const Size size = pool_.size();
    const auto width = static_cast<std::size_t>(size.width), half = width / 2;
    const auto height = static_cast<std::size_t>(size.height);
    const std::size_t chromaRows = *subsampling == TJSAMP_422 ? height : height / 2;
    const std::array<std::uint8_t*, 3> planes{slot->data, slot->data + width * height,
                                              slot->data + width * height + half * chromaRows};
    if (!decodeInto(jpeg, planes)) {
        pool_.giveBack(*slot);
        return std::nullopt;
    }
    if (*subsampling == TJSAMP_422)
        for (std::size_t i = 1; i < planes.size(); ++i)
            halveRows(planes[i], half, size.height / 2);
    ImageView view{slot->data, size, width, PixelFormat::Gray8};
    view.range = YuvRange::Full;
    if (*subsampling != TJSAMP_GRAY) {
        view.format = PixelFormat::Yuv420;
        view.chroma = {PlaneView{planes[1], half}, PlaneView{planes[2], half}};
    }
    return pool_.lend(*slot, view, time);
}

}  // namespace mfar
