#include "base/svg.h"
#include "tests/measure/eval/warp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mfar::eval {
namespace {

constexpr double kPanel = 420, kHeight = 320, kLeftOf = 70, kTopOf = 60, kBetween = 70;

class WarpPanel {
public:
    WarpPanel(const WarpRequest& request, const Report& report, std::string scene, double left)
        : request_(request), report_(report), scene_(std::move(scene)), left_(left) {
        for (const Report::Row& row : report.rows())
            if (isOfScene(row) && row.values[0] && std::isfinite(*row.values[0])) {
                least_ = std::min(least_, std::floor(*row.values[0]));
                most_ = std::max(most_, std::ceil(*row.values[0]));
            }
    }

    [[nodiscard]] std::string draw() const {
        std::string out = svg::text(left_ + kPanel / 2, kTopOf - 12, "middle", scene_, 15);
        if (!(least_ < most_)) return out;
        const double step = std::max(1.0, std::ceil((most_ - least_) / 8));
        for (double db = least_; db <= most_; db += step) {
            out += svg::line(left_, y(db), left_ + kPanel, y(db));
            out += svg::text(left_ - 6, y(db) + 4, "end", fmt::format("{:g}", db));
        }
        for (const double degrees : request_.degrees) {
            out += svg::line(x(degrees), kTopOf, x(degrees), kTopOf + kHeight);
            out += svg::text(x(degrees), kTopOf + kHeight + 16, "middle",
                             fmt::format("{:g}", degrees));
        }
        out += svg::text(left_ + kPanel / 2, kTopOf + kHeight + 36, "middle",
                         "turn of the view [degrees], logarithmic");
        out +=
            svg::textUpwards(left_ - 40, kTopOf + kHeight / 2, "PSNR inside the silhouette [dB]");
        for (std::size_t i = 0; i < request_.methods.size(); ++i)
            out += curve(request_.methods[i], svg::kColours[i % svg::kColours.size()]);
        return out;
    }

private:
    [[nodiscard]] bool isOfScene(const Report::Row& row) const {
        return row.recording.starts_with(scene_ + "/");
    }
    [[nodiscard]] double x(double degrees) const {
        const auto [least, most] = std::ranges::minmax(request_.degrees);
        const double span = std::max(std::log(most / least), 1e-9);
        return left_ + kPanel * (0.04 + 0.92 * std::log(degrees / least) / span);
    }
    [[nodiscard]] double y(double db) const {
        return kTopOf + kHeight * (most_ - db) / (most_ - least_);
    }
    [[nodiscard]] std::string curve(const std::string& method, const char* colour) const {
        std::string path, marks;
        for (const double degrees : request_.degrees)
            for (const Report::Row& row : report_.rows()) {
                if (row.recording != fmt::format("{}/{:g}", scene_, degrees) ||
                    row.method != method || !row.values[0] || !std::isfinite(*row.values[0]))
                    continue;
                path += fmt::format("{:.1f},{:.1f} ", x(degrees), y(*row.values[0]));
                marks += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n",
                                     x(degrees), y(*row.values[0]), colour);
            }
        return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" "
                           "stroke-width=\"1.8\"/>\n",
                           path, colour) +
               marks;
    }

    const WarpRequest& request_;
    const Report& report_;
    std::string scene_;
    double left_;
    double least_ = std::numeric_limits<double>::infinity();
    double most_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

std::string warpSvg(const WarpRequest& request, const Report& report) {
    std::string body;
    double left = kLeftOf;
    for (const std::string& scene : sceneLabels(request.scenes)) {
        body += WarpPanel(request, report, scene, left).draw();
        left += kPanel + kBetween;
    }
    double at = kLeftOf;
    const double legend = kTopOf + kHeight + 64;
    for (std::size_t i = 0; i < request.methods.size(); ++i) {
        const char* colour = svg::kColours[i % svg::kColours.size()];
        body += svg::line(at, legend - 4, at + 24, legend - 4, colour, 3);
        body += svg::text(at + 30, legend, "start", request.methods[i]);
        at += 110;
    }
    body += svg::text(kLeftOf, 26, "start", "A path-traced picture, warped to another view", 17);
    return svg::document(std::max(left, at), legend + 20, body);
}

}  // namespace mfar::eval
