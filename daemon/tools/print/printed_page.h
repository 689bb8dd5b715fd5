#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

/// Pages with tags and calibration targets that are printed at their true size. Lengths on a page
/// are in mm. x points right and y down, from the upper left corner.
namespace mfar::print {

struct Paper {
    std::string_view name, title;
    double width, height;  ///< upright
};
inline constexpr std::array<Paper, 4> kPapers{{
    {"a4", "A4", 210, 297},
    {"a3", "A3", 297, 420},
    {"letter", "US letter", 215.9, 279.4},
    {"tabloid", "US tabloid", 279.4, 431.8},
}};
/// `name` must be the name of one of kPapers.
[[nodiscard]] const Paper& paperNamed(std::string_view name);

struct Area {
    double width = 0, height = 0;
};

/// A black rectangle.
struct Box {
    double left, top, right, bottom;
};

struct Label {
    double x, y;  ///< middle of the text on its base line
    std::string text;
};

class Page {
public:
    /// A page of this paper, upright or turned by 90 degrees.
    Page(const Paper& paper, bool turned);

    /// The part of the page that is free for a target. Printers cannot print up to the edge, and
    /// the lowest part has a ruler and the description.
    [[nodiscard]] static Area freeArea(const Paper& paper, bool turned);

    /// Adds a rectangle to the target. The coordinates are relative to the target's upper left
    /// corner.
    void add(const Box& box) { black_.push_back(box); }
    void add(Label label) { labels_.push_back(std::move(label)); }

    /// The page as an SVG document. A target of this size is in the middle of the free part. Below
    /// it are `description` and a ruler, with which the size of the print can be checked.
    [[nodiscard]] std::string svg(const Area& target, std::string_view description) const;

private:
    Area size_, free_;
    std::vector<Box> black_;
    std::vector<Label> labels_;
};

}  // namespace mfar::print
