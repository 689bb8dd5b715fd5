#include "daemon/banner.h"

#include "base/gl/gl.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace mfar {
namespace {

const cv::Scalar kBackground(24, 24, 24, 255), kLetters(255, 200, 64, 255);
constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;
constexpr double kLineShare = 1.0 / 24;  // height of a text line / height of the picture
constexpr double kLetterShare = 0.55;    // height of the font / height of a text line
constexpr int kMostLines = 4;
constexpr std::uint32_t kBlack = 0xff000000;

int widthOf(const std::string& text, double scale) {
    return cv::getTextSize(text, kFont, scale, 1, nullptr).width;
}

std::vector<std::string> broken(const std::string& text, double scale, int width) {
    std::vector<std::string> lines(1);
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
        const std::string word = text.substr(at, end - at);
        const bool wraps =
            (at > 0 && text[at - 1] == '\n') || widthOf(lines.back() + " " + word, scale) > width;
        if (lines.back().empty())
            lines.back() = word;
        else if (!wraps)
            lines.back() += " " + word;
        else if (lines.size() < kMostLines)
            lines.push_back(word);
        else
            break;
        at = end + 1;
    }
    return lines;
}

void copyTo(const gpu::Framebuffer& target, GLuint from, int y, Size size) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.id());
    glBlitFramebuffer(0, 0, size.width, size.height, 0, y, size.width, y + size.height,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void copyRows(Rows<const std::uint32_t> from, Rows<std::uint32_t> to, int y) {
    for (int row = 0; row < from.size.height; ++row)
        std::copy_n(from[row], from.size.width, to[y + row]);
}

}  // namespace

Picture Banner::over(const Picture& picture, const std::string& text) {
    if (text != text_) write(text);
    return picture.isOnHost() || picture.isEmpty() ? overRows(picture) : overTexture(picture);
}

Picture Banner::overRows(const Picture& picture) {
    if (rows_.size() != size_) rows_ = AlignedRows<std::uint32_t>(size_);
    if (!picture.isEmpty())
        copyRows(picture.rows(), rows_.rows(), 0);
    else
        for (int y = 0; y < size_.height; ++y)
            std::fill_n(rows_[y], size_.width, kBlack);
    copyRows(strip_.rows(), rows_.rows(), size_.height - strip_.size().height);
    return Rows<const std::uint32_t>(rows_.rows());
}

Picture Banner::overTexture(const Picture& picture) {
    if (texture_.id() == 0) {
        texture_ = gpu::Texture(size_, gpu::TexelFormat::Rgba8);
        target_ = gpu::Framebuffer(texture_);
    }
    if (!stripUploaded_) {
        stripTexture_ = gpu::Texture(strip_.size(), gpu::TexelFormat::Rgba8);
        const ImageView pixels = viewOf(strip_.rows());
        stripTexture_.upload({pixels.data, pixels.stride});
        stripTarget_ = gpu::Framebuffer(stripTexture_);
        stripUploaded_ = true;
    }
    GLuint source = 0;
    glGenFramebuffers(1, &source);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, source);
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                           picture.image().texture, 0);
    copyTo(target_, source, 0, size_);
    glDeleteFramebuffers(1, &source);
    copyTo(target_, stripTarget_.id(), size_.height - strip_.size().height, strip_.size());
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return GlImage{texture_.id(), size_};
}

void Banner::write(const std::string& text) {
    const int line = std::max(static_cast<int>(size_.height * kLineShare), 1);
    const double scale = cv::getFontScaleFromHeight(kFont, std::max(int(line * kLetterShare), 1));
    const std::vector<std::string> lines = broken(text, scale, size_.width - line);
    const int height = std::min(line * (int(lines.size()) + 1), size_.height);
    strip_ = AlignedRows<std::uint32_t>({size_.width, height});
    cv::Mat rgba(height, size_.width, CV_8UC4, strip_[0],
                 static_cast<std::size_t>(strip_.pitch()) * sizeof(std::uint32_t));
    rgba = kBackground;
    for (std::size_t i = 0; i < lines.size(); ++i)
        cv::putText(rgba, lines[i], {line / 2, static_cast<int>(line * (i + 1.25))}, kFont, scale,
                    kLetters, std::max(line / 16, 1), cv::LINE_AA);
    stripUploaded_ = false;
    text_ = text;
}

}  // namespace mfar
