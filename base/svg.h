#pragma once

#include <array>
#include <string>
#include <string_view>

/// Elements of SVG documents for charts. Lengths are in px; y points downwards. Every element ends
/// with a newline.
namespace mfar::svg {

/// The colours of Okabe and Ito. People with any kind of colour vision can tell them apart.
inline constexpr std::array<const char*, 7> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                     "#e69f00", "#56b4e9", "#444444"};

/// Replaces characters that have a meaning in XML. The result can be an element's content.
[[nodiscard]] std::string escaped(std::string_view text);

/// Returns a text element. `anchor` is the part of the text that is at x: start, middle or end. y
/// is the base line of the letters.
[[nodiscard]] std::string text(double x, double y, std::string_view anchor, std::string_view what,
                               int size = 12, std::string_view colour = "#222");
[[nodiscard]] std::string textUpwards(double x, double y, std::string_view what);
[[nodiscard]] std::string line(double x0, double y0, double x1, double y1,
                               std::string_view colour = "#ddd", double width = 1);

[[nodiscard]] std::string document(double width, double height, std::string_view body);

}  // namespace mfar::svg
