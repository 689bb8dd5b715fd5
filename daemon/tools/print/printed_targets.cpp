#include "daemon/tools/print/printed_targets.h"

#include "pipeline/track/tag_detector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mfar::print {
namespace {

constexpr double kMm = 1000;                          // mm per m
constexpr double kLabelHeight = 7, kLabelWidth = 16;  // of a tag's number, below the tag
constexpr double kGap = 5;                            // between tags, to cut them apart
constexpr double kRounding = 1e-6;                    // tolerance for rounding errors

/// Returns the largest whole number of mm [m] for which a target fits, if its sides are `perUnit`
/// times as long.
double largestUnit(const Area& perUnit, const Paper& paper) {
    double out = 0;
    for (const bool turned : {false, true}) {
        const Area free = Page::freeArea(paper, turned);
        const double mm =
            std::min(free.width / perUnit.width, free.height / perUnit.height) + kRounding;
        out = std::max(out, std::floor(mm));
    }
    return out / kMm;
}

/// Adds a tag's black cells. `left`, `top`: upper left corner of its picture, including the white
/// rim. `cell`: edge of a cell.
void addTag(Page& page, const TagPicture& tag, double left, double top, double cell) {
    for (int y = 0; y < tag.size; ++y)
        for (int x = 0; x < tag.size; ++x) {
            const auto* row = tag.cells.data() + static_cast<std::ptrdiff_t>(y) * tag.size;
            if (row[x] != 0) continue;
            int end = x + 1;
            while (end < tag.size && row[end] == 0)
                ++end;
            page.add(Box{left + x * cell, top + y * cell, left + end * cell, top + (y + 1) * cell});
            x = end;
        }
}

Area gridPerTag(int columns, int rows, double spacing) {
    return {columns * (1 + spacing) + spacing, rows * (1 + spacing) + spacing};
}

/// The places of blocks of one size on a page, with gaps between them.
struct Places {
    bool turned = false;
    int columns = 0, rows = 0;

    [[nodiscard]] int count() const { return columns * rows; }
};
/// Returns the places on the paper: turned by 90 degrees only if `wanted` places do not fit
/// upright.
Places placesFor(int wanted, const Area& block, const Paper& paper) {
    Places best;
    for (const bool turned : {false, true}) {
        const Area free = Page::freeArea(paper, turned);
        const auto count = [](double length, double part) {
            return static_cast<int>(std::floor((length + kGap) / (part + kGap) + kRounding));
        };
        const Places own{turned, count(free.width, block.width), count(free.height, block.height)};
        if (own.count() > best.count()) best = own;
        if (best.count() >= wanted) break;
    }
    return best;
}

void requirePlaces(int count, const Places& places, double size, const Paper& paper) {
    if (places.count() == 0)
        throw std::runtime_error(fmt::format(
            "a tag of {:g} m with the cells around it does not fit on {}", size, paper.title));
    if (count > places.count())
        throw std::runtime_error(fmt::format("{} tags of {:g} m do not fit on {}, only {}", count,
                                             size, paper.title, places.count()));
}

void requireIds(const TagFamilyInfo& family, std::span<const int> ids) {
    if (ids.empty()) throw std::runtime_error("no tag is named");
    for (const int id : ids)
        if (id < 0 || id >= family.count)
            throw std::runtime_error(fmt::format("family {} has the tags 0 to {}, but not {}",
                                                 family.name, family.count - 1, id));
}

}  // namespace

std::string tagPage(TagFamily family, std::span<const int> ids, double size, const Paper& paper) {
    const TagFamilyInfo& of = info(family);
    requireIds(of, ids);
    const TagPicture first = drawTag({family, ids.front()});
    const double cell = size * kMm / (first.size - 2 * first.corner);
    const double side = first.size * cell;
    const Area block{std::max(side, kLabelWidth), side + kLabelHeight};
    const auto count = static_cast<int>(ids.size());
    const Places places = placesFor(count, block, paper);
    requirePlaces(count, places, size, paper);
    Page page(paper, places.turned);
    const int columns = std::min(count, places.columns), rows = (count + columns - 1) / columns;
    for (int i = 0; i < count; ++i) {
        const int id = ids[static_cast<std::size_t>(i)], row = i / columns;
        const double left = i % columns * (block.width + kGap), top = row * (block.height + kGap);
        const double middle = left + 0.5 * block.width;
        addTag(page, drawTag({family, id}), middle - 0.5 * side, top, cell);
        page.add(Label{middle, top + block.height - 2, fmt::format("tag {}", id)});
    }
    const char* const edge =
        of.brightInside ? "along the inner white square" : "between the outer corners";
    return page.svg({columns * (block.width + kGap) - kGap, rows * (block.height + kGap) - kGap},
                    fmt::format("{}, {:g} mm {} of a tag", of.name, size * kMm, edge));
}

std::string gridPage(const calibration::Target& grid, const Paper& paper) {
    const double tag = grid.size * kMm, gap = grid.spacing * tag, pitch = tag + gap;
    const Area perTag = gridPerTag(grid.columns, grid.rows, grid.spacing);
    const Area area{perTag.width * tag, perTag.height * tag};
    const Places places = placesFor(1, area, paper);
    if (places.count() == 0)
        throw std::runtime_error(fmt::format(
            "an AprilGrid of {} x {} tags with an edge of {:g} m does not fit on {}; in "
            "whole mm, at most {:g} m fit",
            grid.columns, grid.rows, grid.size, paper.title,
            largestTag(grid.columns, grid.rows, grid.spacing, paper)));
    Page page(paper, places.turned);
    for (int row = 0; row <= grid.rows; ++row)
        for (int column = 0; column <= grid.columns; ++column)
            page.add(Box{column * pitch, row * pitch, column * pitch + gap, row * pitch + gap});
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column) {
            // The lowest row has the first tags.
            const int id = grid.firstId + (grid.rows - 1 - row) * grid.columns + column;
            const TagPicture picture = drawTag({calibration::kGridFamily.family, id});
            const double cell = tag / (picture.size - 2 * picture.corner);
            addTag(page, picture, gap + column * pitch - picture.corner * cell,
                   gap + row * pitch - picture.corner * cell, cell);
        }
    return page.svg(
        area,
        fmt::format(
            "AprilGrid of {} x {} tags, edge of a tag {:g} mm, gap {:g} mm, in all {:g} x {:g} mm",
            grid.columns, grid.rows, tag, gap, area.width, area.height));
}

std::string boardPage(const calibration::Target& board, const Paper& paper) {
    const double square = board.size * kMm;
    const int columns = board.columns + 1, rows = board.rows + 1;
    const Area area{columns * square, rows * square};
    const Places places = placesFor(1, area, paper);
    if (places.count() == 0)
        throw std::runtime_error(fmt::format(
            "a checkerboard of {}x{} inner corners with squares of {:g} m does not fit on {}; in "
            "whole mm, at most {:g} m fit",
            board.columns, board.rows, board.size, paper.title,
            largestSquare(board.columns, board.rows, paper)));
    Page page(paper, places.turned);
    for (int row = 0; row < rows; ++row)
        for (int column = row % 2; column < columns; column += 2)
            page.add(Box{column * square, row * square, (column + 1) * square, (row + 1) * square});
    return page.svg(
        area, fmt::format(
                  "Checkerboard of {}x{} inner corners, squares of {:g} mm, in all {:g} x {:g} mm",
                  board.columns, board.rows, square, area.width, area.height));
}

double largestTag(int columns, int rows, double spacing, const Paper& paper) {
    return largestUnit(gridPerTag(columns, rows, spacing), paper);
}

double largestSquare(int columns, int rows, const Paper& paper) {
    return largestUnit({columns + 1.0, rows + 1.0}, paper);
}

}  // namespace mfar::print
