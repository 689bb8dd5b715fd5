#include "base/whole_file.h"
#include "hal/virtual/image_files.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>

namespace mfar {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little);

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kFloMagic = 202021.25F;
constexpr float kFloUnknownAbove = 1e9F;
constexpr float kFloUnknown = 1e10F;

std::string wholeFile(const fs::path& file) {
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) throw ImageFileError(file, "is missing");
    std::ifstream in(file, std::ios::binary);
    if (!in) throw ImageFileError(file, "cannot be read");
    return {std::istreambuf_iterator<char>(in), {}};
}

void checkSize(const fs::path& file, Size size) {
    if (size.width < 1 || size.height < 1 || size.width > kMaxImageSide ||
        size.height > kMaxImageSide)
        throw ImageFileError(
            file, fmt::format("size {}x{} is invalid: width and height must be from 1 to {}",
                              size.width, size.height, kMaxImageSide));
}

void checkBytes(const fs::path& file, std::size_t got, std::size_t needed) {
    if (got != needed)
        throw ImageFileError(file,
                             fmt::format("has {} bytes of pixel values; expected {}", got, needed));
}

std::size_t pixelCount(Size size) {
    return static_cast<std::size_t>(size.width) * size.height;
}

/// Parses the header of a PFM file: the letters "Pf", width, height and scale, followed by one
/// white space.
class PfmHeader {
public:
    PfmHeader(const fs::path& file, std::string_view text) : file_(file), text_(text) {
        if (const std::string_view magic = word(); magic != "Pf")
            throw ImageFileError(file_, magic == "PF" ? "is a colour PFM file; expected one channel"
                                                      : "is not a PFM file");
        number(size.width);
        number(size.height);
        number(scale);
        ++at_;
        checkSize(file_, size);
        if (!std::isfinite(scale) || scale == 0)
            throw ImageFileError(file_, "the scale in the PFM header is 0 or not finite");
    }
    [[nodiscard]] std::string_view values() const {
        return at_ < text_.size() ? text_.substr(at_) : std::string_view{};
    }

    Size size;
    double scale = 0;

private:
    static bool isSpace(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
    std::string_view word() {
        while (at_ < text_.size() && isSpace(text_[at_]))
            ++at_;
        const std::size_t first = at_;
        while (at_ < text_.size() && !isSpace(text_[at_]) && at_ - first < 40)
            ++at_;
        return text_.substr(first, at_ - first);
    }
    template <class T>
    void number(T& value) {
        const std::string_view w = word();
        const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), value);
        if (error != std::errc{} || end != w.data() + w.size())
            throw ImageFileError(file_, "the PFM header is malformed");
    }

    const fs::path& file_;
    std::string_view text_;
    std::size_t at_ = 0;
};

float readFloat(const char* p, bool bigEndian) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, p, sizeof bits);
    if (bigEndian) bits = __builtin_bswap32(bits);
    return std::bit_cast<float>(bits);
}

void save(const fs::path& file, const std::string& content) {
    try {
        writeWholeFile(file, content, Durability::WithSync);
    } catch (const std::runtime_error& e) {
        throw ImageFileError(e.what());
    }
}

}  // namespace

FloatImage loadPfm(const fs::path& file) {
    const std::string text = wholeFile(file);
    const PfmHeader header(file, text);
    const std::string_view bytes = header.values();
    checkBytes(file, bytes.size(), pixelCount(header.size) * sizeof(float));
    FloatImage out{header.size, std::vector<float>(pixelCount(header.size))};
    const char* p = bytes.data();
    for (int y = header.size.height - 1; y >= 0; --y)  // PFM files begin with the bottom row
        for (int x = 0; x < header.size.width; ++x, p += sizeof(float)) {
            const float v = readFloat(p, header.scale > 0);
            out.at(x, y) = std::isfinite(v) ? v : kNaN;
        }
    return out;
}

void savePfm(const fs::path& file, const FloatImage& image) {
    std::string out = fmt::format("Pf\n{} {}\n-1\n", image.size.width, image.size.height);
    out.reserve(out.size() + image.values.size() * sizeof(float));
    for (int y = image.size.height - 1; y >= 0; --y)
        for (int x = 0; x < image.size.width; ++x) {
            const float v = std::isfinite(image.at(x, y)) ? image.at(x, y) : kNaN;
            out.append(reinterpret_cast<const char*>(&v), sizeof v);
        }
    save(file, out);
}

FlowImage loadFlo(const fs::path& file) {
    constexpr std::size_t kHeader = 12;
    const std::string text = wholeFile(file);
    if (text.size() < kHeader || readFloat(text.data(), false) != kFloMagic)
        throw ImageFileError(file, "is not a .flo file");
    FlowImage out;
    std::memcpy(&out.size.width, text.data() + 4, 4);
    std::memcpy(&out.size.height, text.data() + 8, 4);
    checkSize(file, out.size);
    const std::size_t count = pixelCount(out.size);
    checkBytes(file, text.size() - kHeader, count * 2 * sizeof(float));
    out.vectors.resize(count);
    std::memcpy(out.vectors.data(), text.data() + kHeader, count * 2 * sizeof(float));
    for (auto& v : out.vectors)
        if (!(std::abs(v[0]) <= kFloUnknownAbove && std::abs(v[1]) <= kFloUnknownAbove))
            v = {kNaN, kNaN};
    return out;
}

void saveFlo(const fs::path& file, const FlowImage& image) {
    std::string out;
    out.reserve(12 + image.vectors.size() * 2 * sizeof(float));
    out.append(reinterpret_cast<const char*>(&kFloMagic), 4);
    out.append(reinterpret_cast<const char*>(&image.size.width), 4);
    out.append(reinterpret_cast<const char*>(&image.size.height), 4);
    for (std::array<float, 2> v : image.vectors) {
        if (!std::isfinite(v[0]) || !std::isfinite(v[1])) v = {kFloUnknown, kFloUnknown};
        out.append(reinterpret_cast<const char*>(v.data()), sizeof v);
    }
    save(file, out);
}

}  // namespace mfar
