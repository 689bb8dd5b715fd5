#include "base/svg.h"

#include <fmt/format.h>

namespace mfar::svg {

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
        case '&': out += "&amp;"; break;
        case '<': out += "&lt;"; break;
        case '>': out += "&gt;"; break;
        default: out += c;
        }
    }
    return out;
}

std::string text(double x, double y, std::string_view anchor, std::string_view what, int size,
                 std::string_view colour) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"{}\" "
                       "fill=\"{}\">{}</text>\n",
                       x, y, size, anchor, colour, escaped(what));
}

std::string textUpwards(double x, double y, std::string_view what) {
    return fmt::format("<text transform=\"translate({:.1f},{:.1f}) rotate(-90)\" font-size=\"12\" "
                       "text-anchor=\"middle\" fill=\"#222\">{}</text>\n",
                       x, y, escaped(what));
}

std::string line(double x0, double y0, double x1, double y1, std::string_view colour,
                 double width) {
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" "
                       "stroke=\"{}\" stroke-width=\"{:g}\"/>\n",
                       x0, y0, x1, y1, colour, width);
}

std::string document(double width, double height, std::string_view body) {
    return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" "
                       "height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
                       "font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" "
                       "fill=\"#fff\"/>\n",
                       width, height) +
           std::string(body) + "</svg>\n";
}

}  // namespace mfar::svg
