#include "daemon/banner.h"

#include "base/gl/gl.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace mfar {
namespace {

const cv::Scalar kBackground(24, 24, 24, 255), kLetters(255, 200, 64, 255);
constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;
constexpr double kLineShare = 1.0 / 24;  // of the picture's height
constexpr double kLetterShare = 0.55;    // of a line's height
constexpr int kMostLines = 4;

int widthOf(const std::string& text, double scale) {
    return cv::getTextSize(text, kFont, scale, 1, nullptr).width;
}

/// Breaks between words; what does not fit into the last line is cut off.
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

void copyTo(const gpu::Framebuffer& target, const gpu::Framebuffer& from, int y, Size size) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.id());
    glBlitFramebuffer(0, 0, size.width, size.height, 0, y, size.width, y + size.height,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

}  // namespace

GlImage Banner::over(const GlImage& picture, const std::string& text) {
    if (picture_.id() == 0) {
        picture_ = gpu::Texture(size_, gpu::TexelFormat::Rgba8);
        pictureTarget_ = gpu::Framebuffer(picture_);
    }
    if (text != text_) write(text);
    if (picture.texture != 0) {
        GLuint source = 0;
        glGenFramebuffers(1, &source);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, source);
        glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                               picture.texture, 0);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, pictureTarget_.id());
        glBlitFramebuffer(0, 0, size_.width, size_.height, 0, 0, size_.width, size_.height,
                          GL_COLOR_BUFFER_BIT, GL_NEAREST);
        glDeleteFramebuffers(1, &source);
    } else {
        pictureTarget_.bind();
        glClearColor(0, 0, 0, 1);
        glClear(GL_COLOR_BUFFER_BIT);
    }
    copyTo(pictureTarget_, stripTarget_, size_.height - strip_.size().height, strip_.size());
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return {picture_.id(), size_};
}

void Banner::write(const std::string& text) {
    const int line = std::max(static_cast<int>(size_.height * kLineShare), 1);
    const double scale = cv::getFontScaleFromHeight(kFont, std::max(int(line * kLetterShare), 1));
    const std::vector<std::string> lines = broken(text, scale, size_.width - line);
    cv::Mat rgba(std::min(line * (int(lines.size()) + 1), size_.height), size_.width, CV_8UC4,
                 kBackground);
    for (std::size_t i = 0; i < lines.size(); ++i)
        cv::putText(rgba, lines[i], {line / 2, static_cast<int>(line * (i + 1.25))}, kFont, scale,
                    kLetters, std::max(line / 16, 1), cv::LINE_AA);
    strip_ = gpu::Texture({rgba.cols, rgba.rows}, gpu::TexelFormat::Rgba8);
    strip_.upload({rgba.ptr(), rgba.step});
    stripTarget_ = gpu::Framebuffer(strip_);
    text_ = text;
}

}  // namespace mfar
