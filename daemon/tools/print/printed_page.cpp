#include "daemon/tools/print/printed_page.h"

#include "base/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace mfar::print {
namespace {

constexpr double kMargin = 10;  // along each edge of the page
constexpr double kFooter = 17;  // height of the part with the ruler and the description
constexpr double kRuler = 100;  // length of the ruler
constexpr double kTick = 2;
constexpr int kTextSize = 4;

Area sizeOf(const Paper& paper, bool turned) {
    return turned ? Area{paper.height, paper.width} : Area{paper.width, paper.height};
}

/// Returns the boxes as one path. In separate elements, adjacent boxes could have a fine white line
/// between them.
std::string pathOf(const std::vector<Box>& boxes, double left, double top) {
    std::string out = "<path d=\"";
    for (const Box& b : boxes)
        fmt::format_to(std::back_inserter(out), "M{:.3f},{:.3f}H{:.3f}V{:.3f}H{:.3f}Z\n",
                       left + b.left, top + b.top, left + b.right, top + b.bottom, left + b.left);
    return out + "\"/>\n";
}

/// Returns a ruler from x = `left` on. Its middle line is at height `y`.
std::string rulerAt(double left, double y) {
    std::string out = fmt::format(
        "<path stroke=\"#000\" stroke-width=\"0.2\" d=\"M{:.3f},{:.3f}h{:g}", left, y, kRuler);
    for (int cm = 0; cm <= 10; ++cm)
        fmt::format_to(std::back_inserter(out), "M{:.3f},{:.3f}v{:g}", left + kRuler * cm / 10,
                       y - kTick, 2 * kTick);
    return out + "\"/>\n";
}

}  // namespace

const Paper& paperNamed(std::string_view name) {
    return *std::ranges::find(kPapers, name, &Paper::name);
}

Page::Page(const Paper& paper, bool turned)
    : size_(sizeOf(paper, turned)), free_(freeArea(paper, turned)) {}

Area Page::freeArea(const Paper& paper, bool turned) {
    const Area page = sizeOf(paper, turned);
    return {page.width - 2 * kMargin, page.height - 2 * kMargin - kFooter};
}

std::string Page::svg(const Area& target, std::string_view description) const {
    const double left = 0.5 * (size_.width - target.width);
    const double top = kMargin + 0.5 * (free_.height - target.height);
    const double footer = kMargin + free_.height;
    // The style tells browsers to print the page at its size and without further margins.
    std::string out =
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" "
                    "viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\">\n"
                    "<style>@page {{ size: {0}mm {1}mm; margin: 0 }}</style>\n",
                    size_.width, size_.height);
    out += pathOf(black_, left, top);
    for (const Label& label : labels_)
        out += svg::text(left + label.x, top + label.y, "middle", label.text, kTextSize);
    out += rulerAt(0.5 * (size_.width - kRuler), footer + 5);
    const std::string check =
        fmt::format("Print at 100 %. In the print, the ruler must be {:g} mm long.", kRuler);
    out += svg::text(0.5 * size_.width, footer + 12, "middle", description, kTextSize);
    out += svg::text(0.5 * size_.width, footer + 17, "middle", check, kTextSize);
    return out + "</svg>\n";
}

}  // namespace mfar::print
