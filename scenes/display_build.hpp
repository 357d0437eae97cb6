// How a display's three views follow from what its maker states.
#pragma once

#include "scenes/display.hpp"

namespace macula::scene {

struct Tangents {
    double left, right, up, down;
};

// A rotation about the y axis by `outward` degrees to the left (positive) or right.
glm::dmat3 turned_left(double degrees);

// A headset whose right eye mirrors the left one: `ipd` in metres, both eyes turned outward by
// `cant` degrees. `mono` is the left eye moved to the middle.
void set_headset(Display& display, const Tangents& left, double ipd, double cant);

// A flat screen with square pixels, `width` metres wide, at `distance` metres from the middle
// between the eyes; each eye's tangents follow from its own place before it.
void set_screen(Display& display, double width, double distance, double ipd);

} // namespace macula::scene
