// The ground beyond a map: it goes on as it came to the border, then curves down into the sea, so
// that no map ends in a cut.
//
// With m the height on the map, b the border's point nearest to p, d the distance from b to p, and
// p' the mirror image of p in the border,
//   goes on   e = m(b) + soft(m(b) - m(p'))    the map turned about its border: no step, no crease;
//                                              beyond a corner along x, then along y; further out
//                                              e passes into m(b), so that a hole or a hill on the
//                                              map does not come again as a hill or a hole
//   sinks     h = e + (floor - e) s(x^2)       s a smoothstep, x the part of a slope with bays that
//                                              begins at once beyond corners and later before the
//                                              sides: from above the ground ends about round, not
//                                              in a square
// soft() keeps e between the floor and the map's highest point: x room / (x + room).
#pragma once

#include "terrain/height_grid.h"

namespace swell::terrain {

// The apron that build_terrain() gives a square map: half a side wide, down to 60 m below the sea
// or the map's lowest point, on small maps less. highest_m and lowest_m are set.
Apron make_apron(const HeightGrid& map);

// The map with its apron: a square twice as wide about the same middle, or the map without one.
Grid square_with_apron(const HeightGrid& map);

}  // namespace swell::terrain
