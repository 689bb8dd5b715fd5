// Position of a cell's patch of 8x8 pixels. A patch that would extend beyond the picture is moved
// inside: the still shows what lies beyond, so repeated border pixels of the video would not match
// it.

// Returns the patch's first pixel in a picture of `size` pixels.
ivec2 patchStart(ivec2 cell, ivec2 size) {
    return max(min(4 * cell - 2, size - 8), ivec2(0));
}

// Returns how far [px] patchStart() moves a patch away from the centre of its cell.
ivec2 patchShift(ivec2 cell, ivec2 size) {
    return patchStart(cell, size) - (4 * cell - 2);
}
