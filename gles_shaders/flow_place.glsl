// Finds where the still shows a cell. The shader must include rig.glsl and declare params (rig).
struct Place {
    vec2 centre, alongX, alongY;
};

// Returns where the still shows the cell's centre, and the change of this position per video pixel
// along x and along y. `u`: the cell's flow. dx, dy: change of the flow per pixel along x and y.
Place placeOf(ivec2 cell, vec2 u, vec2 dx, vec2 dy) {
    // Positions in the still: of the cell's centre, and of the points one cell to the right of it
    // and one cell below it. The loop counts from cell.x, so that compilers cannot unroll it.
    vec2 at = vec2(0.0), right = at, below = at;
    for (int i = cell.x; i < cell.x + 3; ++i) {
        below = right;
        right = at;
        vec2 by = i == cell.x ? vec2(0.0, 1.0) + dy : vec2(1.0, 0.0) + dx;
        by = i == cell.x + 2 ? vec2(0.0) : 4.0 * by;
        at = stillPixel(params.rig, 4.0 * vec2(cell) + 1.5 + u + by);
    }
    return Place(at, 0.25 * (right - at), 0.25 * (below - at));
}

bool isInside(Place place, vec2 size) {
    return all(greaterThanEqual(place.centre, vec2(0.0))) && all(lessThanEqual(place.centre, size - 1.0));
}
