#include "hal/image_codec.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>
#include <memory>
#include <png.h>
#include <stdexcept>
#include <string>
#include <turbojpeg.h>
#include <zlib.h>

namespace mfar {
namespace {

constexpr std::int64_t kMostProgressive = 1 << 24;
constexpr std::size_t kMostHeader = 4096;

// libpng requires that its error function does not return, so fail() uses longjmp(). The functions
// that call libpng must not have objects with destructors, which longjmp() would skip.
struct PngError {
    std::jmp_buf back;
    std::string text;
};

[[noreturn]] void fail(png_structp png, png_const_charp text) {
    auto* error = static_cast<PngError*>(png_get_error_ptr(png));
    error->text = text;
    std::longjmp(error->back, 1);
}

void ignore(png_structp /*png*/, png_const_charp /*text*/) {}

struct PngReader {
    PngReader() : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &error, fail, ignore)) {
        if (png != nullptr) info = png_create_info_struct(png);
        if (info == nullptr) throw std::runtime_error("libpng cannot allocate memory");
    }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
    ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }

    PngError error;
    png_structp png;
    png_infop info = nullptr;
};

struct PngWriter {
    PngWriter() : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, &error, fail, ignore)) {
        if (png != nullptr) info = png_create_info_struct(png);
        if (info == nullptr) throw std::runtime_error("libpng cannot allocate memory");
    }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;
    ~PngWriter() { png_destroy_write_struct(&png, &info); }

    PngError error;
    png_structp png;
    png_infop info = nullptr;
};

void readBytes(png_structp png, png_bytep to, std::size_t count) {
    auto* left = static_cast<std::span<const std::uint8_t>*>(png_get_io_ptr(png));
    if (count > left->size()) png_error(png, "the file ends before the last pixel");
    std::memcpy(to, left->data(), count);
    *left = left->subspan(count);
}

void appendBytes(png_structp png, png_bytep from, std::size_t count) {
    auto* out = static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
    out->insert(out->end(), from, from + count);
}

void flushNothing(png_structp /*png*/) {}

bool readHeader(PngReader& reader, std::span<const std::uint8_t>& left, ImageAlpha alpha) {
    if (setjmp(reader.error.back) != 0) return false;
    // Text chunks are skipped, because a chunk of 8 kB may be decompressed to 8 MB.
    png_set_keep_unknown_chunks(reader.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_set_read_fn(reader.png, &left, readBytes);
    png_read_info(reader.png, reader.info);
    png_set_expand(reader.png);
    png_set_strip_16(reader.png);
    png_set_gray_to_rgb(reader.png);
    if (alpha == ImageAlpha::Opaque) png_set_strip_alpha(reader.png);
    png_set_filler(reader.png, 255, PNG_FILLER_AFTER);
    png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
    return true;
}

bool readRows(PngReader& reader, png_bytepp rows) {
    if (setjmp(reader.error.back) != 0) return false;
    png_read_image(reader.png, rows);
    png_read_end(reader.png, nullptr);
    return true;
}

std::vector<png_bytep> rowsOf(const std::uint8_t* first, std::size_t stride, int count) {
    std::vector<png_bytep> rows(static_cast<std::size_t>(count));
    for (std::size_t y = 0; y < rows.size(); ++y)
        rows[y] = const_cast<png_bytep>(first + y * stride);
    return rows;
}

bool isPng(std::span<const std::uint8_t> file) {
    return file.size() >= 8 && png_sig_cmp(file.data(), 0, 8) == 0;
}

bool isJpeg(std::span<const std::uint8_t> file) {
    return file.size() >= 3 && file[0] == 0xff && file[1] == 0xd8 && file[2] == 0xff;
}

void decodePng(std::span<const std::uint8_t> file, const TargetOf& targetOf, ImageAlpha alpha) {
    PngReader reader;
    if (!readHeader(reader, file, alpha)) throw std::runtime_error(reader.error.text);
    const Size size{static_cast<int>(png_get_image_width(reader.png, reader.info)),
                    static_cast<int>(png_get_image_height(reader.png, reader.info))};
    const PixelTarget target = targetOf(size);
    std::vector<png_bytep> rows = rowsOf(target.rgba, target.stride, size.height);
    if (!readRows(reader, rows.data())) throw std::runtime_error(reader.error.text);
}

/// Returns true if a JPEG is progressive (ITU T.81, frame SOF2 and others). The decoder keeps all
/// coefficients of a progressive JPEG in memory, up to six bytes per pixel.
bool isProgressive(std::span<const std::uint8_t> file) {
    constexpr std::uint8_t kStartOfScan = 0xda;
    for (std::size_t at = 2; at + 4 <= file.size() && file[at] == 0xff;) {
        const std::uint8_t marker = file[at + 1];
        if (marker == 0xc2 || marker == 0xc6 || marker == 0xca || marker == 0xce) return true;
        if (marker == kStartOfScan) return false;
        if (marker == 0xff)
            ++at;  // any number of bytes 0xff may precede a marker
        else if (marker == 0x01 || (marker >= 0xd0 && marker <= 0xd7))
            at += 2;  // these markers have no length
        else
            at += 2 + (std::size_t{file[at + 2]} << 8U | file[at + 3]);
    }
    return false;
}

void decodeJpeg(std::span<const std::uint8_t> file, const TargetOf& targetOf) {
    const std::unique_ptr<void, decltype(&tjDestroy)> decoder(tjInitDecompress(), tjDestroy);
    if (!decoder) throw std::runtime_error(tjGetErrorStr2(nullptr));
    Size size;
    int sampling = 0, space = 0;
    if (tjDecompressHeader3(decoder.get(), file.data(), file.size(), &size.width, &size.height,
                            &sampling, &space) != 0)
        throw std::runtime_error(tjGetErrorStr2(decoder.get()));
    if (std::int64_t{size.width} * size.height > kMostProgressive && isProgressive(file))
        throw std::runtime_error("a progressive JPEG may have at most 16.8 million pixels");
    const PixelTarget target = targetOf(size);
    // A warning of the decoder counts as an error, because it means that data are damaged or
    // missing.
    if (tjDecompress2(decoder.get(), file.data(), file.size(), target.rgba, size.width,
                      static_cast<int>(target.stride), size.height, TJPF_RGBA,
                      TJFLAG_LIMITSCANS) != 0)
        throw std::runtime_error(tjGetErrorStr2(decoder.get()));
}

// Only one PNG filter and run-length coding are used. This takes 8 ms for 648x432 pixels. zlib's
// default strategy at the same level 1 takes 22 ms, and its files of photographs are no smaller.
bool write(PngWriter& writer, Size size, PixelBytes format, png_bytepp rows,
           std::vector<std::uint8_t>& out) {
    if (setjmp(writer.error.back) != 0) return false;
    png_set_write_fn(writer.png, &out, appendBytes, flushNothing);
    png_set_compression_level(writer.png, Z_BEST_SPEED);
    png_set_compression_strategy(writer.png, Z_RLE);
    png_set_filter(writer.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(size.width),
                 static_cast<png_uint_32>(size.height), 8,
                 format == PixelBytes::Grey ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(writer.png, writer.info);
    if (format == PixelBytes::Rgbx || format == PixelBytes::Bgrx)
        png_set_filler(writer.png, 0, PNG_FILLER_AFTER);
    if (format == PixelBytes::Bgr || format == PixelBytes::Bgrx) png_set_bgr(writer.png);
    png_write_image(writer.png, rows);
    png_write_end(writer.png, writer.info);
    return true;
}

}  // namespace

bool isPngOrJpeg(std::span<const std::uint8_t> file) {
    return isPng(file) || isJpeg(file);
}

void decodeImage(std::span<const std::uint8_t> file, const TargetOf& targetOf, ImageAlpha alpha) {
    if (isPng(file)) return decodePng(file, targetOf, alpha);
    if (isJpeg(file)) return decodeJpeg(file, targetOf);
    throw std::runtime_error("is neither PNG nor JPEG");
}

void encodePng(const std::uint8_t* pixels, std::size_t stride, Size size, PixelBytes format,
               std::vector<std::uint8_t>& out) {
    out.clear();
    // Reserves enough memory for any picture, because a growing vector would copy the data several
    // times. Pages that stay unused occupy no memory.
    out.reserve(std::size_t{4} * size.width * size.height + kMostHeader);
    PngWriter writer;
    std::vector<png_bytep> rows = rowsOf(pixels, stride, size.height);
    if (!write(writer, size, format, rows.data(), out))
        throw std::runtime_error("the picture cannot be encoded as PNG: " + writer.error.text);
}

std::vector<std::uint8_t> encodeJpeg(const std::uint8_t* pixels, std::size_t stride, Size size,
                                     PixelBytes format, int quality) {
    const std::unique_ptr<void, decltype(&tjDestroy)> encoder(tjInitCompress(), tjDestroy);
    if (!encoder) throw std::runtime_error(tjGetErrorStr2(nullptr));
    constexpr std::array kFormats{TJPF_GRAY, TJPF_BGR, TJPF_RGBX, TJPF_BGRX};
    const int sampling = format == PixelBytes::Grey ? TJSAMP_GRAY : TJSAMP_420;
    unsigned char* bytes = nullptr;
    unsigned long count = 0;
    const int failed = tjCompress2(encoder.get(), pixels, size.width, static_cast<int>(stride),
                                   size.height, kFormats[static_cast<std::size_t>(format)], &bytes,
                                   &count, sampling, quality, 0);
    const std::unique_ptr<unsigned char, decltype(&tjFree)> owned(bytes, tjFree);
    if (failed != 0)
        throw std::runtime_error(std::string("cannot be encoded: ") +
                                 tjGetErrorStr2(encoder.get()));
    return {bytes, bytes + count};
}

}  // namespace mfar
